//! Places of the images of a computed share of the flow.

use crate::contact::point_body::{Around, FlowLoad};
use crate::math::{Mat3, Vec3};
use crate::points::Point;
use crate::rigid::Load;
use crate::simulation::setup::{Columns, Setup, Share};

/// Images that complete a share of the flow to the whole.
#[derive(Debug, Clone, Copy)]
pub(super) struct Images {
    share: Share,
    /// Cells across the whole channel.
    cells_across: u32,
    /// Width of a cell across [m].
    cell_width: f64,
    /// Rows of points across the whole channel.
    rows: u32,
    /// Points of a row up.
    up: u32,
    /// Rows of points in a cell.
    rows_per_cell: u32,
}

impl Images {
    /// The images that make up the whole channel.
    pub(super) fn of_share(share: Share, columns: &Columns, whole: &Setup) -> Self {
        let cells = whole.walls.halves_across().unsigned_abs() / 2;
        let [_, rows, up] = columns.count;
        Self {
            share,
            cells_across: cells,
            cell_width: whole.lattice.spacing.y,
            rows,
            up,
            rows_per_cell: rows / cells,
        }
    }

    /// Number of them, the share itself included.
    pub(super) fn count(&self) -> u32 {
        match self.share {
            Share::Whole => 1,
            Share::Half => 2,
            Share::Slab => self.cells_across,
        }
    }

    /// Image number `which` of a point; number 0 is the point itself.
    pub(super) fn of(&self, which: u32, point: &Point) -> Point {
        match (which, self.share) {
            (0, _) | (_, Share::Whole) => *point,
            (_, Share::Half) => self.mirrored(point),
            (_, Share::Slab) => self.shifted(which, point),
        }
    }

    /// Box that contains the points whose images `which` are in this box.
    pub(super) fn around(&self, which: u32, around: &Around) -> Around {
        match (which, self.share) {
            (0, _) | (_, Share::Whole) => *around,
            (_, Share::Half) => around.mirrored(),
            (_, Share::Slab) => around.shifted(-self.shift(which)),
        }
    }

    /// Index of a point's row across.
    pub(super) fn row(&self, point: &Point) -> u32 {
        point.id / self.up % self.rows
    }

    fn shift(&self, which: u32) -> f64 {
        f64::from(which) * self.cell_width
    }

    /// Identities count up, then across, then along.
    fn shifted(&self, which: u32, point: &Point) -> Point {
        let mut image = *point;
        image.position.y += self.shift(which);
        image.id += which * self.rows_per_cell * self.up;
        image
    }

    fn mirrored(&self, point: &Point) -> Point {
        let mut image = *point;
        let row = self.row(point);
        image.id = image.id - row * self.up + (self.rows - 1 - row) * self.up;
        image.position.y = -image.position.y;
        image.velocity.y = -image.velocity.y;
        let turn = Mat3::from_diagonal(&Vec3::new(1.0, -1.0, 1.0));
        image.affine = turn * image.affine * turn;
        image.stress.xy = -image.stress.xy;
        image.stress.yz = -image.stress.yz;
        image
    }
}

/// Load of a half flow and its image on a body, from the loads of the half on it and on the
/// body's own image.
pub(super) fn load_of_both(own: &FlowLoad, of_image: &FlowLoad) -> FlowLoad {
    let mirrored = Load {
        force: of_image
            .load
            .force
            .component_mul(&Vec3::new(1.0, -1.0, 1.0)),
        // A torque is mirrored as a pseudo-vector.
        torque: of_image
            .load
            .torque
            .component_mul(&Vec3::new(-1.0, 1.0, -1.0)),
    };
    let mut both = *own;
    both.load.add(&mirrored);
    both.touching_points += of_image.touching_points;
    both.deepest_overlap_ratio = own
        .deepest_overlap_ratio
        .max(of_image.deepest_overlap_ratio);
    both.energy += of_image.energy;
    both
}
