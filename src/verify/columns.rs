//! Columns of grains that are released on a rough floor.

use super::beads::{
    BULK_DENSITY, FRICTION, GRAIN_DENSITY, GRAIN_DIAMETER, REFERENCE_INERTIAL_NUMBER,
};
use super::findings::{Error, Question};
use super::run::{Answer, CaseError, Run, scene_of};
use super::scenes::{GRAVITY, channel};
use scree_solver::Simulation;
use scree_solver::simulation::Scene;
use serde_json::json;
use std::ops::ControlFlow;

/// Half width of a plane column, radius of a round one [m].
const BASE: f64 = 0.1;
/// Speed below which a point is at rest, in shares of √(g H0).
const REST: f64 = 0.01;
/// Time after which the run of a column ends in any case, in √(H0/g); experiments stop
/// after about 3.3 (Lube et al. 2005).
const LONGEST: f64 = 10.0;
/// Share of the mass beyond the front.
const FRONT_SHARE: f64 = 1e-3;

/// Grains of a column. Densities and grain size are those of the beads: a run-out does not depend
/// on the first, and friction without a rate not on the second.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grains {
    /// Name.
    pub(super) name: &'static str,
    /// Static and limiting friction. Grains yield before they slip on the floor:
    /// its friction is the limiting one.
    pub(super) friction: (f64, f64),
}

impl Grains {
    /// Glass beads.
    pub(super) const BEADS: Self = Self {
        name: "beads",
        friction: FRICTION,
    };
    /// Sand that rests at 32°, independent of its rate.
    pub(super) const SAND: Self = Self {
        name: "sand",
        friction: (0.625, 0.625),
    };
}

/// A column, half of a plane one or a quarter of a round one, at its
/// symmetry planes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// Height over half width or radius.
    pub(super) aspect: f64,
    /// Grains of the column.
    pub(super) grains: Grains,
    /// Cells over half width or radius.
    pub(super) cells: u32,
    /// Points per cell.
    pub(super) per_cell: u32,
    /// Width of the channel over half width or radius; none for a plane column, one cell
    /// wide.
    pub(super) round: Option<f64>,
}

/// Name of the run-out of these grains at this aspect, as a quantity.
pub(super) fn runout(grains: Grains, aspect: f64) -> String {
    format!("run-out, {}, a = {aspect}", grains.name)
}

/// Deposit of a column that came to rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Deposit {
    /// (L∞ − L0)/L0 at the front.
    pub(super) runout: f64,
    /// The run-out with a hundredth of the mass beyond the front.
    pub(super) at_a_hundredth: f64,
    /// The run-out to the place where the deposit is one grain thick.
    pub(super) one_grain_thick: f64,
    /// Share of the mass that was not at rest at the end.
    pub(super) moving: f64,
}

impl Column {
    /// Half of a plane column.
    pub(super) fn plane(grains: Grains, aspect: f64, cells: u32) -> Self {
        Self {
            aspect,
            grains,
            cells,
            per_cell: 8,
            round: None,
        }
    }

    /// Questions to [`Column::answer`], with a `reference` for every run-out.
    pub(super) fn questions(&self, reference: f64) -> [Question; 4] {
        let of = format!("{}, a = {}", self.grains.name, self.aspect);
        let about = |words: &str| Question::new(format!("{words}, {of}"), "", reference);
        [
            Question::new(runout(self.grains, self.aspect), "", reference),
            about("run-out at 1 % of the mass"),
            about("run-out, one grain thick"),
            Question::new(format!("mass still moving, {of}"), "", 0.0).by(Error::Absolute),
        ]
    }

    fn height(&self) -> f64 {
        self.aspect * BASE
    }

    fn cell(&self) -> f64 {
        BASE / f64::from(self.cells)
    }

    fn width(&self) -> f64 {
        self.round.map_or(self.cell(), |width| width * BASE)
    }

    fn longest(&self) -> f64 {
        LONGEST * (self.height() / GRAVITY).sqrt()
    }

    fn scene(&self) -> Result<Scene, CaseError> {
        let (width, height) = (self.width(), self.height());
        // Long enough for the front of the tallest column.
        let mut document = channel(0.0, BASE, 12.0 * BASE, width);
        document["channel"]["base_friction"] = json!(self.grains.friction.1);
        document["flow"] = json!({
            "volume_m3": BASE * height * width,
            "release": {"height_m": height, "toe_distance_m": 0.0},
            "material": {
                "bulk_density_kg_m3": BULK_DENSITY,
                "grain_density_kg_m3": GRAIN_DENSITY,
                "grain_diameter_m": GRAIN_DIAMETER,
                "static_friction": self.grains.friction.0,
                "limiting_friction": self.grains.friction.1,
                "reference_inertial_number": REFERENCE_INERTIAL_NUMBER,
            },
        });
        document["numerics"] = json!({
            "cell_size_m": self.cell(), "points_per_cell": self.per_cell
        });
        document["duration_s"] = json!(self.longest());
        let mut scene = scene_of(&document)?;
        if self.round.is_some() {
            let within = |x: f64, y: f64| x.hypot(y) <= BASE;
            let corner = -0.5 * width;
            scene
                .points
                .retain(|p| within(p.position.x + BASE, p.position.y - corner));
        }
        Ok(scene)
    }

    /// Distance from the symmetry plane or axis [m].
    fn distance(&self, x: f64, y: f64) -> f64 {
        match self.round {
            None => x + BASE,
            Some(_) => (x + BASE).hypot(y + 0.5 * self.width()),
        }
    }

    /// Releases the column and runs until all of it is at rest.
    pub(super) fn collapse(&self) -> Result<(Deposit, Run), CaseError> {
        let mut run = Run::start(self.scene()?)?;
        let slow = REST * (GRAVITY * self.height()).sqrt();
        let begun = 0.1 * self.longest();
        run.watch(f64::INFINITY, |simulation, report| {
            let over =
                report.step_ended && report.time_s > begun && moving(simulation, slow) == 0.0;
            if over {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })?;
        Ok((self.deposit(&run.simulation, slow), run))
    }

    /// Run-outs and moving share of the mass, with their cost.
    pub(super) fn answer(&self) -> Result<Answer<4>, CaseError> {
        let (deposit, run) = self.collapse()?;
        Ok(run.answer([
            deposit.runout,
            deposit.at_a_hundredth,
            deposit.one_grain_thick,
            deposit.moving,
        ]))
    }

    fn deposit(&self, simulation: &Simulation, slow: f64) -> Deposit {
        let mut places = Vec::new();
        simulation.visit_points(None, |point| {
            let distance = self.distance(point.position.x, point.position.y);
            places.push((distance, point.mass));
        });
        places.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
        let runout = |distance: f64| (distance - BASE) / BASE;
        Deposit {
            runout: runout(front(&places, FRONT_SHARE)),
            at_a_hundredth: runout(front(&places, 1e-2)),
            one_grain_thick: runout(self.edge(&places)),
            moving: moving(simulation, slow),
        }
    }

    /// Outer edge of the outermost ring, one cell wide, that is a grain thick [m].
    fn edge(&self, places: &[(f64, f64)]) -> f64 {
        let cell = self.cell();
        let mut rings = Vec::new();
        for &(distance, mass) in places {
            let ring = (distance / cell) as usize;
            if rings.len() <= ring {
                rings.resize(ring + 1, 0.0);
            }
            rings[ring] += mass;
        }
        let thick = |(ring, mass): (usize, &f64)| {
            let (inner, outer) = (ring as f64 * cell, (ring + 1) as f64 * cell);
            let area = match self.round {
                None => cell * self.width(),
                Some(_) => std::f64::consts::FRAC_PI_4 * (outer * outer - inner * inner),
            };
            (mass / (BULK_DENSITY * area) >= GRAIN_DIAMETER).then_some(outer)
        };
        rings
            .iter()
            .enumerate()
            .rev()
            .find_map(thick)
            .unwrap_or(0.0)
    }
}

/// Distance beyond which this share of the mass lies; farthest places first.
fn front(places: &[(f64, f64)], share: f64) -> f64 {
    let all: f64 = places.iter().map(|place| place.1).sum();
    let mut beyond = 0.0;
    for (distance, mass) in places {
        beyond += mass;
        if beyond >= share * all {
            return *distance;
        }
    }
    0.0
}

/// Share of the mass that is faster than this.
fn moving(simulation: &Simulation, slow: f64) -> f64 {
    let (mut all, mut fast) = (0.0, 0.0);
    simulation.visit_points(None, |point| {
        all += point.mass;
        if point.velocity.norm() > slow {
            fast += point.mass;
        }
    });
    fast / all
}
