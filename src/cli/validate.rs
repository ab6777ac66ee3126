//! `scree validate`: checks a scenario and prints the facts that follow from it.

use super::arguments::ValidateOptions;
use super::failure::{Failure, not_set_up};
use super::{console, scenario_file};
use scree_solver::Simulation;
use scree_solver::rigid::Body;
use scree_solver::scenario::{Channel, Ground, Scenario, Source, Support, Terrain};
use scree_solver::shape::PrincipalInertia;

/// Prints the facts that follow from a legal scenario.
///
/// # Errors
/// All rules that the scenario breaks.
pub(super) fn validate(options: &ValidateOptions) -> Result<(), Failure> {
    let scenario = scenario_file::read(&options.scenario)?;
    // Set up as for a run, but on one thread: a scenario that can't be set up is not legal.
    let simulation = Simulation::new(&scenario, 1).map_err(|error| not_set_up(&error))?;
    Ok(console::answer(&facts(&scenario, &simulation))?)
}

/// Facts that follow from the scenario with all defaults filled in.
fn facts(scenario: &Scenario, simulation: &Simulation) -> String {
    let mut facts = vec![
        ("title".to_owned(), format!("{:?}", scenario.title)),
        match &scenario.ground {
            Ground::Channel(of) => ("channel".to_owned(), channel(of)),
            Ground::Terrain(of) => ("terrain".to_owned(), terrain(of)),
        },
        ("flow".to_owned(), flow(scenario)),
    ];
    let bodies = 0..scenario.bodies.len();
    facts.extend(bodies.map(|index| {
        let set_up = &simulation.bodies()[index];
        (format!("body {index}"), body(scenario, index, set_up))
    }));
    facts.push(("recorded".to_owned(), recorded(scenario)));
    facts.push(("numerics".to_owned(), numerics(scenario, simulation)));
    facts.extend(volume_left_out(simulation).map(|text| ("left out".to_owned(), text)));
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

fn terrain(terrain: &Terrain) -> String {
    let height = terrain.height();
    let system = match height.epsg {
        Some(code) => format!("EPSG:{code}"),
        None => "no reference system given".to_owned(),
    };
    format!(
        "{} × {} cells of {} m ({system}), {:.2} to {:.2} m high; friction {} at the base",
        height.columns,
        height.rows,
        height.cell_size,
        height.lowest(),
        height.highest(),
        match &terrain.base_friction_map {
            Some(_) => "by a map".to_owned(),
            None => terrain.base_friction.to_string(),
        }
    )
}

fn flow(scenario: &Scenario) -> String {
    let (Some(flow), Some(thickness)) = (&scenario.flow, scenario.release_thickness_m()) else {
        return "none".to_owned();
    };
    let (material, volume) = (&flow.material, scenario.released_volume_m3());
    let place = match (&flow.source, scenario.release()) {
        (Source::Channel { .. }, Some(release)) => {
            format!(
                "from x = {:.3} to {:.3} m, ",
                release.back_m, release.front_m
            )
        }
        (Source::Channel { .. }, None) => return "none".to_owned(),
        (Source::Terrain { releases }, _) => format!("in {} release(s), ", releases.len()),
    };
    format!(
        "{} m³, {:.3} kg, {place}{thickness} m thick; friction {} at rest, {} at most",
        volume,
        volume * material.bulk_density_kg_m3,
        material.static_friction,
        material.limiting_friction
    )
}

/// Description of a body of the scenario as it was set up.
fn body(scenario: &Scenario, index: usize, set_up: &Body) -> String {
    let body = &scenario.bodies[index];
    let shape = &body.shape;
    let [least, middle, most] = PrincipalInertia::of(&set_up.inertia).moments;
    let [x, y, z]: [f64; 3] = scenario.initial_pose(index).position.into();
    let support = match scenario.support_of(index) {
        Support::Floor => "on the floor",
        Support::Incline => "on the incline",
        Support::Terrain => "on the terrain",
        Support::Free => "as placed",
    };
    let fixed = match &body.motion {
        Some(_) => ", its motion prescribed",
        None if body.fixed => ", fixed",
        None => "",
    };
    format!(
        "{shape}, rounded by {} m, {:.4} kg, principal moments {least:.3e}, {middle:.3e}, {most:.3e} kg m², centre at {x:.4}, {y:.4}, {z:.4} m {support}{fixed}",
        body.sphero_radius_m, set_up.mass
    )
}

fn recorded(scenario: &Scenario) -> String {
    format!(
        "{} s, a sample every {} s, {} snapshots of the flow",
        scenario.duration_s, scenario.sample_interval_s, scenario.flow_snapshots
    )
}

/// Numerical choices, automatic ones included.
fn numerics(scenario: &Scenario, simulation: &Simulation) -> String {
    let automatic = |given: Option<f64>| if given.is_none() { " (automatic)" } else { "" };
    let numerics = &scenario.numerics;
    let mut text = format!("cells of {:.4} m", simulation.cell_size_m());
    text.push_str(automatic(numerics.cell_size_m));
    if let Some(sound_speed_m_s) = simulation.sound_speed_m_s() {
        let points = simulation.released_points();
        let per_cell = numerics.points_per_cell;
        text.push_str(&format!(", {points} points ({per_cell} per cell)"));
        text.push_str(&format!(", sound speed {sound_speed_m_s:.2} m/s"));
        text.push_str(automatic(numerics.sound_speed_m_s));
    }
    text
}

fn volume_left_out(simulation: &Simulation) -> Option<String> {
    let volume_m3 = simulation.excluded_volume_m3();
    (volume_m3 > 0.0).then(|| format!("{volume_m3:.3e} m³ of the flow, because bodies stand there"))
}
