//! The vertical walls, and the images of nodes in them.

use super::Plane;
use super::nodes::NodeAccess;
use std::iter::once;

/// The vertical walls, on planes of nodes: ends at index 0 along x, sides at
/// index 0 and half of `halves_across` along y.
#[derive(Debug, Clone, PartialEq)]
pub struct VerticalWalls {
    /// Boundary at index 0 along x.
    pub ends: Ends,
    /// The side walls.
    pub sides: [VerticalBoundary; 2],
    /// Cells between the side walls, twice; odd where the second is a mirror halfway
    /// between two nodes.
    pub halves_across: i32,
}

/// Boundaries of the flow along x.
#[derive(Debug, Clone, PartialEq)]
pub enum Ends {
    /// A boundary at the back; the front is open.
    Back(VerticalBoundary),
    /// A periodic boundary: flow that leaves after `cells` cells enters at the back. Energy and
    /// angular momentum of such a flow can't be audited.
    Seam {
        /// Cells from end to end.
        cells: i32,
    },
}

/// Vertical boundary of the flow.
#[derive(Debug, Clone, PartialEq)]
pub enum VerticalBoundary {
    /// A wall, from which flow can separate.
    Wall(Plane),
    /// A plane of symmetry, with the rest of the flow behind it.
    Symmetry(Plane),
}

impl VerticalBoundary {
    /// The plane of either.
    pub fn plane(&self) -> &Plane {
        match self {
            VerticalBoundary::Wall(plane) | VerticalBoundary::Symmetry(plane) => plane,
        }
    }

    /// True for a wall.
    fn is_wall(&self) -> bool {
        matches!(self, VerticalBoundary::Wall(_))
    }
}

/// Cells across the whole channel from which on flow can separate from its sides: then no node
/// has images in both boundaries of the computed half.
const SIDES_APART: i32 = 6;

/// Position of a constraint set of nodes at a vertical wall; `inward` is the sign of the wall's
/// normal along its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Meets {
    Not,
    /// Up to one node away, so that its image is behind the wall.
    Near {
        inward: i8,
    },
    /// On the wall's plane.
    On {
        inward: i8,
    },
}

impl Meets {
    /// Pressure's impulse on the nodes on the wall over that on these, by their masses: the
    /// kernel gives 3/4 of it to half a cell, and 1/4 to a cell and its image.
    pub(super) fn share_of_pressure(self) -> f64 {
        match self {
            Meets::Near { .. } => 6.0,
            Meets::Not | Meets::On { .. } => 1.0,
        }
    }

    /// Share of the kernel on the channel's side, images counted with it.
    pub(super) fn room(self) -> f64 {
        match self {
            Meets::On { .. } => 0.5,
            Meets::Not | Meets::Near { .. } => 1.0,
        }
    }
}

impl VerticalWalls {
    /// The master node in the channel of a node (itself, mostly); across a periodic boundary the
    /// first that has a block.
    pub(super) fn master(&self, [i, j, k]: [i32; 3], nodes: &impl NodeAccess) -> [i32; 3] {
        let j = j.abs();
        let j = if 2 * j > self.halves_across {
            self.behind_far_side(j)
        } else {
            j
        };
        let i = match self.ends {
            Ends::Back(_) => i.abs(),
            Ends::Seam { cells } => {
                let there = |i: &i32| nodes.place_of([*i, j, k]).is_some();
                let first = i.rem_euclid(cells);
                let mut alike = once(first).chain(across_period(first, cells));
                alike.find(there).unwrap_or(first)
            }
        };
        [i, j, k]
    }

    /// True if a node has images in reach of the kernel.
    pub(super) fn has_images(&self, [i, j, _]: [i32; 3]) -> bool {
        let along = match self.ends {
            Ends::Back(_) => i == 1,
            Ends::Seam { cells } => across_period(i, cells).next().is_some(),
        };
        along || j == 1 || self.is_before_far_side(j)
    }

    /// The image of row `j` of nodes in the second side.
    fn behind_far_side(&self, j: i32) -> i32 {
        self.halves_across - j
    }

    /// True if the image of row `j` in the second side is in reach of the kernel.
    fn is_before_far_side(&self, j: i32) -> bool {
        (1..=2).contains(&(self.halves_across - 2 * j))
    }

    /// Visits the images in reach of the kernel, one node behind a wall.
    pub(super) fn for_each_image(
        &self,
        [i, j, k]: [i32; 3],
        mut visit: impl FnMut([i32; 3], [i8; 2]),
    ) {
        let (mirror, period) = match self.ends {
            Ends::Back(_) => ((i == 1).then_some((-i, -1)), None),
            Ends::Seam { cells } => (None, Some(cells)),
        };
        let repeats = period.into_iter().flat_map(|cells| across_period(i, cells));
        let along_x = once((i, 1)).chain(mirror).chain(repeats.map(|i| (i, 1)));
        let along_y = [
            Some((j, 1)),
            (j == 1).then_some((-j, -1)),
            self.is_before_far_side(j)
                .then_some((self.behind_far_side(j), -1)),
        ];
        for (x, (i, sign_x)) in along_x.enumerate() {
            for (y, &(j, sign_y)) in along_y.iter().flatten().enumerate() {
                if x + y > 0 {
                    visit([i, j, k], [sign_x, sign_y]);
                }
            }
        }
    }

    /// True if they may act on a node between these two.
    pub(super) fn may_act_between(&self, first: [i32; 3], last: [i32; 3]) -> bool {
        let ends = match self.ends {
            Ends::Back(_) => first[0] <= 1,
            Ends::Seam { cells } => first[0] <= 1 || last[0] >= cells - 1,
        };
        ends || first[1] <= 1 || 2 * last[1] >= self.halves_across - 2
    }

    /// Positions of a node at the back and at the sides.
    pub(super) fn meets(&self, index: [i32; 3]) -> [Meets; 2] {
        [self.meets_back(index), self.meets_side(index)]
    }

    fn meets_back(&self, [i, ..]: [i32; 3]) -> Meets {
        match self.ends {
            Ends::Back(_) => meets(2 * i, 1),
            Ends::Seam { .. } => Meets::Not,
        }
    }

    fn meets_side(&self, [_, j, _]: [i32; 3]) -> Meets {
        let from_far_side = self.halves_across - 2 * j;
        if from_far_side < 2 * j {
            meets(from_far_side, -1)
        } else {
            meets(2 * j, 1)
        }
    }

    /// Their planes: the back, then the sides.
    pub(super) fn planes(&self) -> impl Iterator<Item = &Plane> {
        let back = match &self.ends {
            Ends::Back(bound) => Some(bound.plane()),
            Ends::Seam { .. } => None,
        };
        back.into_iter()
            .chain(self.sides.iter().map(VerticalBoundary::plane))
    }

    /// True if the boundary along x is periodic.
    pub fn is_periodic(&self) -> bool {
        matches!(self.ends, Ends::Seam { .. })
    }

    /// Number of cells by which a place `along` cells from the back is moved into the period of a
    /// periodic boundary.
    pub fn periodic_shift(&self, along: f64) -> Option<i32> {
        let Ends::Seam { cells } = self.ends else {
            return None;
        };
        let outside = (along / f64::from(cells)).floor();
        (outside != 0.0).then_some(-(outside as i32) * cells)
    }

    /// Friction of the wall across an axis whose normal has this sign.
    pub(super) fn friction(&self, axis: usize, inward: i8) -> f64 {
        match (&self.ends, axis) {
            (Ends::Back(bound), 0) => bound.plane().flow_friction,
            (Ends::Seam { .. }, 0) => 0.0,
            _ => self.side(inward).plane().flow_friction,
        }
    }

    /// True if flow can separate from the boundary across an axis whose normal has this sign.
    pub(super) fn lets_go(&self, axis: usize, inward: i8) -> bool {
        match (&self.ends, axis) {
            (Ends::Back(bound), 0) => bound.is_wall(),
            (Ends::Seam { .. }, 0) => false,
            _ => self.side(inward).is_wall() && self.cells_across() >= SIDES_APART,
        }
    }

    /// Cells across the whole channel.
    fn cells_across(&self) -> i32 {
        match &self.sides[1] {
            VerticalBoundary::Wall(_) => self.halves_across / 2,
            VerticalBoundary::Symmetry(_) => self.halves_across,
        }
    }

    fn side(&self, inward: i8) -> &VerticalBoundary {
        &self.sides[usize::from(inward < 0)]
    }
}

/// The other nodes along x that are the same across a periodic boundary of `cells` cells and
/// within the kernel's reach.
fn across_period(i: i32, cells: i32) -> impl Iterator<Item = i32> {
    let first = i.rem_euclid(cells) - cells;
    let alike = (0..4).map(move |period| first + period * cells);
    alike.filter(move |alike| *alike != i && (-1..=cells + 1).contains(alike))
}

/// Position at a wall of a node so many halves of a cell from it.
fn meets(halves: i32, inward: i8) -> Meets {
    match halves {
        0 => Meets::On { inward },
        1 | 2 => Meets::Near { inward },
        _ => Meets::Not,
    }
}
