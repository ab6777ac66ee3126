//! The Material Point Method: one text of each formula, for either precision and for many points
//! side by side.
//!
//! | stage | file |
//! |---|---|
//! | P2G: mass and momentum, residual transfer | [`p2g`] |
//! | strain-rate smoothing | [`strain_rate_smoothing`] |
//! | grid update | [`nodes`] |
//! | stress update: deformation, constitutive law, forces | [`stress_update`], [`deformation`], [`constitutive`] |
//! | G2P, redistribution | [`g2p`], [`redistribution`] |
//! | rebin | [`blocks`] |
//!
//! Points lie in blocks of 4³ cells, sorted by cell, with positions relative to
//! their block. A block works on a tile of nodes of its own; tiles are added up
//! in a fixed order. So blocks run in parallel, and the bits do not depend on
//! the number of threads. Processors with AVX-512 or AVX2 run code made for
//! them, chosen at run time; both round alike.

#![allow(
    clippy::needless_range_loop,
    reason = "one index runs over several arrays at once"
)]

pub mod blocks;
pub mod chunk;
pub mod constitutive;
pub mod cost;
pub mod deformation;
pub mod g2p;
pub mod instructions;
pub mod lanes;
pub mod nodes;
pub mod p2g;
pub mod packing;
mod prefetch;
pub mod redistribution;
pub mod rows;
pub mod stencil;
pub mod strain_rate_smoothing;
pub mod stress_update;
pub mod totals;

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod reference;
#[cfg(test)]
mod step_tests;
