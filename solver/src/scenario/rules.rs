//! Every number of a scenario but those of shapes (`shape.rs`): key, range, unit, default. The
//! same table is in `docs/scenario.md`; a test keeps both consistent.
//!
//! Upper and lower limits are generous. They exclude mistakes (metres for millimetres) and
//! numbers beyond the range of single precision, not unusual scenes.

use super::range::{Rule, closed, positive_up_to};
use std::ops::RangeInclusive;

/// Longest title [characters].
pub(super) const TITLE_LENGTH: usize = 200;
/// Longest run [s].
pub(super) const LONGEST: f64 = 3600.0;
/// Most bodies of one scenario.
pub(super) const BODIES: usize = 256;
/// Most samples of all bodies together: about 100 MB of trajectory.
pub(super) const BODY_SAMPLES: f64 = 500_000.0;
/// Most JSON values in one document, about twice the need of the most bodies of the most points.
pub(super) const VALUES: usize = 80_000;
/// Most violations listed in one answer.
pub(super) const VIOLATIONS: usize = 500;
/// Tolerance of a quaternion's length, within which it is normalised.
pub(super) const QUATERNION_SLACK: f64 = 1e-3;
/// Overlap with walls and bodies that counts as contact, as a fraction of the sphero radius:
/// for coordinates typed with a few digits, and less than the overlap of a body at rest.
pub(super) const TOUCHING: f64 = 1e-3;
/// Number of rows of a prescribed motion.
pub(super) const MOTION_TIMES: RangeInclusive<usize> = 1..=1000;
/// Least sound speed over √(g H) of the release: its own weight then takes a third of
/// its volume.
pub(super) const SOFTEST: f64 = std::f64::consts::SQRT_2;
/// Least sound speed over the speed that the flow may reach: a flow that strikes a wall head-on
/// at half its own sound speed loses half its volume; at twice it, it need not be head-on.
pub(super) const SLOWEST_SOUND: f64 = 0.5;
/// Least sound speed over the speed of a prescribed motion, √6: a wall of that speed v that
/// is driven into the flow sends off a shock of speed U, U (U − v) = c² by (3), behind which
/// a third of the volume is gone at U = 3 v.
pub(super) const SLOWEST_SOUND_DRIVEN: f64 = 2.449_489_742_783_178;
/// Largest overlap of a body at rest on one vertex, over its sphero radius.
pub(super) const DEEPEST_AT_REST: f64 = 0.5;
/// Largest overlap of a body in an impact of one vertex as fast as it starts or falls, over its
/// sphero radius: from 1 on its core is in the wall.
pub(super) const DEEPEST_AT_IMPACT: f64 = 0.9;
/// A body's thickness over its default sphero radius.
pub(super) const SIZE_PER_SPHERO_RADIUS: f64 = 20.0;

const METRE: &str = "m";
const DEGREE: &str = "°";
const DENSITY: &str = "kg/m³";
const PASCAL: &str = "Pa";
const SECOND: &str = "s";
const SPEED: &str = "m/s";

pub(super) const fn metres(key: &'static str, low: f64, high: f64) -> Rule {
    Rule::new(key, closed(low, high)).unit(METRE)
}

const fn friction(key: &'static str, default: f64) -> Rule {
    Rule::new(key, closed(0.0, 10.0)).default(default)
}

const fn restitution(key: &'static str, default: f64) -> Rule {
    Rule::new(key, closed(0.0, 1.0)).default(default)
}

const fn modulus(key: &'static str) -> Rule {
    Rule::new(key, closed(1e2, 1e12)).unit(PASCAL)
}

pub(super) const GRAVITY: Rule = Rule::new("gravity_m_s2", closed(0.01, 1e3))
    .unit("m/s²")
    .default(9.81);
pub(super) const DURATION: Rule = Rule::new("duration_s", closed(0.0, LONGEST)).unit(SECOND);
pub(super) const SAMPLE_INTERVAL: Rule = Rule::new("sample_interval_s", closed(1e-5, 3600.0))
    .unit(SECOND)
    .default(0.01);
pub(super) const FLOW_SNAPSHOTS: Rule =
    Rule::new("flow_snapshots", closed(0.0, 200.0)).default(61.0);
pub(super) const FLOW_SNAPSHOT_POINTS: Rule =
    Rule::new("flow_snapshot_points", closed(1.0, 20_000.0)).default(5_000.0);

pub(super) const INCLINATION: Rule = Rule::new("inclination_deg", closed(0.0, 89.0)).unit(DEGREE);
pub(super) const INCLINE_LENGTH: Rule = metres("incline_length_m", 1e-3, 1e3);
pub(super) const RUNOUT_LENGTH: Rule = metres("runout_length_m", 1e-3, 1e3);
pub(super) const WIDTH: Rule = metres("width_m", 1e-3, 1e3).default(0.2);
pub(super) const BASE_FRICTION: Rule = friction("base_friction", 0.4);
pub(super) const SIDE_FRICTION: Rule = friction("side_friction", 0.0);

pub(super) const VOLUME: Rule = Rule::new("volume_m3", closed(0.0, 1e6)).unit("m³");
pub(super) const RELEASE_HEIGHT: Rule = metres("height_m", 1e-6, 1e2).default(0.15);
pub(super) const TOE_DISTANCE: Rule = metres("toe_distance_m", 0.0, 1e3).default(0.05);

pub(super) const BULK_DENSITY: Rule = Rule::new("bulk_density_kg_m3", closed(1.0, 1e5))
    .unit(DENSITY)
    .default(1500.0);
pub(super) const GRAIN_DENSITY: Rule = Rule::new("grain_density_kg_m3", closed(1.0, 1e5))
    .unit(DENSITY)
    .default(2600.0);
pub(super) const GRAIN_DIAMETER: Rule = metres("grain_diameter_m", 1e-9, 1.0).default(0.001);
pub(super) const STATIC_FRICTION: Rule = friction("static_friction", 0.6);
pub(super) const LIMITING_FRICTION: Rule = friction("limiting_friction", 0.86);
pub(super) const INERTIAL_NUMBER: Rule =
    Rule::new("reference_inertial_number", closed(1e-9, 1e3)).default(0.279);
pub(super) const POISSONS_RATIO: Rule = Rule::new("poissons_ratio", closed(0.0, 0.49)).default(0.3);
pub(super) const YOUNGS_MODULUS: Rule = modulus("youngs_modulus_pa");

pub(super) const SPHERO_RADIUS: Rule = metres("sphero_radius_m", 1e-6, 50.0);
pub(super) const BODY_DENSITY: Rule = Rule::new("density_kg_m3", closed(0.1, 1e6))
    .unit(DENSITY)
    .default(2000.0);
pub(super) const DOWNSTREAM: Rule = metres("downstream_m", -1e3, 1e3);
pub(super) const LATERAL: Rule = metres("lateral_m", -1e3, 1e3).default(0.0);
pub(super) const ELEVATION: Rule = metres("elevation_m", 0.0, 1e5);
pub(super) const EAST: Rule = metres("east_m", -1e8, 1e8);
pub(super) const NORTH: Rule = metres("north_m", -1e8, 1e8);
pub(super) const TERRAIN_ELEVATION: Rule = metres("elevation_m", -1e4, 1e5);
pub(super) const CORNER: Rule = metres("polygon_m", -1e8, 1e8);
/// Number of corners of a release's polygon.
pub(super) const CORNERS: RangeInclusive<usize> = 3..=1000;
/// Most releases on a terrain.
pub(super) const RELEASES: usize = 64;
pub(super) const THICKNESS: Rule = metres("thickness_m", 1e-6, 1e3);
pub(super) const RELEASE_TIME: Rule = Rule::new("time_s", closed(0.0, LONGEST))
    .unit(SECOND)
    .default(0.0);
pub(super) const YAW: Rule = Rule::new("yaw_deg", closed(-360.0, 360.0))
    .unit(DEGREE)
    .default(0.0);
pub(super) const ORIENTATION: Rule = Rule::new("orientation", closed(-1.01, 1.01));
pub(super) const VELOCITY: Rule = Rule::new("velocity_m_s", closed(-1e3, 1e3))
    .unit(SPEED)
    .default(0.0);
pub(super) const ANGULAR_VELOCITY: Rule = Rule::new("angular_velocity_rad_s", closed(-1e5, 1e5))
    .unit("rad/s")
    .default(0.0);
pub(super) const MOTION_TIME: Rule = Rule::new("times_s", closed(0.0, 3600.0)).unit(SECOND);
pub(super) const FRICTION: Rule = friction("friction", 0.4);
pub(super) const RESTITUTION: Rule = restitution("restitution", 0.3);
pub(super) const ROLLING_FRICTION: Rule = friction("rolling_friction", 0.0);
pub(super) const FLOW_FRICTION: Rule = friction("flow_friction", 0.4);
pub(super) const FLOW_RESTITUTION: Rule = restitution("flow_restitution", 0.0);
pub(super) const CONTACT_MODULUS: Rule = modulus("contact_modulus_pa");

pub(super) const CELL_SIZE: Rule = metres("cell_size_m", 1e-5, 100.0);
pub(super) const POINTS_PER_CELL: Rule =
    Rule::new("points_per_cell", closed(1.0, 64.0)).default(8.0);
pub(super) const SOUND_SPEED: Rule = Rule::new("sound_speed_m_s", closed(0.1, 1e4)).unit(SPEED);
pub(super) const COURANT: Rule = Rule::new("courant", positive_up_to(0.9));
pub(super) const FLOW_COURANT: Rule = Rule::new("flow_courant", positive_up_to(1.0));
pub(super) const THREADS: Rule = Rule::new("threads", closed(1.0, 1024.0));

pub(super) const TARGET: Rule = Rule::new("target", closed(1e-3, 1.0));
pub(super) const TARGET_BODY: Rule = Rule::new("body", closed(0.0, 255.0)).default(0.0);
pub(super) const BUDGET: Rule = Rule::new("budget_point_steps", closed(1e3, 1e15)).default(2e10);
