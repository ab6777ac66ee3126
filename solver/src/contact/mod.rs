//! Contact: the law, the broad phase and contact evaluation.

pub mod body_body;
pub mod body_wall;
pub mod broad_phase;
pub mod dissipation;
pub mod friction;
pub mod island;
pub mod law;
pub mod point_body;
pub mod screening;
pub mod wall_touch;
