//! Case 2: mass properties of rounded solids.
//!
//! A cube of side L rounded with r is a cube of side a = L − 2r swept by a ball
//! of r. It consists of the core, six slabs on its faces, twelve quarter
//! cylinders along its edges and eight octants of a ball (Steiner 1840):
//!
//! V = a³ + 6 a² r + 3π a r² + 4/3 π r³
//!
//! and ∫ x² dV is, by parts,
//!
//! core a⁵/12, slabs across x ⅔ a² [(a/2 + r)³ − (a/2)³], slabs along x a⁴ r/3,
//! edges along x π r² a³/12, edges across x 2a [π r² a²/4 + 4/3 a r³ + π r⁴/4],
//! octants π a² r³/3 + π a r⁴/2 + 4/15 π r⁵;
//!
//! the moment of inertia is ρ times twice that. The solver integrates any convex
//! core instead, over its faces, edges and vertices. Tolerances: 1e-4 against the
//! design's table, whose figures have five digits; rounding, 1e-12, against the
//! closed form.
//!
//! The regular solids, a box and a boulder without any symmetry are integrated
//! over rays from the centre of mass instead: with R(u) the way to the rounded
//! surface along a unit vector u,
//!
//! V = ⅓ ∫ R³ dΩ,  ∫ x dV = ¼ ∫ R⁴ u dΩ = 0,  ∫ x xᵀ dV = ⅕ ∫ R⁵ u uᵀ dΩ.
//!
//! R solves distance(R u) = r, with the distance from the core used for the
//! contacts, which is independent of Steiner's formula. The midpoint rule on 400 × 800 rays
//! of a surface without edges is good to about 1e-5; tolerance 1e-4.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Cost};
use crate::verify::{Case, Effort, How};
use scree_solver::math::{Mat3, Vec3};
use scree_solver::shape::{RegularSolid, ShapeError, SharpPolyhedron, SpheroPolyhedron};
use std::f64::consts::PI;
use std::time::Instant;

pub(super) const CASE: Case = Case {
    name: "mass",
    number: "2",
    title: "volume and inertia of rounded solids",
    source: "Steiner's decomposition: the design's table, and summed in closed form; other solids along rays",
    how: How::Runs(run),
};

const SIDE: f64 = 0.04;

/// Radius [m], V/L³ and I/(ρ L⁵/6).
const TABLE: [(f64, [f64; 2]); 3] = [
    (0.004, [0.97559, 0.94807]),
    (0.002, [0.99373, 0.98603]),
    (0.001, [0.99841, 0.99638]),
];

fn run(_: Effort, findings: &mut Findings) {
    for (radius, table) in TABLE {
        let resolution = Resolution::named(format!("r {:.0} mm", radius * 1e3));
        let sources = [
            ("table", table, 1e-4),
            ("closed form", closed(radius), 1e-12),
        ];
        for (source, [volume, inertia], tolerance) in sources {
            let questions = [
                Question::new(format!("V/L³, {source}"), "", volume).within(tolerance),
                Question::new(format!("I/(ρL⁵/6), {source}"), "", inertia).within(tolerance),
            ];
            findings.take(&resolution, questions, measured(radius));
        }
    }
    match solids() {
        Ok(solids) => {
            for (name, body) in &solids {
                findings.take(
                    &Resolution::named(*name),
                    along_rays(body),
                    Ok(solved(body)),
                );
            }
        }
        Err(error) => {
            let unanswered = Question::new("V", "m³", f64::NAN).within(1e-4);
            findings.take(&Resolution::named("solids"), [unanswered], Err(error));
        }
    }
}

/// Solids of a few cm, rounded with a fifth of their inradius, the box with more.
fn solids() -> Result<Vec<(&'static str, SpheroPolyhedron)>, CaseError> {
    const BOULDER: [[f64; 3]; 7] = [
        [0.0, 0.0, 0.0],
        [0.04, 0.0, 0.0],
        [0.01, 0.03, 0.0],
        [0.045, 0.012, 0.018],
        [0.012, 0.035, 0.015],
        [-0.004, 0.004, 0.02],
        [0.02, 0.012, 0.032],
    ];
    let rounded = |sharp: SharpPolyhedron| sharp.rounded(0.2 * sharp.inradius());
    let regular = |solid| SharpPolyhedron::regular(solid, SIDE).and_then(rounded);
    let boulder = SharpPolyhedron::hull_of(&BOULDER.map(Vec3::from));
    let solids = [
        ("tetrahedron", regular(RegularSolid::Tetrahedron)),
        ("octahedron", regular(RegularSolid::Octahedron)),
        ("dodecahedron", regular(RegularSolid::Dodecahedron)),
        ("icosahedron", regular(RegularSolid::Icosahedron)),
        ("box", SpheroPolyhedron::cuboid([0.02, 0.03, 0.06], 0.004)),
        ("boulder", boulder.and_then(rounded)),
    ];
    let checked = solids.map(|(name, body)| Ok((name, body?)));
    let checked = checked.into_iter().collect::<Result<_, ShapeError>>();
    checked.map_err(|error| CaseError::Scene(error.to_string()))
}

/// Volume, largest and smallest principal moment for density 1, and distance of the
/// centre of mass from the origin, by the solver.
fn solved(body: &SpheroPolyhedron) -> Answer<4> {
    let start = Instant::now();
    let moments = body.unit_inertia().symmetric_eigenvalues();
    let cost = Cost {
        wall_s: start.elapsed().as_secs_f64(),
        point_steps_per_s: None,
    };
    Answer {
        values: [body.volume(), moments.max(), moments.min(), 0.0],
        cost,
    }
}

/// The same quantities, by integration along rays.
fn along_rays(body: &SpheroPolyhedron) -> [Question; 4] {
    const BELTS: u32 = 400;
    let (mut volume, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
    let angle = |place: u32| PI * (f64::from(place) + 0.5) / f64::from(BELTS);
    for belt in 0..BELTS {
        let (across, z) = angle(belt).sin_cos();
        let share = 2.0 * across * angle(0).sin() * PI / f64::from(BELTS);
        for place in 0..2 * BELTS {
            let (sin, cos) = angle(place).sin_cos();
            let ray = Vec3::new(across * cos, across * sin, z);
            let way = way_out(body, &ray);
            volume += share * way.powi(3) / 3.0;
            first += ray * (share * way.powi(4) / 4.0);
            second += ray * ray.transpose() * (share * way.powi(5) / 5.0);
        }
    }
    let moments = (Mat3::identity() * second.trace() - second).symmetric_eigenvalues();
    let off_centre = (first / volume).norm();
    let of_size = Error::Over {
        of: "the bounding radius",
        size: body.bounding_radius(),
    };
    [
        Question::new("V, along rays", "m³", volume).within(1e-4),
        Question::new("largest I/ρ, along rays", "m⁵", moments.max()).within(1e-4),
        Question::new("smallest I/ρ, along rays", "m⁵", moments.min()).within(1e-4),
        Question::new("centre of mass, along rays", "m", off_centre)
            .by(of_size)
            .within(1e-4),
    ]
}

/// Distance from the centre of mass to the rounded surface along a unit vector [m]: by
/// Newton's method from outside, which can't overshoot since the distance is
/// convex.
fn way_out(body: &SpheroPolyhedron, ray: &Vec3) -> f64 {
    let mut way = body.bounding_radius();
    for _ in 0..50 {
        let closest = body.closest_feature(&(ray * way));
        let step = (closest.distance - body.sphero_radius()) / closest.normal.dot(ray);
        way -= step;
        if step < 1e-12 * way {
            break;
        }
    }
    way
}

fn measured(radius: f64) -> Result<Answer<2>, CaseError> {
    let start = Instant::now();
    let cube = SpheroPolyhedron::cube(SIDE, radius)
        .map_err(|error| CaseError::Scene(error.to_string()))?;
    let inertia = cube.unit_inertia().m11;
    let values = [cube.volume() / SIDE.powi(3), inertia * 6.0 / SIDE.powi(5)];
    let cost = Cost {
        wall_s: start.elapsed().as_secs_f64(),
        point_steps_per_s: None,
    };
    Ok(Answer { values, cost })
}

/// V/L³ and I/(ρ L⁵/6) of the module comment.
fn closed(r: f64) -> [f64; 2] {
    let a = SIDE - 2.0 * r;
    let volume = a.powi(3) + 6.0 * a * a * r + 3.0 * PI * a * r * r + 4.0 / 3.0 * PI * r.powi(3);
    let slabs_across = 2.0 / 3.0 * a * a * ((0.5 * a + r).powi(3) - (0.5 * a).powi(3));
    let slabs_along = a.powi(4) * r / 3.0;
    let edges_along = PI * r * r * a.powi(3) / 12.0;
    let edges_across =
        2.0 * a * (PI * r * r * a * a / 4.0 + 4.0 / 3.0 * a * r.powi(3) + PI * r.powi(4) / 4.0);
    let octants =
        PI * a * a * r.powi(3) / 3.0 + PI * a * r.powi(4) / 2.0 + 4.0 / 15.0 * PI * r.powi(5);
    let second =
        a.powi(5) / 12.0 + slabs_across + slabs_along + edges_along + edges_across + octants;
    [volume / SIDE.powi(3), 2.0 * second * 6.0 / SIDE.powi(5)]
}
