//! Points of a flow in blocks, as the contact with bodies finds them.

use crate::contact::point_body::{Around, Moving, PointAccess};
use crate::kernel::PointStencil;
use crate::math::Vec3;
use crate::mpm::blocks::Block;
use crate::mpm::lanes::Real;
use crate::mpm::nodes::Nodes;
use crate::mpm::packing::Packing;

/// Place of a point in memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) block: u32,
    pub(super) slot: u32,
}

pub(super) struct Access<'a, R: Real> {
    pub(super) blocks: &'a [Block<R>],
    pub(super) nodes: &'a Nodes<R>,
    pub(super) packing: &'a Packing,
}

impl<R: Real> PointAccess for Access<'_, R> {
    type Place = Place;

    fn find_within(&self, around: &Around, found: &mut Vec<Place>) {
        for (place, block) in self.blocks.iter().enumerate() {
            if !around.meets(&self.packing.lattice, &block.key) {
                continue;
            }
            let inside = (0..block.count()).filter(|slot| {
                let position = block.position(*slot);
                around.holds(&self.packing.position(&block.key, &position))
            });
            found.extend(inside.map(|slot| Place {
                block: place as u32,
                slot: slot as u32,
            }));
        }
    }

    fn resting(&self, place: Place) -> Vec3 {
        let block = &self.blocks[place.block as usize];
        let position = block.position(place.slot as usize);
        self.packing.position(&block.key, &position)
    }

    fn stencil(&self, place: Place) -> PointStencil {
        let block = place.block as usize;
        let position = self.blocks[block].position(place.slot as usize);
        self.nodes.stencil_at(block, &position)
    }

    fn moving(&self, place: Place) -> Moving {
        let block = &self.blocks[place.block as usize];
        let position = block.position(place.slot as usize);
        let (velocity, displacement) = self.nodes.motion_at(place.block as usize, &position);
        Moving {
            position: self.packing.position(&block.key, &position) + displacement,
            velocity,
        }
    }
}
