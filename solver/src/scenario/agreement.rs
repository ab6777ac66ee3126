//! Rules between numbers that have nothing to do with the geometry.

use super::range::{Rule, rounded_up, short};
use super::reader::Object;
use super::report::Report;
use super::rules::{
    BODY_SAMPLES, SAMPLE_INTERVAL, SLOWEST_SOUND, SOFTEST, SOUND_SPEED, YOUNGS_MODULUS,
};
use super::{Channel, Flow, Numerics};

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

/// Nobody gets a trajectory that fills the disk.
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

/// A release must not be crushed by its own weight, p = ρ g H presses a bulk of sound
/// speed c together by g H/c², nor a flow where it strikes a wall.
pub(super) fn flow_carries_itself(
    report: &Report,
    channel: &Channel,
    flow: &Flow,
    numerics: &Numerics,
    gravity_m_s2: f64,
) {
    let material = &flow.material;
    let for_weight = SOFTEST * (gravity_m_s2 * flow.release.height_m).sqrt();
    let fastest = channel.fastest_flow(flow, gravity_m_s2);
    let slowest = for_weight.max(SLOWEST_SOUND * fastest);
    let reason = if slowest > for_weight {
        format!(
            "that the flow, which may reach {} m/s, would be more than twice as fast as its \
             own sound",
            short(fastest)
        )
    } else {
        "that the release's own weight would press it together by a third or more".to_owned()
    };
    let why = |value: f64| format!("is {}, so soft {reason}", short(value));
    if let Some(speed) = numerics.sound_speed_m_s.filter(|&speed| speed < slowest) {
        let allowed = format!("x >= {}, or null", short(rounded_up(slowest)));
        let pointer = format!("/numerics/{}", SOUND_SPEED.key);
        report.refuse(&pointer, &allowed, SOUND_SPEED.unit, &why(speed));
    }
    let softest =
        3.0 * (1.0 - 2.0 * material.poissons_ratio) * material.bulk_density_kg_m3 * slowest.powi(2);
    if let Some(modulus) = material.youngs_modulus_pa.filter(|&given| given < softest) {
        let allowed = format!("x >= {}, or null", short(rounded_up(softest)));
        let pointer = format!("/flow/material/{}", YOUNGS_MODULUS.key);
        report.refuse(&pointer, &allowed, YOUNGS_MODULUS.unit, &why(modulus));
    }
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
