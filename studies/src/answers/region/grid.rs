//! Density on a grid.

use super::atoms;
use super::polygon::{self, Polygon};
use serde::{Deserialize, Serialize};

/// Nodes for each bandwidth.
const NODES_PER_BANDWIDTH: f64 = 3.0;
/// Most nodes along an axis.
const MOST_NODES: usize = 256;
/// Distance in bandwidths up to which a kernel reaches, and by which the grid surrounds the
/// places.
const REACH: f64 = 5.0;

/// Density of resting places at the nodes of a grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct DensityGrid {
    /// First node, downstream and across [m].
    pub origin_m: [f64; 2],
    /// Distances of the nodes [m].
    pub spacing_m: [f64; 2],
    /// Numbers of nodes.
    pub nodes: [usize; 2],
    /// Density at the nodes [1/m²], the first axis fastest.
    pub density_per_m2: Vec<f64>,
}

/// Product of Gaussian kernels on a grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Kernel {
    /// Bandwidths, at least the distance of the nodes [m].
    pub(super) bandwidth_m: [f64; 2],
    origin_m: [f64; 2],
    spacing_m: [f64; 2],
    nodes: [usize; 2],
    /// Kernel along each axis at 0, 1, 2, … nodes from its centre [1/m].
    profiles: [Vec<f64>; 2],
}

/// Node below a place along an axis, and how far beyond it the place is in nodes.
type Cell = (usize, f64);

impl Kernel {
    /// Kernel of given bandwidths on a grid around places.
    pub(super) fn over(places_m: &[[f64; 2]], bandwidth_m: [f64; 2]) -> Self {
        let lengths = [0, 1]
            .map(|axis| atoms::extent(places_m, axis) + 2.0 * (REACH + 1.0) * bandwidth_m[axis]);
        let nodes = [0, 1].map(|axis| {
            let nodes = (NODES_PER_BANDWIDTH * lengths[axis] / bandwidth_m[axis]).ceil();
            (nodes as usize).clamp(2, MOST_NODES)
        });
        let spacing_m = [0, 1].map(|axis| lengths[axis] / (nodes[axis] - 1) as f64);
        let bandwidth_m = [0, 1].map(|axis| bandwidth_m[axis].max(spacing_m[axis]));
        let origin_m = [0, 1].map(|axis| {
            let along = places_m.iter().map(|place| place[axis]);
            let (low, extent) = (
                along.fold(f64::INFINITY, f64::min),
                atoms::extent(places_m, axis),
            );
            low - 0.5 * (lengths[axis] - extent)
        });
        Self {
            profiles: [0, 1].map(|axis| profile(bandwidth_m[axis], spacing_m[axis])),
            bandwidth_m,
            origin_m,
            spacing_m,
            nodes,
        }
    }

    /// Density of weighted places.
    pub(super) fn density(&self, places_m: &[[f64; 2]], weights: &[f64]) -> DensityGrid {
        let total: f64 = weights.iter().sum();
        let shares: Vec<f64> = weights.iter().map(|weight| weight / total).collect();
        self.sum(places_m, &shares)
    }

    /// Sum of weighted kernels at places. Each place is shared out linearly to the nodes around
    /// it, and the kernel runs over the nodes (Wand 1994), so the work hardly grows with the
    /// places.
    pub(super) fn sum(&self, places_m: &[[f64; 2]], weights: &[f64]) -> DensityGrid {
        let [columns, rows] = self.nodes;
        let mut shares = vec![0.0; columns * rows];
        for (place, weight) in places_m.iter().zip(weights) {
            for (node, share) in self.corners(*place) {
                shares[node] += weight * share;
            }
        }
        let along = convolved(&shares, self.nodes, &self.profiles[0]);
        let across = convolved(
            &transposed(&along, columns),
            [rows, columns],
            &self.profiles[1],
        );
        DensityGrid {
            origin_m: self.origin_m,
            spacing_m: self.spacing_m,
            nodes: self.nodes,
            density_per_m2: transposed(&across, rows),
        }
    }

    /// Integral of the squared kernel [1/m²].
    pub(super) fn square_integral(&self) -> f64 {
        let along = |axis: usize| {
            let profile = &self.profiles[axis];
            let squares: f64 = profile.iter().map(|height| height * height).sum();
            self.spacing_m[axis] * (2.0 * squares - profile[0] * profile[0])
        };
        along(0) * along(1)
    }

    /// Density at a place, linear between the nodes.
    pub(super) fn at(&self, density: &DensityGrid, place_m: [f64; 2]) -> f64 {
        let corners = self.corners(place_m).into_iter();
        corners
            .map(|(node, share)| share * density.density_per_m2[node])
            .sum()
    }

    /// Density at a place due to that place itself, if it had all the weight [1/m²].
    pub(super) fn own(&self, place_m: [f64; 2]) -> f64 {
        let along = |axis: usize| {
            let (_, beyond) = self.cell(place_m, axis);
            let both = beyond * (1.0 - beyond);
            let profile = &self.profiles[axis];
            (1.0 - 2.0 * both) * profile[0] + 2.0 * both * profile[1]
        };
        along(0) * along(1)
    }

    /// Nodes around a place with their linear shares.
    fn corners(&self, place_m: [f64; 2]) -> [(usize, f64); 4] {
        let ((column, x), (row, y)) = (self.cell(place_m, 0), self.cell(place_m, 1));
        let node = column + self.nodes[0] * row;
        let above = node + self.nodes[0];
        [
            (node, (1.0 - x) * (1.0 - y)),
            (node + 1, x * (1.0 - y)),
            (above, (1.0 - x) * y),
            (above + 1, x * y),
        ]
    }

    fn cell(&self, place_m: [f64; 2], axis: usize) -> Cell {
        let node = (place_m[axis] - self.origin_m[axis]) / self.spacing_m[axis];
        let below = node.floor().clamp(0.0, (self.nodes[axis] - 2) as f64);
        (below as usize, (node - below).clamp(0.0, 1.0))
    }
}

impl DensityGrid {
    /// Outline of the area with a density of at least a level.
    pub(super) fn polygons(&self, level_per_m2: f64) -> Vec<Polygon> {
        polygon::outline(self, level_per_m2)
    }

    /// Area with a density of at least a level, by its nodes [m²].
    pub(super) fn area_above(&self, level_per_m2: f64) -> f64 {
        let above = self
            .density_per_m2
            .iter()
            .filter(|one| **one >= level_per_m2);
        above.count() as f64 * self.node_area()
    }

    /// Probability where the density is at least a level, by its nodes.
    pub(super) fn probability_above(&self, level_per_m2: f64) -> f64 {
        let above = self
            .density_per_m2
            .iter()
            .filter(|one| **one >= level_per_m2);
        above.sum::<f64>() * self.node_area()
    }

    /// Integral of the squared density [1/m²].
    pub(super) fn square_integral(&self) -> f64 {
        let squares = self.density_per_m2.iter().map(|one| one * one);
        squares.sum::<f64>() * self.node_area()
    }

    fn node_area(&self) -> f64 {
        self.spacing_m[0] * self.spacing_m[1]
    }
}

/// Gaussian kernel at 0, 1, 2, … nodes from its centre, which adds up to one over the nodes [1/m].
fn profile(bandwidth: f64, spacing: f64) -> Vec<f64> {
    let reach = (REACH * bandwidth / spacing).floor().max(1.0) as usize;
    let height = |node: usize| {
        let z = node as f64 * spacing / bandwidth;
        libm::exp(-0.5 * z * z)
    };
    let heights: Vec<f64> = (0..=reach).map(height).collect();
    let sum = spacing * (2.0 * heights.iter().sum::<f64>() - heights[0]);
    heights.iter().map(|height| height / sum).collect()
}

/// Values on a grid with the profile run over each of its rows.
fn convolved(values: &[f64], [columns, _]: [usize; 2], profile: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; values.len()];
    let rows = values.chunks(columns).zip(sums.chunks_mut(columns));
    for (row, sums) in rows {
        for (node, value) in row.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            let first = (node + 1).saturating_sub(profile.len());
            let end = (node + profile.len()).min(columns);
            for (other, sum) in sums.iter_mut().enumerate().take(end).skip(first) {
                *sum += value * profile[other.abs_diff(node)];
            }
        }
    }
    sums
}

/// Grid with rows and columns exchanged.
fn transposed(values: &[f64], columns: usize) -> Vec<f64> {
    let rows = values.len() / columns;
    let place = |index: usize| values[index / rows + columns * (index % rows)];
    (0..values.len()).map(place).collect()
}
