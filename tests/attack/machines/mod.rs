//! Services and workers as processes that share a PostgreSQL database: killed, suspended, cut off
//! and counted. Each test starts a server of its own with `.ci/postgres`, which installs it if it is
//! missing, and is ignored where that is not wanted.

mod cluster;
mod disturbances;
mod scale;
mod speed;
