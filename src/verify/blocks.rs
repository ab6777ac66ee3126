//! Scenes in the solver's own terms: blocks of points at places, and of materials, that no
//! scenario can express.

use scree_solver::bed::PlanarBed;
use scree_solver::kernel::Lattice;
use scree_solver::material::{Material, Yielding};
use scree_solver::math::{Mat3, Sym3, Vec3};
use scree_solver::points::Point;
use scree_solver::scenario::Precision;
use scree_solver::simulation::{Expected, GivenFlow, Guards, Outlet, Scene, Setup, Timing};
use scree_solver::walls::{Ends, Plane, VerticalBoundary, VerticalWalls, Walls};
use std::sync::Arc;

/// Points per cell and axis, as a scenario has them by default.
pub(super) const PER_CELL: u32 = 2;

/// A box of points in a channel with a flat, smooth floor and smooth sides.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Cell size [m].
    pub(super) cell: f64,
    /// Lowest cell, counted from the back, the right side and the floor.
    pub(super) at: [u32; 3],
    /// Cells along each side.
    pub(super) cells: [u32; 3],
    /// Cells between the side walls.
    pub(super) cells_across: u32,
    /// Points per cell and axis.
    pub(super) per_cell: u32,
    /// True if it is periodic along the channel instead of having a back wall and a front.
    pub(super) endless: bool,
    /// Material.
    pub(super) material: Material,
    /// Gravity, downward [m/s²].
    pub(super) gravity: f64,
    /// Speed the flow is expected to reach [m/s].
    pub(super) expected_speed: f64,
    /// Arithmetic.
    pub(super) precision: Precision,
    /// Simulated time [s].
    pub(super) duration: f64,
}

/// The elastic test law with these moduli.
pub(super) fn elastic(bulk_density: f64, youngs_modulus: f64, poissons_ratio: f64) -> Material {
    Material {
        bulk_density,
        bulk_modulus: youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)),
        shear_modulus: youngs_modulus / (2.0 * (1.0 + poissons_ratio)),
        yielding: Yielding::Never,
    }
}

impl Block {
    /// The scene, its points at rest and without stress.
    pub(super) fn scene(&self) -> Scene {
        let points = self.points();
        Scene {
            given: self.given(),
            bodies: Vec::new(),
            points,
            precision: self.precision,
            volume_left_out: 0.0,
            shares: None,
        }
    }

    /// The scene, its points at rest under their weight between smooth walls: with
    /// the stress of an elastic bed, and at the distances of the compressed points.
    pub(super) fn bed(&self, poissons_ratio: f64) -> Scene {
        let mut scene = self.scene();
        let lateral = poissons_ratio / (1.0 - poissons_ratio);
        let height = self.cell * f64::from(self.cells[2]);
        let weight = self.material.bulk_density * self.gravity;
        let strain = (1.0 + 2.0 * lateral) / 3.0 * weight / self.material.bulk_modulus;
        for point in &mut scene.points {
            let z = point.position.z;
            let pressed = weight * (height - z);
            point.volume /= 1.0 + strain * (height - z);
            // Settlement of the layers below, each compressed by its own strain.
            point.position.z -= strain * z * (height - 0.5 * z);
            point.stress.xx = -lateral * pressed;
            point.stress.yy = -lateral * pressed;
            point.stress.zz = -pressed;
        }
        scene
    }

    /// Centre of the block [m].
    pub(super) fn middle(&self) -> Vec3 {
        let lattice = self.lattice();
        let place = |axis: usize| f64::from(self.at[axis]) + 0.5 * f64::from(self.cells[axis]);
        lattice.origin + Vec3::new(place(0), place(1), place(2)) * self.cell
    }

    fn lattice(&self) -> Lattice {
        let half_width = 0.5 * self.cell * f64::from(self.cells_across);
        Lattice {
            origin: Vec3::new(0.0, -half_width, 0.0),
            spacing: Vec3::repeat(self.cell),
        }
    }

    fn point_volume(&self) -> f64 {
        (self.cell / f64::from(self.per_cell)).powi(3)
    }

    fn given(&self) -> Setup {
        let lattice = self.lattice();
        let walls = self.walls();
        Setup {
            identity: String::new(),
            timing: Timing::lasting(self.duration),
            gravity: Vec3::new(0.0, 0.0, -self.gravity),
            planes: walls.planes().copied().collect(),
            walls,
            outlet: Outlet::End(f64::MAX),
            later: None,
            flow: Some(self.flow(self.material.bulk_density * self.expected_speed.powi(2))),
            lattice,
            partners: Vec::new(),
            guards: Guards::ANY_SPEED,
        }
    }

    /// The flow, with this upper bound of its pressure on bodies [Pa].
    pub(super) fn flow(&self, contact_pressure: f64) -> GivenFlow {
        let height = self.cell * f64::from(self.cells[2]);
        let expected = Expected {
            speed: self.expected_speed,
            pressing_speed: self.expected_speed,
            impact_speed: 0.0,
            contact_pressure,
            static_pressure: 0.5 * self.material.bulk_density * self.gravity * height,
        };
        GivenFlow::new(
            self.material,
            &self.lattice(),
            self.point_volume(),
            expected,
        )
    }

    fn walls(&self) -> Walls {
        let symmetry = |normal, distance: f64| {
            VerticalBoundary::Symmetry(Plane {
                name: "plane of symmetry",
                normal,
                offset: -distance,
                flow_friction: 0.0,
            })
        };
        let half_width = 0.5 * self.cell * f64::from(self.cells_across);
        let ends = if self.endless {
            Ends::Seam {
                cells: self.cells[0] as i32,
            }
        } else {
            Ends::Back(symmetry(Vec3::x(), 0.0))
        };
        Walls {
            bed: Arc::new(PlanarBed::floor(0.0)),
            vertical_walls: Some(VerticalWalls {
                ends,
                sides: [
                    symmetry(Vec3::y(), half_width),
                    symmetry(-Vec3::y(), half_width),
                ],
                halves_across: 2 * self.cells_across as i32,
            }),
        }
    }

    fn points(&self) -> Vec<Point> {
        let lattice = self.lattice();
        let spacing = self.cell / f64::from(self.per_cell);
        let [along, across, up] = self.cells.map(|cells| cells * self.per_cell);
        let volume = self.point_volume();
        let mut points = Vec::new();
        for place in 0..along * across * up {
            let index = [place / (across * up), place / up % across, place % up];
            let along = |axis: usize| f64::from(self.at[axis] * self.per_cell + index[axis]) + 0.5;
            points.push(Point {
                id: place,
                mass: self.material.bulk_density * volume,
                volume,
                position: lattice.origin + Vec3::new(along(0), along(1), along(2)) * spacing,
                velocity: Vec3::zeros(),
                affine: Mat3::zeros(),
                stress: Sym3::default(),
            });
        }
        points
    }
}
