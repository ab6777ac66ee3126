//! The cases. To add one: a file, its `mod` line and its place in [`ALL`].

mod elastic_bar;
mod free_fall;
mod hertz;
mod hydrostatic;
mod incline;
mod mass;
mod momentum_audit;
mod restitution;
mod rotation;
mod sliding_block;
mod torque_free;

use super::{Case, How};

/// Every case, by its number.
pub const ALL: &[Case] = &[
    free_fall::CASE,
    rotation::CASE,
    mass::CASE,
    hertz::CASE,
    restitution::CASE,
    torque_free::CASE,
    incline::CASE,
    FEATURE_CONTACTS,
    elastic_bar::CASE,
    hydrostatic::CASE,
    sliding_block::CASE,
    momentum_audit::CASE,
];

const FEATURE_CONTACTS: Case = Case {
    name: "feature-contacts",
    number: "7",
    title: "contacts of vertices, edges and faces between bodies",
    source: "continuity of force and energy; conservation in an undamped collision",
    how: How::NotYet("bodies don't touch each other yet, only walls and points"),
};
