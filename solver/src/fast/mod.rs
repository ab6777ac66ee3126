//! The fast path: the transfers, the deformation and the stress of the plain
//! path (`transfer.rs`, `points.rs`, `material.rs`) in single precision, sixteen
//! points at a time.
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
pub mod cost;
pub mod instructions;
pub mod nodes;
pub mod packing;
pub mod passes;
pub mod redistribution;
pub mod rows;
pub mod stencil;
pub mod stress;
pub mod totals;

#[cfg(test)]
mod fixture;
