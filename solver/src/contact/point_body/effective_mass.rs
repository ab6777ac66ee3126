//! Effective mass of the contacts between points and bodies: the mass that resists a force on
//! all of them at once (docs/method.md, equation 24a).

use crate::grid::BLOCK_NODES;
use crate::kernel::PointStencil;
use crate::rigid::Body;
use crate::walls::{Boundary, NodeAccess};

/// Compliance of the grid at the contacts of a sub-step: per node Σ_q w_iq / m_i [1/kg]
/// over the points q in contact with any body.
#[derive(Debug, Default)]
pub(super) struct GridCompliance {
    per_node: Vec<f64>,
    /// Nodes where it is not zero.
    loaded: Vec<u32>,
}

impl GridCompliance {
    /// Bytes allocated.
    pub(super) fn bytes(&self) -> usize {
        self.per_node.capacity() * size_of::<f64>() + self.loaded.capacity() * size_of::<u32>()
    }

    /// Adds the stencils of the points in contact.
    pub(super) fn gather<'a>(
        &mut self,
        stencils: impl Iterator<Item = &'a PointStencil>,
        nodes: &impl NodeAccess,
        boundary: &Boundary,
    ) {
        for place in self.loaded.drain(..) {
            self.per_node[place as usize] = 0.0;
        }
        let count = nodes.blocks().len() * BLOCK_NODES;
        if self.per_node.len() < count {
            self.per_node.resize(count, 0.0);
        }
        // A node at the very edge of a kernel has no weight, and may have no mass.
        for (place, weight) in stencils.flatten().filter(|(_, weight)| *weight > 0.0) {
            let sum = &mut self.per_node[*place as usize];
            if *sum == 0.0 {
                self.loaded.push(*place);
            }
            *sum += weight;
        }
        for place in &self.loaded {
            self.per_node[*place as usize] /= nodes.mass(*place as usize);
        }
        if !self.loaded.is_empty() {
            self.share_with_ghosts(nodes, boundary);
        }
    }

    /// Joins a node and its ghost nodes, which move as one: their total mass resists their total
    /// weight.
    fn share_with_ghosts(&mut self, nodes: &impl NodeAccess, boundary: &Boundary) {
        for group in boundary.ghost_sets() {
            let weight = |place: usize| self.per_node[place] * nodes.mass(place);
            let weights: f64 = group.clone().map(weight).sum();
            if weights == 0.0 {
                continue;
            }
            let compliance = weights / group.clone().map(|place| nodes.mass(place)).sum::<f64>();
            for place in group {
                if self.per_node[place] == 0.0 {
                    self.loaded.push(place as u32);
                }
                self.per_node[place] = compliance;
            }
        }
    }

    /// Acceleration of a point by a unit force on every point in contact [1/kg].
    pub(super) fn at(&self, stencil: &PointStencil) -> f64 {
        let of_node = |(place, weight): &(u32, f64)| weight * self.per_node[*place as usize];
        stencil.iter().map(of_node).sum()
    }
}

/// Contacts of one body: their number, and the sum of the roots of the body's turning compliance
/// at each.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ContactSum {
    count: f64,
    /// Σ √a [kg^-½], a being the turning compliance.
    turning: f64,
}

impl ContactSum {
    /// Adds a contact where √a [kg^-½] is the root of the body's turning compliance.
    pub(super) fn add(&mut self, turning: f64) {
        self.count += 1.0;
        self.turning += turning;
    }

    /// The sum of a body's contacts and its mirror image's.
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            turning: self.turning + other.turning,
        }
    }

    /// Compliance of a body to unit forces at all of these contacts.
    pub(super) fn compliance(&self, body: &Body) -> BodyCompliance {
        if !body.is_free() {
            return BodyCompliance::default();
        }
        BodyCompliance {
            translation: self.count / body.mass,
            turning: self.turning,
        }
    }
}

/// Compliance of a body to unit forces at all of its contacts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BodyCompliance {
    /// Compliance in translation [1/kg].
    translation: f64,
    /// Σ √a of its contacts [kg^-½].
    turning: f64,
}

impl BodyCompliance {
    /// Bound of the acceleration where √a [kg^-½] is the root of the turning compliance [1/kg], by
    /// Cauchy's inequality.
    pub(super) fn at(&self, turning: f64) -> f64 {
        self.translation + self.turning * turning
    }
}
