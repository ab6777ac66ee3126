//! Access of walls to the nodes of either grid.

use crate::grid::{BLOCK_NODES, BlockKey, index_of};
use crate::kernel::Lattice;
use crate::math::{Sym3, Vec3};

/// The nodes of a grid, by their places: block by block, within a block along z
/// first.
pub trait NodeAccess: Sync {
    /// Lattice of the nodes.
    fn lattice(&self) -> &Lattice;
    /// The blocks of nodes.
    fn blocks(&self) -> &[BlockKey];
    /// Place of node (i, j, k), if its block is there.
    fn place_of(&self, index: [i32; 3]) -> Option<usize>;
    /// Index (i, j, k) of a node.
    fn index(&self, place: usize) -> [i32; 3] {
        index_of(self.blocks()[place / BLOCK_NODES], place % BLOCK_NODES)
    }
    /// Position at the transfer [m].
    fn position(&self, place: usize) -> Vec3 {
        self.lattice().position(self.index(place))
    }
    /// Mass [kg].
    fn mass(&self, place: usize) -> f64;
    /// Velocity [m/s].
    fn velocity(&self, place: usize) -> Vec3;
    /// Displacement at the start of the sub-step of `dt` [m].
    fn displacement(&self, place: usize, dt: f64) -> Vec3;
    /// Sets the velocity [m/s] of a node through the sub-step.
    fn set_velocity(&mut self, place: usize, velocity: &Vec3, dt: f64);
    /// Nodal volume fraction.
    fn volume_fraction(&self, place: usize) -> f64;
    /// Sets the nodal volume fraction.
    fn set_volume_fraction(&mut self, place: usize, volume_fraction: f64);
    /// Mean strain rate of its points at the transfer [1/s].
    fn strain_rate(&self, place: usize) -> Sym3;
    /// Sets the mean strain rate.
    fn set_strain_rate(&mut self, place: usize, strain_rate: &Sym3);
    /// Mean compressive volumetric strain min(φ, 0) of its points at the transfer.
    fn compressive_strain(&self, place: usize) -> f64;
    /// Sets the mean compressive strain.
    fn set_compressive_strain(&mut self, place: usize, strain: f64);
}

#[cfg(test)]
mod fixture;
