//! The cases. To add one: a file, its `mod` line and its place in [`ALL`].

mod axisymmetric_collapse;
mod bagnold;
mod buried_body;
mod channel_as_raster;
mod coarse_cells;
mod column_collapse;
mod cubes_and_column;
mod dam_break;
mod dragged_plate;
mod dust_stream;
mod early_stop;
mod elastic_bar;
mod error_bars;
mod feature_contacts;
mod free_fall;
mod hertz;
mod hydrostatic;
mod incline;
mod mass;
mod momentum_audit;
mod plate_drag;
mod pressed_plate;
mod restitution;
mod rolling_prisms;
mod rotation;
mod sliding_block;
mod source_paper;
mod sphere_into_bed;
mod study_regions;
mod torque_free;
mod two_clocks;
mod wall_bore;

use super::Case;

pub use feature_contacts::slide_over_a_rim;

/// Every case, by its number.
pub const ALL: &[Case] = &[
    free_fall::CASE,
    rotation::CASE,
    mass::CASE,
    hertz::CASE,
    restitution::CASE,
    torque_free::CASE,
    incline::CASE,
    rolling_prisms::CASE,
    feature_contacts::CASE,
    elastic_bar::CASE,
    hydrostatic::CASE,
    sliding_block::CASE,
    bagnold::CASE,
    dust_stream::CASE,
    buried_body::CASE,
    plate_drag::CASE,
    two_clocks::CASE,
    wall_bore::CASE,
    dragged_plate::CASE,
    pressed_plate::CASE,
    column_collapse::CASE,
    axisymmetric_collapse::CASE,
    dam_break::CASE,
    momentum_audit::CASE,
    sphere_into_bed::CASE,
    source_paper::CASE,
    cubes_and_column::CASE,
    error_bars::CASE,
    coarse_cells::CASE,
    early_stop::CASE,
    study_regions::CASE,
    channel_as_raster::CASE,
];
