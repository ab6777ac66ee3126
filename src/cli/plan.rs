//! `scree plan`: computation, reductions and cost of a run.

use super::arguments::PlanOptions;
use super::failure::{Failure, not_set_up};
use super::machine::cores;
use super::{console, scenario_file};
use scree::jobs::forecast::{Planned, PlannedRefinementRun, WallTime, forecast};
use scree_solver::plan::{Choice, Cost, Hint, Stage};
use scree_solver::record::Role;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Cancellation, Plan};

/// Prints the plan of a scenario's run.
///
/// # Errors
/// A scenario that breaks rules or can't be set up.
pub(super) fn plan(options: &PlanOptions) -> Result<(), Failure> {
    let scenario = scenario_file::read(&options.scenario)?;
    let asked = options.threads.map(usize::from);
    let threads = asked.or(scenario.numerics.threads).unwrap_or_else(cores);
    let prepared = PreparedScene::of(&scenario).map_err(|error| not_set_up(&error))?;
    let planned = forecast(
        &prepared.scenario,
        Plan::of(&prepared),
        threads,
        &Cancellation::default(),
    )?;
    let answer = if options.json {
        serde_json::to_string_pretty(&planned)?
    } else {
        in_words(&planned, scenario.accuracy.target.is_some())
    };
    Ok(console::answer(&answer)?)
}

fn in_words(planned: &Planned, by_target: bool) -> String {
    let choices = planned.plan.choices.iter().map(choice);
    let mut lines: Vec<String> = choices.collect();
    let (of_cost, of_refinement_run) = if by_target {
        ("cost if there were no target:", "first for the target:")
    } else {
        ("cost", "for error bars:")
    };
    lines.push(format!("{of_cost} {}", cost(&planned.plan.cost)));
    lines.extend(planned.plan.cost.stages.iter().map(stage));
    let refinement_runs = planned.refinement_runs.iter().map(refinement_run);
    lines.extend(refinement_runs.map(|run| format!("{of_refinement_run} {run}")));
    lines.push(wall_time(&planned.wall_time));
    lines.extend(planned.plan.hints.iter().map(hint));
    lines.join("\n")
}

fn hint(hint: &Hint) -> String {
    format!("hint {}: {}", hint.field, hint.detail)
}

fn choice(choice: &Choice) -> String {
    let taken = if choice.taken { "yes" } else { "no " };
    let mut text = format!("{taken}  {}\n       {}", choice.what, choice.why);
    if choice.taken {
        text.push_str(&format!("; error: {}", choice.error));
    }
    text
}

fn cost(cost: &Cost) -> String {
    format!(
        "{} points in cells of {:.4} m, {} steps, {} sub-steps, {:.3e} point-steps, {:.0} MB; \
         expected to end at {:.2} s",
        cost.points,
        cost.cell_size_m,
        cost.steps,
        cost.substeps,
        cost.point_steps as f64,
        cost.memory_bytes as f64 / 1e6,
        cost.expected_end_s
    )
}

fn stage(stage: &Stage) -> String {
    format!(
        "     {}: {} points computed in {} sub-steps, about {} of them before that",
        format!("{:?}", stage.share).to_lowercase(),
        stage.points,
        stage.substeps,
        stage.expected_substeps
    )
}

fn refinement_run(run: &PlannedRefinementRun) -> String {
    let reduced_stiffness = match run.role {
        Role::ReducedStiffness => " and reduced stiffness",
        Role::Coarser | Role::Answer => "",
    };
    format!(
        "cells of {:.4} m{reduced_stiffness}, {:.3e} point-steps, {:.1} s",
        run.cell_size_m, run.point_steps as f64, run.expected_s
    )
}

fn wall_time(wall_time: &WallTime) -> String {
    let WallTime {
        expected_s,
        low_s,
        high_s,
        threads,
    } = wall_time;
    match expected_s {
        Some(expected_s) => format!(
            "time {expected_s:.1} s here on {threads} threads, most likely {low_s:.1} to {high_s:.1} s"
        ),
        None => format!(
            "time {low_s:.1} s to {high_s:.1} s here on {threads} threads: the first runs of a target \
             at least, its whole budget at most"
        ),
    }
}
