//! The solver through its public API: physics with a known answer, balances, symmetries, and
//! bitwise reproducibility. Figures behind the assertions are printed and show with
//! `--nocapture`.
#![allow(
    clippy::print_stdout,
    reason = "measured figures belong to a test's output"
)]

mod scenes;

mod balances;
mod bodies_alone;
mod bodies_together;
mod column_at_rest;

mod froude;
mod grid_phase;
mod guards;
mod heap;
mod inundation;
mod layers;
mod limits;
mod plan;
mod precisions;
mod prescribed;
mod reductions;
mod reported;
mod round_bodies;
mod same_bits;
mod samples;
mod shapes;
mod sliding_block;
mod symmetry;
mod terrain;
mod terrain_bodies;
mod terrain_cliffs;
mod terrain_edges;
mod terrain_slopes;
mod thin_flows;
mod words;
