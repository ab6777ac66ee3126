//! Contact: the law, and who meets whom.

pub mod body_body;
pub mod body_wall;
pub mod law;
pub mod point_body;
