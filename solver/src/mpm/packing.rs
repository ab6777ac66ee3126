//! Points in double precision, and as blocks keep them.

use super::blocks::settle;
use super::chunk::Packed;
use super::lanes::Real;
use crate::grid::{BLOCK, BlockKey, block_of, first_node};
use crate::kernel::Lattice;
use crate::material::Material;
use crate::math::{Mat3, Sym3, Vec3};
use crate::points::Point;

/// Scales of the values in a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packing {
    /// Lattice of the nodes.
    pub lattice: Lattice,
    /// Material of the points.
    pub material: Material,
}

impl Packing {
    /// A point between two steps as a block keeps it, and that block.
    pub fn pack<R: Real>(&self, point: &Point) -> (BlockKey, Packed<R>) {
        let key = block_of(self.lattice.base(&point.position));
        let mut position = self.in_block(&key, &point.position);
        // Rounding may move a point over the rim.
        let key = settle(&key, &mut position);
        let deviator = point.stress.deviator().components();
        let density = point.mass / point.volume;
        let record = Packed {
            position,
            velocity: rounded(&point.velocity),
            gradient: [0, 1, 2].map(|axis| rounded(&point.affine.column(axis).into())),
            deviator: deviator.map(R::of),
            volumetric_strain: R::of(self.material.bulk_density / density - 1.0),
            mass: R::of(point.mass),
            id: point.id,
        };
        (key, record)
    }

    /// A point of a block, between two steps.
    pub fn unpack<R: Real>(&self, key: &BlockKey, record: &Packed<R>) -> Point {
        let mass = record.mass.to_f64();
        let volumetric_strain = record.volumetric_strain.to_f64();
        let volume = mass / self.material.bulk_density * (1.0 + volumetric_strain);
        let pressure = self.material.pressure(mass / volume);
        let deviator = Sym3::from_components(record.deviator.map(R::to_f64));
        Point {
            id: record.id,
            mass,
            volume,
            position: self.position(key, &record.position),
            velocity: double(&record.velocity),
            affine: Mat3::from_columns(&record.gradient.each_ref().map(double)),
            stress: deviator.plus(&Sym3::isotropic(-pressure)),
        }
    }

    /// A place as a position in a block [cells].
    pub fn in_block<R: Real>(&self, key: &BlockKey, x: &Vec3) -> [R; 3] {
        let in_cells = (x - self.lattice.origin).component_div(&self.lattice.spacing);
        [0, 1, 2].map(|axis| R::of(in_cells[axis] - f64::from(key[axis]) * BLOCK as f64))
    }

    /// A position in a block, in space [m].
    pub fn position<R: Real>(&self, key: &BlockKey, in_block: &[R; 3]) -> Vec3 {
        let first = self.lattice.position(first_node(*key));
        first + double(in_block).component_mul(&self.lattice.spacing)
    }
}

fn rounded<R: Real>(v: &Vec3) -> [R; 3] {
    [R::of(v.x), R::of(v.y), R::of(v.z)]
}

fn double<R: Real>(v: &[R; 3]) -> Vec3 {
    Vec3::from(v.map(R::to_f64))
}

#[cfg(test)]
mod tests;
