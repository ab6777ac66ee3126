//! Rules between numbers that do not concern the geometry.

use super::fit::fastest_driven;
use super::range::{Rule, rounded_up, short};
use super::reader::Object;
use super::report::{Report, field_name};
use super::rules::{
    BODY_SAMPLES, SAMPLE_INTERVAL, SLOWEST_SOUND, SLOWEST_SOUND_DRIVEN, SOFTEST, SOUND_SPEED,
    YOUNGS_MODULUS,
};
use super::{Body, Flow, Numerics};

/// The second field must not be below the first.
pub(super) fn ascend(
    object: &Object<'_>,
    (low_rule, low): (&Rule, Option<f64>),
    (high_rule, high): (&Rule, Option<f64>),
) {
    let (Some(low), Some(high)) = (low, high) else {
        return;
    };
    if high < low {
        let bound = short(low);
        let why = format!("is {}, below {} ({bound})", short(high), low_rule.key);
        let pointer = object.pointer_to(high_rule.key);
        let allowed = format!("x >= {bound}");
        object
            .report
            .refuse(&pointer, &allowed, high_rule.unit, &why);
    }
}

/// The number of samples is bounded, so that no trajectory fills the disk.
pub(super) fn samples_are_bounded(
    report: &Report,
    duration_s: f64,
    interval_s: f64,
    bodies: usize,
) {
    let bodies = bodies.max(1) as f64;
    if duration_s / interval_s * bodies > BODY_SAMPLES {
        let smallest = short(rounded_up(duration_s * bodies / BODY_SAMPLES));
        let why = format!(
            "is {}, which makes more than {BODY_SAMPLES} samples of all bodies in {} s",
            short(interval_s),
            short(duration_s)
        );
        let pointer = format!("/{}", SAMPLE_INTERVAL.key);
        report.refuse(
            &pointer,
            &format!("x >= {smallest}"),
            SAMPLE_INTERVAL.unit,
            &why,
        );
    }
}

/// A release must not be crushed by its own weight, p = ρ g H, which compresses a bulk of sound
/// speed c by g H/c², nor a flow where it strikes a wall or a body is driven into it.
pub(super) fn flow_is_stiff_enough(
    report: &Report,
    flow: &Flow,
    course: &Course,
    bodies: &[Option<Body>],
    numerics: &Numerics,
    gravity_m_s2: f64,
) {
    let others = [Some(for_speed(course)), for_driven_bodies(bodies)];
    let most = others
        .into_iter()
        .flatten()
        .fold(for_weight(course, gravity_m_s2), Need::or_more);
    let why = |value: f64| format!("is {}, so soft {}", short(value), most.reason);
    let slowest = most.sound_speed;
    if let Some(speed) = numerics.sound_speed_m_s.filter(|&speed| speed < slowest) {
        let allowed = format!("x >= {}, or null", short(rounded_up(slowest)));
        let pointer = format!("/numerics/{}", SOUND_SPEED.key);
        report.refuse(&pointer, &allowed, SOUND_SPEED.unit, &why(speed));
    }
    let material = &flow.material;
    let softest =
        3.0 * (1.0 - 2.0 * material.poissons_ratio) * material.bulk_density_kg_m3 * slowest.powi(2);
    if let Some(modulus) = material.youngs_modulus_pa.filter(|&given| given < softest) {
        let allowed = format!("x >= {}, or null", short(rounded_up(softest)));
        let pointer = format!("/flow/material/{}", YOUNGS_MODULUS.key);
        report.refuse(&pointer, &allowed, YOUNGS_MODULUS.unit, &why(modulus));
    }
}

/// Thickness [m] of a flow and the speed that it may reach [m/s], which press it together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    pub(super) thickness: f64,
    pub(super) fastest: f64,
}

/// Lower bound of the sound speed, and its reason.
struct Need {
    /// Sound speed [m/s].
    sound_speed: f64,
    /// Consequence of a lower one.
    reason: String,
}

impl Need {
    fn or_more(self, other: Self) -> Self {
        if other.sound_speed > self.sound_speed {
            other
        } else {
            self
        }
    }
}

fn for_weight(course: &Course, gravity_m_s2: f64) -> Need {
    Need {
        sound_speed: SOFTEST * (gravity_m_s2 * course.thickness).sqrt(),
        reason: "that the release's own weight would press it together by a third or more"
            .to_owned(),
    }
}

fn for_speed(course: &Course) -> Need {
    let fastest = course.fastest;
    Need {
        sound_speed: SLOWEST_SOUND * fastest,
        reason: format!(
            "that the flow, which may reach {} m/s, would be more than twice as fast as its \
             own sound",
            short(fastest)
        ),
    }
}

fn for_driven_bodies(bodies: &[Option<Body>]) -> Option<Need> {
    let (pointer, fastest) = fastest_driven(bodies)?;
    Some(Need {
        sound_speed: SLOWEST_SOUND_DRIVEN * fastest,
        reason: format!(
            "that {}.motion, which reaches {} m/s, would press the flow together by a third \
             or more",
            field_name(&pointer),
            short(fastest)
        ),
    })
}

/// Sound speed and Young's modulus are two names of one stiffness.
pub(super) fn stiffness_is_given_once(report: &Report, flow: &Flow, numerics: &Numerics) {
    if numerics.sound_speed_m_s.is_some() && flow.material.youngs_modulus_pa.is_some() {
        let modulus = YOUNGS_MODULUS.key;
        let allowed = format!("null while flow.material.{modulus} is given");
        let why =
            format!("sets the same stiffness as flow.material.{modulus}: give one of the two");
        let pointer = format!("/numerics/{}", SOUND_SPEED.key);
        report.refuse(&pointer, &allowed, SOUND_SPEED.unit, &why);
    }
}
