//! From a scenario to a scene: what a run is given, its bodies and its points.

use super::clock::Timing;
use super::guards::Guards;
use crate::contact::island::Surroundings;
use crate::contact::law::ContactLaw;
use crate::contact::point_body::{PointSphere, Reach};
use crate::error::SetupError;
use crate::kernel::Lattice;
use crate::material::{Material, Yielding};
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::{self, Coupling, Precision, Scenario};
use crate::stability::{Limits, Pace};
use crate::walls::{Ends, Plane, Upright, Walls};

mod bodies;
mod reductions;
mod release;
mod resolution;
mod settle;
mod share;
mod symmetry;

use bodies::bodies;
pub use reductions::Reductions;
pub use release::Columns;
pub use resolution::Expected;
pub use share::{Share, Shares};
pub(super) use symmetry::near_body;

/// Default Courant number of the sub-step: a lone point is stable up to 1, a flow up to
/// about 2 (docs/decisions/0021-what-a-step-costs.md).
const COURANT: f64 = 0.8;
/// Default travel of the fastest point per step, in cells.
const FLOW_COURANT: f64 = 0.2;
/// A flow slower than this share of its expected speed is transferred as
/// often as if it had that speed.
const SLOW: f64 = 1.0;
/// Sound speed over the speed whose dynamic pressure is the largest one expected:
/// density varies by its inverse square under steady load.
const STIFFNESS_FACTOR: f64 = 10.0;
/// Overlap of a point and a body, over the point spacing, that carries the largest
/// pressure expected; at this overlap a contact is no stiffer than the material
/// between two points.
const REFERENCE_OVERLAP: f64 = 0.1;
/// Share of a body's own contact time scale allowed per sub-step.
const BODY_CONTACT_SHARE: f64 = 0.5;

/// A scene in the solver's own terms: what a scenario is turned into. Whoever
/// builds one without a scenario answers for it: nothing here is validated.
#[derive(Debug)]
pub struct Scene {
    /// What does not change.
    pub given: Setup,
    /// The bodies at the start.
    pub bodies: Vec<Body>,
    /// The material points at the start.
    pub points: Vec<Point>,
    /// Arithmetic of the flow. The elastic test law is always in f64.
    pub precision: Precision,
    /// Volume not released because a body stands there [m³].
    pub volume_left_out: f64,
    /// Which shares of the flow are computed, its points being those of the first;
    /// `None`: all of it.
    pub shares: Option<Shares>,
}

/// What a run is given; it does not change.
#[derive(Debug, Clone)]
pub struct Setup {
    /// Identity of the scene: a scenario's JSON.
    pub identity: String,
    /// Duration, and what bounds the steps.
    pub timing: Timing,
    /// [m/s²].
    pub gravity: Vec3,
    /// Where the nodes lie.
    pub lattice: Lattice,
    /// The walls as the flow meets them.
    pub walls: Walls,
    /// The walls as bodies meet them.
    pub planes: Vec<Plane>,
    /// Mirror image of each body where half of a symmetric flow is computed; empty
    /// where all is.
    pub partners: Vec<usize>,
    /// x of the open end [m].
    pub open_end: f64,
    /// The flow, if there is one.
    pub flow: Option<GivenFlow>,
    /// What it may not go beyond.
    pub guards: Guards,
}

/// What a run with a flow is given besides.
#[derive(Debug, Clone)]
pub struct GivenFlow {
    /// What it is made of.
    pub material: Material,
    /// What bounds its steps.
    pub limits: Limits,
    /// Spheres that points are to bodies.
    pub sphere: PointSphere,
    /// Pressure over relative overlap δ/l at the reference overlap [Pa].
    contact_modulus: f64,
}

/// A scene without its points: what can be known of a run before it is set up.
#[derive(Debug)]
pub struct Outline {
    /// What does not change.
    pub given: Setup,
    /// The bodies at the start.
    pub bodies: Vec<Body>,
    /// How the release is divided into points; `None` without a flow.
    pub columns: Option<Columns>,
    /// What of it need not be computed.
    pub reductions: Reductions,
}

impl Outline {
    /// The outline of a scenario's scene.
    ///
    /// # Errors
    /// Too many points for one run, or a reduction that the scene does not allow.
    pub fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        let (given, columns) = Setup::of(scenario)?;
        let mut bodies = bodies(scenario, &given);
        let reductions = Reductions::of(scenario, &given, columns.as_ref(), &bodies)?;
        reductions.confine(&mut bodies);
        Ok(Self {
            given,
            bodies,
            columns,
            reductions,
        })
    }

    /// The same with all of it computed, whatever the scenario says.
    ///
    /// # Errors
    /// Too many points for one run.
    pub fn whole(scenario: &Scenario) -> Result<Self, SetupError> {
        let (given, columns) = Setup::of(scenario)?;
        Ok(Self {
            bodies: bodies(scenario, &given),
            given,
            columns,
            reductions: Reductions::none(),
        })
    }
}

impl Scene {
    /// The scene of a scenario, with what its numerics leave out left out.
    ///
    /// # Errors
    /// Too many points for one run, or a reduction that the scene does not allow.
    pub fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        Ok(Self::within(scenario, Outline::of(scenario)?))
    }

    /// The scene of a scenario, all of it computed: one that can be changed by hand
    /// without its reductions becoming wrong.
    ///
    /// # Errors
    /// Too many points for one run.
    pub fn whole(scenario: &Scenario) -> Result<Self, SetupError> {
        Ok(Self::within(scenario, Outline::whole(scenario)?))
    }

    fn within(scenario: &Scenario, outline: Outline) -> Self {
        let share = outline.reductions.first_share();
        let (given, bodies) = (outline.given, outline.bodies);
        let (points, volume_left_out) = match outline.columns {
            Some(columns) => columns.release(scenario, &given, &bodies, share),
            None => (Vec::new(), 0.0),
        };
        Self {
            given,
            bodies,
            points,
            precision: scenario.numerics.precision,
            volume_left_out,
            shares: outline.reductions.shares,
        }
    }
}

impl Setup {
    /// What the run of a scenario is given, and how its release is divided.
    fn of(scenario: &Scenario) -> Result<(Self, Option<Columns>), SetupError> {
        let channel = &scenario.channel;
        let lattice = resolution::lattice(scenario);
        let walls = walls(channel, &lattice);
        let release = scenario.release();
        let columns = release.map(|release| Columns::of(scenario, &lattice, &release));
        let columns = columns.transpose()?;
        let flow = scenario.flow.as_ref().zip(columns.as_ref());
        let flow = flow.map(|(flow, columns)| {
            let material = material(scenario, &flow.material);
            let expected = resolution::expected(scenario);
            let coupling = scenario.numerics.coupling;
            let mut flow = GivenFlow::new(material, &lattice, columns.volume, expected);
            flow.couple(coupling, columns.volume);
            let (numerics, limits) = (&scenario.numerics, &mut flow.limits);
            limits.courant = numerics.courant.unwrap_or(limits.courant);
            limits.flow_courant = numerics.flow_courant.unwrap_or(limits.flow_courant);
            flow
        });
        let given = Self {
            identity: scenario.to_json(),
            timing: Timing::lasting(scenario.duration_s),
            gravity: Vec3::new(0.0, 0.0, -scenario.gravity_m_s2),
            lattice,
            planes: walls.planes().copied().collect(),
            walls,
            partners: Vec::new(),
            open_end: channel.runout_length_m,
            flow,
            guards: guards(scenario),
        };
        Ok((given, columns))
    }

    /// The same between other walls, with the mirror image of each body if one of
    /// them is a mirror.
    pub(super) fn between(&self, walls: Walls, partners: Vec<usize>) -> Self {
        Self {
            walls,
            partners,
            ..self.clone()
        }
    }

    /// How far from a body a point can be at a transfer and still touch it
    /// before the next one [m].
    pub(super) fn contact_reach(&self, bodies: &[Body], pace: &Pace) -> Reach {
        let Some(flow) = &self.flow else {
            return Reach {
                sphere: 0.0,
                travel: 0.0,
            };
        };
        let duration = pace.substep * f64::from(pace.count);
        let body_travel = bodies
            .iter()
            .map(|body| body.speed_ahead() * duration)
            .fold(0.0, f64::max);
        // A step of a single sub-step may go beyond the flow's Courant number.
        let cells = flow.limits.flow_courant.max(flow.limits.courant);
        let flow_travel = cells * flow.limits.cell_size;
        Reach {
            sphere: flow.sphere.radius,
            // Twice both, for what speeds up within the step.
            travel: 2.0 * (flow_travel + body_travel),
        }
    }
}

impl GivenFlow {
    /// A flow of points of this volume [m³] on a lattice, where such speeds and pressures
    /// are expected, at the default Courant numbers.
    pub fn new(
        material: Material,
        lattice: &Lattice,
        point_volume: f64,
        expected: Expected,
    ) -> Self {
        let spacing = point_volume.cbrt();
        let modulus = expected.contact_pressure / REFERENCE_OVERLAP;
        let modulus = modulus.min(material.p_wave_modulus() / 1.5);
        // Hertz: (δ/δ_ref)^1.5 is the pressure over that at the reference overlap.
        let share = expected.static_pressure / (modulus * REFERENCE_OVERLAP);
        let at_rest = if share > 0.0 && share.is_finite() {
            REFERENCE_OVERLAP * share.powf(2.0 / 3.0)
        } else {
            0.0
        };
        Self {
            limits: Limits {
                p_wave_speed: material.p_wave_speed(),
                sound_speed: (material.bulk_modulus / material.bulk_density).sqrt(),
                cell_size: lattice.finest_spacing(),
                courant: COURANT,
                flow_courant: FLOW_COURANT,
                body_contact_share: BODY_CONTACT_SHARE,
                slow: SLOW * expected.speed,
            },
            sphere: PointSphere {
                radius: (0.5 + at_rest) * spacing,
                spacing,
            },
            contact_modulus: modulus,
            material,
        }
    }

    /// Chooses the formulation of contacts between points and bodies.
    fn couple(&mut self, coupling: Coupling, point_volume: f64) {
        match coupling {
            Coupling::HalfSpacing => {}
            Coupling::SourcePaper => {
                self.sphere.radius = (3.0 * point_volume / (4.0 * std::f64::consts::PI)).cbrt();
                self.contact_modulus = self.material.p_wave_modulus() / 1.5;
            }
        }
    }

    /// Relative change of density under the largest pressure that a scenario makes
    /// expect.
    pub fn density_change(&self, scenario: &Scenario) -> f64 {
        let pressing_speed = resolution::expected(scenario).pressing_speed;
        (pressing_speed / self.limits.sound_speed).powi(2)
    }

    /// Law of a body's contacts with points: at the reference overlap a point carries
    /// the largest pressure expected on its cross-section l² (equation 22).
    pub fn contact_law(&self, damping: f64, friction: f64) -> ContactLaw {
        let spacing = self.sphere.spacing;
        let overlap = REFERENCE_OVERLAP * spacing;
        ContactLaw {
            stiffness: self.contact_modulus * spacing / overlap.sqrt(),
            ..ContactLaw::damped(0.0, 1.0, damping, friction)
        }
    }

    /// Longest sub-step at which a free body covered with points does not ring
    /// against them unstably [s] (docs/method.md, equation 26).
    pub fn contact_substep(&self, bodies: &[Body]) -> f64 {
        let overlap = REFERENCE_OVERLAP * self.sphere.spacing;
        let of_body = |body: &Body| {
            let points = self.sphere.most_touching(body);
            let stiffness = body.flow_law.tangent_stiffness(overlap) * points;
            self.limits.body_contact_share * (body.mass / stiffness).sqrt()
        };
        bodies
            .iter()
            .filter(|body| body.is_free())
            .map(of_body)
            .fold(f64::INFINITY, f64::min)
    }
}

/// Granular material with the stiffness asked for, or a sound speed of
/// [`STIFFNESS_FACTOR`] times the speed of the largest dynamic pressure expected.
fn material(scenario: &Scenario, given: &scenario::Material) -> Material {
    let nu = given.poissons_ratio;
    let density = given.bulk_density_kg_m3;
    let bulk_modulus = match (given.youngs_modulus_pa, scenario.numerics.sound_speed_m_s) {
        (Some(youngs_modulus), _) => youngs_modulus / (3.0 * (1.0 - 2.0 * nu)),
        (None, Some(sound_speed)) => density * sound_speed.powi(2),
        (None, None) => {
            let pressing_speed = resolution::expected(scenario).pressing_speed;
            density * (STIFFNESS_FACTOR * pressing_speed).powi(2)
        }
    };
    Material {
        bulk_density: density,
        bulk_modulus,
        shear_modulus: bulk_modulus * 1.5 * (1.0 - 2.0 * nu) / (1.0 + nu),
        yielding: Yielding::Granular {
            static_friction: given.static_friction,
            limiting_friction: given.limiting_friction,
            reference_inertial_number: given.reference_inertial_number,
            grain_diameter: given.grain_diameter_m,
            grain_density: given.grain_density_kg_m3,
        },
    }
}

fn walls(channel: &scenario::Channel, lattice: &Lattice) -> Walls {
    let base = |name, normal| Plane {
        name,
        normal,
        offset: 0.0,
        flow_friction: channel.base_friction,
    };
    let upright = |name, normal: Vec3, distance: f64| Plane {
        name,
        normal,
        offset: -distance,
        flow_friction: channel.side_friction,
    };
    let half_width = 0.5 * channel.width_m;
    let mut planes = vec![base("floor", Vec3::z())];
    if channel.inclination_deg > 0.0 {
        planes.push(base("incline", channel.slope_normal()));
    }
    Walls {
        base: planes,
        upright: Upright {
            ends: Ends::BackWall(upright("back wall", Vec3::x(), channel.incline_length_m)),
            sides: [
                upright("right side wall", Vec3::y(), half_width),
                upright("left side wall", -Vec3::y(), half_width),
            ],
            halves_across: 2 * (channel.width_m / lattice.spacing.y).round() as i32,
        },
    }
}

impl Setup {
    /// What bodies move under from a time on [s].
    pub(super) fn surroundings(&self, time: f64) -> Surroundings<'_> {
        Surroundings {
            time,
            planes: &self.planes,
            gravity: self.gravity,
        }
    }
}

/// What can fall from where, and what is thrown how fast.
fn guards(scenario: &Scenario) -> Guards {
    let channel = &scenario.channel;
    let release = scenario.release();
    let top = release.map_or(0.0, |release| {
        channel.bed_elevation_m(release.back_m) + release.vertical_thickness_m
    });
    let bodies = scenario.bodies.iter().enumerate().map(|(place, body)| {
        let radius = scenario.shape_of(place).bounding_radius();
        let motion = body.motion.as_ref().map(scenario::Motion::prescribed);
        let rise = motion.map_or(0.0, |motion| motion.rise(scenario.duration_s));
        let height = scenario.initial_pose(place).position.z + radius + rise;
        (height, body.thrown_m_s(radius))
    });
    let (highest, fastest) = bodies.fold((top, 0.0f64), |(top, speed), (height, thrown)| {
        (top.max(height), speed.max(thrown))
    });
    Guards::of(scenario.gravity_m_s2, highest, fastest)
}

/// A point at rest.
fn resting_point(id: u32, position: Vec3, mass: f64, volume: f64) -> Point {
    Point {
        id,
        mass,
        volume,
        position,
        velocity: Vec3::zeros(),
        affine: crate::math::Mat3::zeros(),
        stress: crate::math::Sym3::default(),
    }
}
