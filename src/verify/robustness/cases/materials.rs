//! Very soft and very stiff materials, very small grains, dust.

use super::strike_with;
use crate::verify::Effort;
use crate::verify::robustness::{Family, Member};
use scree_solver::math::Sym3;
use scree_solver::simulation::Scene;
use serde_json::json;

pub(super) const STIFFNESS: Family = Family {
    name: "Young's modulus",
    reason: "at 1e4 Pa the flow is faster than its own sound; at 1e9 Pa a sub-step is \
             microseconds and single precision has to hold stresses of 0.001 % of K",
    members: stiffnesses,
};

pub(super) const GRAINS: Family = Family {
    name: "grains",
    reason: "d and I0 stand under fractions: without size the law must become plain friction, \
             with I0 near 0 the limiting friction at once",
    members: grains,
};

pub(super) const DUST: Family = Family {
    name: "dust",
    reason: "every point is apart from every other from the start: no pressure, no friction, \
             and no sound",
    members: dusts,
};

fn stiffnesses(_: Effort) -> Vec<Member> {
    // As long as a few million point-steps allow.
    let of = |(modulus, duration): (f64, f64)| {
        let changes = [
            ("/flow/material/youngs_modulus_pa", json!(modulus)),
            ("/duration_s", json!(duration)),
        ];
        Member::Scene(Box::new(strike_with(format!("{modulus:e} Pa"), &changes)))
    };
    [(1e4, 0.4), (1e5, 0.4), (1e7, 0.2), (1e9, 0.03)]
        .map(of)
        .into()
}

fn grains(_: Effort) -> Vec<Member> {
    let of = |(name, key, value): (&str, &str, f64)| {
        let pointer = format!("/flow/material/{key}");
        Member::Scene(Box::new(strike_with(name, &[(&pointer, json!(value))])))
    };
    [
        ("d = 1e-9 m", "grain_diameter_m", 1e-9),
        ("d = 1 m", "grain_diameter_m", 1.0),
        ("I0 = 1e-9", "reference_inertial_number", 1e-9),
        ("I0 = 1000", "reference_inertial_number", 1e3),
        ("Poisson's ratio 0.49", "poissons_ratio", 0.49),
        ("Poisson's ratio 0", "poissons_ratio", 0.0),
    ]
    .map(of)
    .into()
}

fn dusts(_: Effort) -> Vec<Member> {
    let dust = |scene: &mut Scene| {
        for point in &mut scene.points {
            point.volume *= 1.5;
            point.stress = Sym3::default();
        }
    };
    vec![Member::Scene(Box::new(
        strike_with("half as thick again as at rest", &[]).altered(dust),
    ))]
}
