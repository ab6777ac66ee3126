//! Rules of geometry: the release fits the incline, bodies are inside the channel and apart.

use super::placement::Pose;
use super::range::{rounded_down, rounded_up, short};
use super::report::{Report, field_name};
use super::rules::{
    CELL_SIZE, CONTACT_MODULUS, DEEPEST_AT_IMPACT, DEEPEST_AT_REST, DOWNSTREAM, ELEVATION, LATERAL,
    TOE_DISTANCE, TOUCHING, VOLUME,
};
use super::{Body, Channel, Flow, Numerics, Source};
use crate::bed::{Bed, Plane};
use crate::shape::{SpheroPolyhedron, separation};
use nalgebra::Vector3;

/// Rounding of a length computed from the scenario's own numbers.
const ROUNDING: f64 = 1e-9;

/// Least volume of a flow with points [m³], a cube of ten micrometres: masses of nodes
/// vanish in rounding below.
const LEAST_VOLUME: f64 = 1e-15;

/// The release lies on the incline.
pub(super) fn release_fits(report: &Report, channel: &Channel, flow: &Flow) {
    let Source::Channel { volume_m3, release } = &flow.source else {
        return;
    };
    let (volume, incline) = (*volume_m3, channel.incline_length_m);
    let toe = release.toe_distance_m;
    if toe >= incline {
        let why = format!(
            "is {}, not less than channel.incline_length_m ({})",
            short(toe),
            short(incline)
        );
        let pointer = format!("/flow/release/{}", TOE_DISTANCE.key);
        let allowed = format!("0 <= x < {}", short(incline));
        report.refuse(&pointer, &allowed, TOE_DISTANCE.unit, &why);
        return;
    }
    if volume > 0.0 && volume < LEAST_VOLUME {
        let why = format!("is {}, less than what can be computed", short(volume));
        let pointer = format!("/flow/{}", VOLUME.key);
        let allowed = format!("0, or {} <= x", short(LEAST_VOLUME));
        report.refuse(&pointer, &allowed, VOLUME.unit, &why);
        return;
    }
    let release = channel.release_box(volume, release);
    let largest = channel.width_m * release.vertical_thickness_m * (incline - toe);
    if volume > largest * (1.0 + ROUNDING) {
        let largest = short(rounded_down(largest));
        let why = format!(
            "is {}, but at this release height and toe distance the incline holds {largest} m³ at most",
            short(volume)
        );
        let pointer = format!("/flow/{}", VOLUME.key);
        report.refuse(&pointer, &format!("0 <= x <= {largest}"), VOLUME.unit, &why);
    }
}

/// A cell is no wider than the channel.
pub(super) fn cells_fit(report: &Report, channel: &Channel, numerics: &Numerics) {
    let width = channel.width_m;
    if let Some(size) = numerics.cell_size_m.filter(|&size| size > width) {
        let why = format!(
            "is {}, more than channel.width_m ({})",
            short(size),
            short(width)
        );
        let pointer = format!("/numerics/{}", CELL_SIZE.key);
        report.refuse(
            &pointer,
            &format!("0 < x <= {}", short(width)),
            CELL_SIZE.unit,
            &why,
        );
    }
}

/// A length for messages [m]: without the noise of rounding, and within the slack even of the
/// smallest bodies.
fn to_nanometre(place: f64) -> f64 {
    (place * 1e9).round() / 1e9
}

/// A body with its solid and pose.
pub(super) struct Placed<'a> {
    pub(super) pointer: String,
    pub(super) body: &'a Body,
    pub(super) shape: SpheroPolyhedron,
    pub(super) pose: Pose,
    /// Overlap that still counts as contact [m].
    pub(super) slack: f64,
}

impl<'a> Placed<'a> {
    /// The body of this index.
    pub(super) fn new(index: usize, body: &'a Body, shape: SpheroPolyhedron, pose: Pose) -> Self {
        Self {
            pointer: format!("/bodies/{index}"),
            pose,
            slack: TOUCHING * body.sphero_radius_m,
            body,
            shape,
        }
    }

    /// Reach of the body from its centre in a channel direction [m].
    fn reach(&self, direction: &Vector3<f64>) -> f64 {
        let direction = self.pose.orientation.inverse_transform_vector(direction);
        self.shape.extent_along(&direction)
    }

    pub(super) fn pointer_to(&self, key: &str) -> String {
        format!("{}/position/{key}", self.pointer)
    }
}

fn placed<'a>(channel: &Channel, bodies: &'a [Option<Body>]) -> Vec<Placed<'a>> {
    let place = |(index, body): (usize, &'a Option<Body>)| {
        let body = body.as_ref()?;
        let shape = body.build().ok()?;
        let pose = body.pose(&shape, channel);
        Some(Placed::new(index, body, shape, pose))
    };
    bodies.iter().enumerate().filter_map(place).collect()
}

/// Pointer and largest speed [m/s] of the fastest body with a prescribed motion, its
/// turning included.
pub(super) fn fastest_driven(bodies: &[Option<Body>]) -> Option<(String, f64)> {
    let bodies = bodies.iter().enumerate();
    let speeds = bodies.filter_map(|(index, body)| {
        let body = body.as_ref().filter(|body| body.motion.is_some())?;
        let shape = body.build().ok()?;
        let speed = body.thrown_m_s(shape.bounding_radius());
        Some((format!("/bodies/{index}"), speed))
    });
    speeds.max_by(|one, other| one.1.total_cmp(&other.1))
}

/// No body reaches into a wall, the bed, out of the open end or into another.
pub(super) fn bodies_fit(report: &Report, channel: &Channel, bodies: &[Option<Body>]) {
    let placed = placed(channel, bodies);
    for placed in &placed {
        is_between_the_sides(report, channel, placed);
        is_between_the_ends(report, channel, placed);
        is_above_the_bed(report, channel, placed);
    }
    bodies_are_apart(report, &placed);
}

fn is_between_the_sides(report: &Report, channel: &Channel, placed: &Placed<'_>) {
    let half = channel.width_m / 2.0;
    let low = placed.reach(&-Vector3::y()) - half;
    let high = half - placed.reach(&Vector3::y());
    is_between(
        report,
        placed,
        (LATERAL.key, placed.pose.position.y),
        (low, high),
        "a side wall",
    );
}

fn is_between_the_ends(report: &Report, channel: &Channel, placed: &Placed<'_>) {
    let low = placed.reach(&-Vector3::x()) - channel.incline_length_m;
    let high = channel.runout_length_m - placed.reach(&Vector3::x());
    let what = "the back wall or out of the open end";
    is_between(
        report,
        placed,
        (DOWNSTREAM.key, placed.pose.position.x),
        (low, high),
        what,
    );
}

fn is_between(
    report: &Report,
    placed: &Placed<'_>,
    (key, value): (&str, f64),
    (low, high): (f64, f64),
    what: &str,
) {
    if value >= low - placed.slack && value <= high + placed.slack {
        return;
    }
    let (low, high) = (to_nanometre(low), to_nanometre(high));
    let allowed = if low <= high {
        format!("{} <= x <= {}", short(low), short(high))
    } else {
        "nothing: the channel is too small for the body".to_owned()
    };
    let why = format!("is {}, which puts the body into {what}", short(value));
    report.refuse(&placed.pointer_to(key), &allowed, Some("m"), &why);
}

/// The body is above every plane of the bed.
fn is_above_the_bed(report: &Report, channel: &Channel, placed: &Placed<'_>) {
    let position = placed.pose.position;
    let bed = channel.bed();
    let above =
        |plane: &Plane| plane.lowest_centre(placed.reach(&-plane.normal), position.x, position.y);
    let lowest = bed.planes().iter().map(above).fold(f64::MIN, f64::max);
    if position.z >= lowest - placed.slack {
        return;
    }
    let bound = short(to_nanometre(lowest));
    let allowed = format!("x >= {bound}");
    let why = match placed.body.position.elevation_m {
        Some(elevation) => format!(
            "is {}, which puts the body into the bed: its centre must be at {bound} m or higher",
            short(elevation)
        ),
        None => format!(
            "must be given (at least {bound} m), because the body straddles the foot of the incline"
        ),
    };
    report.refuse(
        &placed.pointer_to(ELEVATION.key),
        &allowed,
        ELEVATION.unit,
        &why,
    );
}

/// A given contact modulus carries its body: at rest on one vertex, and in an impact of one
/// vertex as fast as it starts or falls (Hertz, F = 4/3 E* √r δ^1.5).
pub(super) fn contacts_carry(
    report: &Report,
    channel: &Channel,
    bodies: &[Option<Body>],
    gravity_m_s2: f64,
) {
    for placed in placed(channel, bodies) {
        let position = placed.pose.position;
        let bed = channel.bed().elevation(position.x, position.y);
        let fall = position.z - bed - placed.reach(&-Vector3::z());
        placed.refuse_soft_contact(report, fall, gravity_m_s2);
    }
}

impl Placed<'_> {
    /// Refuses a contact modulus that does not carry a free body at rest, or after a fall [m].
    pub(super) fn refuse_soft_contact(&self, report: &Report, fall: f64, gravity_m_s2: f64) {
        let given = self.body.contact_modulus_pa;
        let Some(modulus) = given.filter(|_| self.body.is_free()) else {
            return;
        };
        let (mass, radius) = (
            self.body.density_kg_m3 * self.shape.volume(),
            self.body.sphero_radius_m,
        );
        let thrown = self.body.thrown_m_s(self.shape.bounding_radius());
        let struck = thrown * thrown + 2.0 * gravity_m_s2 * fall.max(0.0);
        let at_rest = mass * gravity_m_s2 / (DEEPEST_AT_REST * radius).powf(1.5);
        let at_impact = 1.25 * mass * struck / (DEEPEST_AT_IMPACT * radius).powf(2.5);
        let softest = 0.75 * at_rest.max(at_impact) / radius.sqrt();
        if modulus < softest {
            let why = format!(
                "is {}, too soft to carry the body's own weight, or an impact as fast as it \
                 starts or falls, on one vertex",
                short(modulus)
            );
            let pointer = format!("{}/{}", self.pointer, CONTACT_MODULUS.key);
            let allowed = format!("x >= {}, or null", short(rounded_up(softest)));
            report.refuse(&pointer, &allowed, CONTACT_MODULUS.unit, &why);
        }
    }
}

/// No two rounded bodies overlap.
pub(super) fn bodies_are_apart(report: &Report, placed: &[Placed<'_>]) {
    for (index, second) in placed.iter().enumerate() {
        for first in &placed[..index] {
            let overlap = overlap(first, second);
            if overlap > first.slack.min(second.slack) {
                let other = field_name(&first.pointer);
                let why = format!(
                    "puts the body {} m into {other}",
                    short(rounded_up(overlap))
                );
                let allowed = format!("a place clear of {other}");
                report.refuse(
                    &format!("{}/position", second.pointer),
                    &allowed,
                    Some("m"),
                    &why,
                );
            }
        }
    }
}

/// Overlap of two rounded bodies [m]; negative if they are apart.
fn overlap(a: &Placed<'_>, b: &Placed<'_>) -> f64 {
    let balls = a.shape.bounding_radius() + b.shape.bounding_radius();
    let far = balls - (a.pose.position - b.pose.position).norm();
    if far < 0.0 {
        return far;
    }
    let rounding = a.shape.sphero_radius() + b.shape.sphero_radius();
    rounding - separation(&a.shape, &a.pose.isometry(), &b.shape, &b.pose.isometry())
}
