//! Conversion of points between the plain path and the blocks of the fast path.

use super::blocks::settle;
use super::chunk::Packed;
use crate::grid::{BLOCK, BlockKey, block_of};
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
    /// A point between two steps in the form of a block, and that block.
    pub fn pack(&self, point: &Point) -> (BlockKey, Packed) {
        let key = block_of(self.lattice.base(&point.position));
        let mut position = self.in_block(&key, &point.position);
        // Rounding may move a point over the rim.
        let key = settle(&key, &mut position);
        let s = point.stress.deviator();
        let density = point.mass / point.volume;
        let record = Packed {
            position,
            velocity: single(&point.velocity),
            gradient: [0, 1, 2].map(|axis| single(&point.affine.column(axis).into())),
            deviator: [s.xx, s.yy, s.zz, s.xy, s.xz, s.yz].map(|part| part as f32),
            volumetric_strain: (self.material.bulk_density / density - 1.0) as f32,
            mass: point.mass as f32,
            id: point.id,
        };
        (key, record)
    }

    /// A point of a block, between two steps.
    pub fn unpack(&self, key: &BlockKey, record: &Packed) -> Point {
        let mass = f64::from(record.mass);
        let volume =
            mass / self.material.bulk_density * (1.0 + f64::from(record.volumetric_strain));
        let pressure = self.material.pressure(mass / volume);
        let [xx, yy, zz, xy, xz, yz] = record.deviator.map(f64::from);
        let deviator = Sym3 {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        };
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
    pub fn in_block(&self, key: &BlockKey, x: &Vec3) -> [f32; 3] {
        let in_cells = (x - self.lattice.origin).component_div(&self.lattice.spacing);
        [0, 1, 2].map(|axis| (in_cells[axis] - f64::from(key[axis]) * BLOCK as f64) as f32)
    }

    /// A position in a block, in space [m].
    pub fn position(&self, key: &BlockKey, in_block: &[f32; 3]) -> Vec3 {
        let first = self.lattice.position(key.map(|k| k * BLOCK as i32));
        first + double(in_block).component_mul(&self.lattice.spacing)
    }
}

fn single(v: &Vec3) -> [f32; 3] {
    [v.x as f32, v.y as f32, v.z as f32]
}

fn double(v: &[f32; 3]) -> Vec3 {
    Vec3::from(v.map(f64::from))
}

#[cfg(test)]
mod tests;
