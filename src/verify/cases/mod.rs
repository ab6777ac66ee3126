//! The cases. To add one: a file, its `mod` line and its place in [`ALL`].

mod free_fall;
mod hertz;
mod incline;
mod mass;
mod restitution;
mod sliding_block;
mod torque_free;

use super::{Case, How};

/// Every case, by its number.
pub const ALL: &[Case] = &[
    free_fall::CASE,
    mass::CASE,
    hertz::CASE,
    restitution::CASE,
    torque_free::CASE,
    incline::CASE,
    FEATURE_CONTACTS,
    sliding_block::CASE,
];

const FEATURE_CONTACTS: Case = Case {
    name: "feature-contacts",
    number: "7",
    title: "contacts of vertices, edges and faces between bodies",
    source: "continuity of force and energy; conservation in an undamped collision",
    how: How::NotYet("bodies don't touch each other yet, only walls and points"),
};
