//! Sums over the 27 nodes of points, row by row.
//!
//! Three nodes along z, four numbers each, and a fourth node of weight zero make a row of
//! sixteen numbers. The stencil of a point is nine rows; points of one cell have the same nine,
//! which then stay in registers.
//!
//! Nothing is weighted by distances: whatever is linear about a point is taken about the middle
//! node of its stencil, where distances are −1, 0 and 1, and moved to the point for all points of
//! a chunk at once (docs/decisions/0051-moments-about-the-middle-node.md).

mod gather;
mod quads;
mod scatter;
mod tile;

pub use gather::{MomentSums, Moments, gather_mean};
pub use quads::{Quads, store_transposed, transposed};
pub use scatter::{LinearFields, scatter_mean};
pub use tile::Tile;

use super::lanes::Real;
use crate::kernel::WIDTH;

/// The nine rows of a stencil.
type StencilRows<S, R> = [[<R as Real>::Row<S>; WIDTH]; WIDTH];

#[cfg(test)]
mod tests;
