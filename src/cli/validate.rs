//! `scree validate`: is this a scenario, and what does it say?

use super::arguments::ValidateOptions;
use super::failure::Failure;
use super::{console, scenario_file};
use scree_solver::scenario::{Channel, Numerics, Scenario, Shape, Support};

/// Prints what a legal scenario comes to.
///
/// # Errors
/// All that is wrong with it.
pub(super) fn validate(options: &ValidateOptions) -> Result<(), Failure> {
    let scenario = scenario_file::read(&options.scenario)?;
    Ok(console::answer(&facts(&scenario))?)
}

/// What the scenario comes to with all defaults in place.
fn facts(scenario: &Scenario) -> String {
    let mut facts = vec![
        ("title".to_owned(), format!("{:?}", scenario.title)),
        ("channel".to_owned(), channel(&scenario.channel)),
        ("flow".to_owned(), flow(scenario)),
    ];
    let bodies = 0..scenario.bodies.len();
    facts.extend(bodies.map(|index| (format!("body {index}"), body(scenario, index))));
    facts.push(("recorded".to_owned(), recorded(scenario)));
    facts.push(("numerics".to_owned(), numerics(&scenario.numerics)));
    let line = |(name, text): &(String, String)| format!("\n  {name:<10}{text}");
    format!(
        "legal scenario{}",
        facts.iter().map(line).collect::<String>()
    )
}

fn channel(channel: &Channel) -> String {
    format!(
        "{}° over {} m, then {} m of floor, {} m wide; friction {} at the base, {} at the sides",
        channel.inclination_deg,
        channel.incline_length_m,
        channel.runout_length_m,
        channel.width_m,
        channel.base_friction,
        channel.side_friction
    )
}

fn flow(scenario: &Scenario) -> String {
    let (Some(flow), Some(release)) = (&scenario.flow, scenario.release()) else {
        return "none".to_owned();
    };
    let material = &flow.material;
    format!(
        "{} m³, {:.3} kg, from x = {:.3} to {:.3} m, {} m thick; friction {} at rest, {} at most",
        flow.volume_m3,
        flow.volume_m3 * material.bulk_density_kg_m3,
        release.back_m,
        release.front_m,
        flow.release.height_m,
        material.static_friction,
        material.limiting_friction
    )
}

fn body(scenario: &Scenario, index: usize) -> String {
    let body = &scenario.bodies[index];
    let shape = match body.shape {
        Shape::Cube { side_m } => format!("cube of {side_m} m"),
    };
    let mass_kg = body.density_kg_m3 * scenario.shape_of(index).volume();
    let [x, y, z]: [f64; 3] = scenario.initial_pose(index).position.into();
    let support = match scenario.support_of(index) {
        Support::Floor => "on the floor",
        Support::Incline => "on the incline",
        Support::Free => "as placed",
    };
    let fixed = if body.fixed { ", fixed" } else { "" };
    format!(
        "{shape}, rounded by {} m, {mass_kg:.4} kg, centre at {x:.4}, {y:.4}, {z:.4} m {support}{fixed}",
        body.sphero_radius_m
    )
}

fn recorded(scenario: &Scenario) -> String {
    format!(
        "{} s, a sample every {} s, {} snapshots of the flow",
        scenario.duration_s, scenario.sample_interval_s, scenario.flow_snapshots
    )
}

fn numerics(numerics: &Numerics) -> String {
    let or_automatic = |value: Option<f64>, unit: &str| {
        value.map_or("automatic".to_owned(), |value| format!("{value}{unit}"))
    };
    format!(
        "cell {}, {} points per cell, sound speed {}",
        or_automatic(numerics.cell_size_m, " m"),
        numerics.points_per_cell,
        or_automatic(numerics.sound_speed_m_s, " m/s")
    )
}
