//! Pictures of artificial runs: their texts, and unusual cases.

mod drawn;
mod labels;

use crate::pictures::fixtures::{
    cube, empty_snapshot, never_moved, outcome, resting_at, scenario, slab, slid, sliding_samples,
};
use crate::pictures::{aerial_view, motion};
use scree_solver::record::{FlowSnapshot, Sample};
use scree_solver::scenario::{Body, Ground};

/// Checks for well-formed XML and an SVG of plain numbers; returns all its texts.
pub(super) fn texts_of(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    assert!(
        document
            .root_element()
            .has_tag_name(("http://www.w3.org/2000/svg", "svg"))
    );
    for attribute in document.descendants().flat_map(|node| node.attributes()) {
        let value = attribute.value();
        assert!(
            !value.contains("NaN") && !value.contains("inf"),
            "{attribute:?}"
        );
    }
    let texts = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    texts
        .filter_map(|node| node.text())
        .map(|text| text.trim().to_owned())
        .collect()
}

fn assert_says(svg: &str, wanted: &[&str]) {
    let texts = texts_of(svg);
    for phrase in wanted {
        assert!(
            texts.iter().any(|text| text.contains(phrase)),
            "{phrase:?} not in {texts:?}"
        );
    }
}

#[test]
fn motion_names_its_axes_and_values() {
    let svg = motion(
        &scenario(vec![cube(0.04, 0.002)]),
        &sliding_samples(1.0, 3.0),
        &outcome(vec![slid()]),
    );
    let wanted = [
        "Cube <hit> by \"sand\" & gravel",
        "displacement [m]",
        "speed [m/s]",
        "submerged share",
        "time [s]",
        "onset 0.0289 s",
        "peak 0.600 m/s at 0.510 s",
        "at rest from 1.02 s",
        "0.401 m from where it started",
    ];
    assert_says(&svg.unwrap(), &wanted);
}

#[test]
fn motion_of_several_bodies_has_a_table_of_them() {
    let mut samples = sliding_samples(1.0, 3.0);
    for sample in &mut samples {
        sample.bodies = vec![sample.bodies[0], resting_at([1.0, 0.0, 0.02])];
    }
    let svg = motion(
        &scenario(vec![cube(0.04, 0.002), cube(0.03, 0.001)]),
        &samples,
        &outcome(vec![slid(), never_moved()]),
    );
    assert_says(
        &svg.unwrap(),
        &[
            "onset [s]",
            "0.0289",
            "peak speed [m/s]",
            "0.600",
            "did not move",
        ],
    );
}

#[test]
fn aerial_view_names_its_axes_scale_and_instants() {
    let snapshots = [
        slab(0.0, -0.05, 0.0),
        slab(0.6, 0.6, 2.0),
        slab(3.0, 1.2, 0.1),
    ];
    let svg = aerial_view(
        &scenario(vec![cube(0.04, 0.002)]),
        &sliding_samples(1.0, 3.0),
        &snapshots,
    )
    .unwrap();
    let wanted = [
        "Cube <hit> by \"sand\" & gravel",
        "x downstream [m]",
        "y across [m]",
        "speed of the flow [m/s]",
        "foot of the 40° incline",
        "t = 0.00 s",
        "t = 0.60 s",
        "t = 3.00 s",
    ];
    assert_says(&svg, &wanted);
    let document = roxmltree::Document::parse(&svg).unwrap();
    let count = |tag: &str| {
        document
            .descendants()
            .filter(|node| node.has_tag_name(tag))
            .count()
    };
    assert!(
        count("circle") > 1_000,
        "the flow is drawn: {} dots",
        count("circle")
    );
    assert_eq!(count("polygon"), 3, "the body is drawn in every panel");
}

#[test]
fn a_crowded_flow_stays_within_the_dots_of_a_page() {
    let snapshots: Vec<_> = (0..40)
        .map(|k| slab(0.1 * f64::from(k), 0.05 * k as f32, 1.0))
        .collect();
    let svg = aerial_view(&scenario(Vec::new()), &[], &snapshots).unwrap();
    texts_of(&svg);
    // 7,500 dots of about 50 bytes, and the rest of the picture.
    assert!(svg.len() < 500_000, "{} bytes", svg.len());
}

/// Name, bodies, samples and snapshots of a run.
type OddRun<'a> = (&'static str, Vec<Body>, &'a [Sample], Vec<FlowSnapshot>);

/// Failed, dismissed and trivial runs must be drawn as well.
#[test]
fn odd_runs_are_drawn() {
    let one_cube = || vec![cube(0.04, 0.002)];
    let still = sliding_samples(0.0, 1.0);
    let mut broken = sliding_samples(1.0, 3.0);
    broken[50].bodies[0].position_m = [f64::NAN, f64::INFINITY, 0.0];
    broken[50].bodies[0].orientation = [f64::NAN; 4];
    broken[50].bodies[0].velocity_m_s = [f64::NAN; 3];
    let mut broken_flow = slab(1.5, 0.5, 1.0);
    broken_flow.position_m[7] = [f32::NAN; 3];
    broken_flow.speed_m_s[8] = f32::INFINITY;

    let runs: [OddRun<'_>; 8] = [
        ("nothing at all", Vec::new(), &[], Vec::new()),
        ("nothing recorded", one_cube(), &[], Vec::new()),
        ("no bodies", Vec::new(), &[], vec![slab(0.0, 0.0, 0.0)]),
        (
            "empty flow",
            one_cube(),
            &still,
            vec![empty_snapshot(0.0), empty_snapshot(1.0)],
        ),
        ("no flow", one_cube(), &still, Vec::new()),
        (
            "one sample",
            one_cube(),
            &still[..1],
            vec![slab(0.0, -0.05, 0.0)],
        ),
        (
            "never moves",
            one_cube(),
            &still,
            vec![slab(0.0, -0.05, 0.0), slab(1.0, -0.05, 0.0)],
        ),
        ("not a number", one_cube(), &broken, vec![broken_flow]),
    ];
    for (name, bodies, samples, snapshots) in runs {
        let result = outcome(bodies.iter().map(|_| never_moved()).collect());
        let mut scene = scenario(bodies);
        if samples.len() < 2 {
            scene.duration_s = 0.0;
        }
        let pictures = [
            motion(&scene, samples, &result),
            aerial_view(&scene, samples, &snapshots),
        ];
        for picture in pictures {
            let texts = texts_of(&picture.unwrap_or_else(|e| panic!("{name}: {e}")));
            assert!(
                texts.iter().any(|text| text.contains("[m]")),
                "{name}: {texts:?}"
            );
        }
    }
}

/// Any legal channel gets a page of reasonable size: wide, narrow, flat, long.
#[test]
fn channels_of_all_proportions_fit_a_page() {
    for (width_m, runout_m, inclination_deg) in
        [(0.01, 50.0, 40.0), (20.0, 2.0, 40.0), (0.2, 2.0, 0.0)]
    {
        let mut scene = scenario(vec![cube(0.04, 0.002)]);
        let Ground::Channel(channel) = &mut scene.ground else {
            panic!("it is in a channel");
        };
        channel.width_m = width_m;
        channel.runout_length_m = runout_m;
        channel.inclination_deg = inclination_deg;
        let snapshots: Vec<_> = (0..6)
            .map(|k| slab(0.5 * f64::from(k), 0.1 * k as f32, 1.0))
            .collect();
        let svg = aerial_view(&scene, &sliding_samples(1.0, 3.0), &snapshots).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let size = |name| {
            document
                .root_element()
                .attribute(name)
                .unwrap()
                .parse::<f64>()
                .unwrap()
        };
        assert_eq!(size("width"), 840.0);
        assert!(
            (150.0..=1_000.0).contains(&size("height")),
            "{width_m}: {}",
            size("height")
        );
        let foot = texts_of(&svg).iter().any(|text| text.starts_with("foot"));
        assert_eq!(foot, inclination_deg > 0.0);
    }
}
