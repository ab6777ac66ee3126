use super::*;
use crate::scenario::Scenario;
use serde_json::{Value, json};

/// A cube of 8 cm on a bed of this inclination in a release of this height across it,
/// before anything moves.
fn scene(inclination_deg: f64, height_m: f64, change: impl FnOnce(&mut Value)) -> Scenario {
    let cos = inclination_deg.to_radians().cos();
    let mut scenario = json!({
        "channel": {"inclination_deg": inclination_deg, "incline_length_m": 0.6,
                    "runout_length_m": 0.5, "width_m": 0.3},
        "flow": {"volume_m3": 0.5 * 0.3 * height_m / cos,
                 "release": {"height_m": height_m, "toe_distance_m": 0.05}},
        "bodies": [{"shape": {"cube": {"side_m": 0.08}}, "position": {"downstream_m": -0.3}}],
        "numerics": {"cell_size_m": 0.01}, "duration_s": 0
    });
    change(&mut scenario);
    Scenario::from_value(&scenario).expect("a scenario")
}

fn submerged(scenario: &Scenario) -> f64 {
    let simulation = Simulation::new(scenario, 1).expect("it fits");
    submerged_fraction(&simulation, &simulation.bodies()[0])
}

#[test]
fn half_buried_is_half_on_any_slope() {
    for inclination in [0.0, 20.0, 30.0, 45.0] {
        for (height, wanted) in [(0.02, 0.25), (0.04, 0.5), (0.1, 1.0)] {
            let found = submerged(&scene(inclination, height, |_| {}));
            assert!(
                (found - wanted).abs() <= 0.01,
                "{inclination}°, {height} m: {found}"
            );
        }
    }
}

#[test]
fn a_body_at_a_wall_is_as_deep_as_one_amid_the_flow() {
    let aside = |scenario: &mut Value| {
        scenario["bodies"][0]["position"]["lateral_m"] = 0.105.into();
    };
    let found = submerged(&scene(30.0, 0.04, aside));
    assert!((found - 0.5).abs() <= 0.01, "{found}");
}

#[test]
fn burial_is_measured_along_the_normal_of_the_bed_from_the_top_of_the_body() {
    for inclination in [0.0, 30.0] {
        for (height, wanted) in [(0.04, 0.0), (0.1, 0.02), (0.2, 0.12)] {
            let scenario = scene(inclination, height, |_| {});
            let simulation = Simulation::new(&scenario, 1).expect("it fits");
            let found = burial_depth(&simulation, &simulation.bodies()[0]);
            assert!(
                (found - wanted).abs() <= 0.003,
                "{inclination}°, {height} m: {found}"
            );
        }
    }
}

// A point resolves its surface to half a spacing: of a cube of half a cell, a whole side.
#[test]
fn cells_larger_than_the_body_tell_deep_from_dry() {
    let coarse = |scenario: &mut Value| {
        scenario["bodies"][0]["shape"] = json!({"cube": {"side_m": 0.02}});
        scenario["numerics"]["cell_size_m"] = 0.04.into();
    };
    assert_eq!(submerged(&scene(30.0, 0.08, coarse)), 1.0);
    let dry = |scenario: &mut Value| {
        coarse(scenario);
        scenario["bodies"][0]["position"]["downstream_m"] = 0.2.into();
    };
    assert_eq!(submerged(&scene(30.0, 0.08, dry)), 0.0);
}

fn view() -> View {
    View {
        centre: Vec3::zeros(),
        downstream: Vec3::x(),
        across: Vec3::y(),
        normal: Vec3::z(),
        low: -0.04,
        high: 0.04,
        ceiling: 0.05,
        radius: 0.07,
        ring: 0.085,
        spacing: 0.005,
    }
}

/// Points up to this height in every sector.
fn layered(top: impl Fn(usize) -> f64) -> [Vec<Spot>; SECTORS] {
    std::array::from_fn(|sector| {
        let layers = (1..).map(|k| -0.04 + 0.005 * (f64::from(k) - 0.5));
        let heights = layers.take_while(|height| *height < top(sector));
        heights
            .map(|height| Spot {
                height,
                ..view().middle(sector)
            })
            .collect()
    })
}

fn seen(mut sectors: [Vec<Spot>; SECTORS]) -> f64 {
    let sectors = sectors.iter_mut().enumerate();
    let shares: Vec<_> = sectors
        .map(|(sector, spots)| view().share(sector, spots, 1.0))
        .collect();
    at_the_centre(&shares)
}

#[test]
fn a_splash_does_not_drown_a_body() {
    let mut sectors = layered(|_| -0.02);
    let calm = seen(sectors.clone());
    assert!((calm - 0.25).abs() < 1e-12, "{calm}");
    for height in [0.0, 0.01, 0.03] {
        sectors[2].push(Spot {
            height,
            ..view().middle(2)
        });
    }
    assert_eq!(seen(sectors), calm);
}

// The surface rises by 0.1 across the body: the differences at its sides cancel.
#[test]
fn a_slope_of_the_surface_counts_once() {
    let sloping = layered(|sector| 0.5 * view().middle(sector).along);
    let found = seen(sloping);
    assert!((found - 0.5).abs() < 0.04, "{found}");
    // Piled up on one side and dry on the other.
    let piled = layered(|sector| {
        if view().middle(sector).along < 0.0 {
            1.0
        } else {
            -1.0
        }
    });
    let found = seen(piled);
    assert!((found - 0.5).abs() < 1e-9, "{found}");
}
