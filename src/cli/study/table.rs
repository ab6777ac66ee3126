//! Answers of a study for people.

use crate::cli::columns::table;
use scree_studies::answers::{
    AccuracyReached, Answer, Estimate, Mean, Measures, Moment, Probability, Region,
};
use scree_studies::{Answers, Needed, Question, Study};

/// A paragraph on the members, and a table for each question.
pub(in crate::cli) fn answers(study: &Study, answers: &Answers) -> String {
    let mut paragraphs = vec![members(answers)];
    if !answers.levels.is_empty() {
        paragraphs.push(levels(answers).trim_end().to_owned());
    }
    if let (Some(asked), Some(reached)) = (&study.accuracy, &answers.accuracy) {
        let quantity = of_body(&asked.quantity, asked.body);
        paragraphs.push(accuracy(&quantity, reached));
    }
    for (question, answer) in study.questions.iter().zip(&answers.answers) {
        paragraphs.push(one(study, question, answer).trim_end().to_owned());
    }
    paragraphs.join("\n\n")
}

fn members(answers: &Answers) -> String {
    let counts = &answers.members;
    let mut line = format!("{} members finished", counts.finished);
    for failures in &counts.failures {
        line.push_str(&format!(
            ", {} failed ({})",
            failures.members, failures.reason
        ));
    }
    line
}

fn levels(answers: &Answers) -> String {
    let on_level = |level: usize| answers.accuracy.as_ref()?.levels.get(level);
    let rows = answers.levels.iter().enumerate().map(|(place, level)| {
        let quantity = on_level(place);
        [
            format!("{:.2}", 1e3 * level.cell_size_m),
            level.finished.to_string(),
            format!("{:.3e}", level.point_steps_per_member),
            number(quantity.map(|quantity| quantity.mean)),
            number(quantity.map(|quantity| quantity.standard_deviation)),
        ]
    });
    let columns = [
        "cells mm",
        "members",
        "point-steps of one",
        "mean",
        "adds ±",
    ];
    table("levels", columns, rows)
}

fn accuracy(quantity: &str, reached: &AccuracyReached) -> String {
    let within = reached.reached.map_or_else(|| "–".to_owned(), percent);
    let mut text = format!(
        "mean of {quantity}: {}\nwithin {within}, asked for {}: {}",
        mean(&reached.mean),
        percent(reached.target),
        needed(reached.needed),
    );
    if let (Some(members), Some(gain)) = (reached.one_level_members, reached.gain) {
        text.push_str(&format!(
            "\n{:.3e} point-steps; {members} members of the finest cells alone would take {gain:.1} times as many",
            reached.point_steps
        ));
    }
    text
}

fn needed(needed: Needed) -> &'static str {
    match needed {
        Needed::Nothing => "met",
        Needed::Members => "more members are needed",
        Needed::FinerLevel => {
            "not met, a finer level would be needed, whose scenarios are not allowed"
        }
        Needed::SmallerCells => "not met, smaller cells than allowed would be needed",
        Needed::Budget => "not met, more than the budget would be needed",
        Needed::LargerDesign => "not met, more members than a design may have would be needed",
        Needed::Successes => "not met, too many members lack it",
    }
}

fn mean(mean: &Mean) -> String {
    let bounds = [mean.lower, mean.upper].map(number).join(" to ");
    let numerical = mean.numerical_error.map_or_else(
        || "numerical not known".to_owned(),
        |error| format!("numerical {error:.4}"),
    );
    let sampling = number(mean.sampling_error);
    let estimate = number(mean.estimate);
    format!("{estimate} ({bounds}; sampling error {sampling}, {numerical})")
}

fn one(study: &Study, question: &Question, answer: &Answer) -> String {
    match (question, answer) {
        (Question::Rest(asked), Answer::Rest(rest)) => {
            let rows = rest.regions.iter().map(region);
            let title = format!("where body {} comes to rest", asked.body);
            let mut text = table(
                &title,
                ["probability", "area m²", "±", "members within"],
                rows,
            );
            for atom in &rest.atoms {
                let [x, y] = atom.place_m;
                let share = percent(atom.share);
                text.push_str(&format!("  {share} rest at x {x:.4} m, y {y:.4} m\n"));
            }
            if let Some([x, y]) = rest.numerical_error_m {
                text.push_str(&format!(
                    "  cells of the finest level may shift places by {x:.4} m downstream, {y:.4} m across\n"
                ));
            }
            if rest.moving > 0 {
                text.push_str(&format!(
                    "  {} still moved when their run ended\n",
                    rest.moving
                ));
            }
            text
        }
        (Question::Exceeds(asked), Answer::Exceeds(curve)) => {
            let title = format!(
                "how likely {} exceeds",
                of_body(&asked.quantity, asked.body)
            );
            let rows = curve.iter().map(|point| {
                let [estimate, bounds] = probability(&point.probability);
                [point.threshold.to_string(), estimate, bounds]
            });
            table(&title, ["threshold", "probability", "95 %"], rows)
        }
        (Question::Buried(asked), Answer::Buried(buried)) => {
            let [estimate, bounds] = probability(buried);
            format!(
                "body {} ends more than {} m below the surface: {estimate} ({bounds})",
                asked.body, asked.deeper_than_m
            )
        }
        (Question::Mean(asked), Answer::Mean(found)) => {
            let quantity = of_body(&asked.quantity, asked.body);
            format!("mean of {quantity}: {}", mean(found))
        }
        (Question::Quantiles(asked), Answer::Quantiles(quantiles)) => {
            let title = format!("quantiles of {}", of_body(&asked.quantity, asked.body));
            let rows = quantiles.iter().map(|quantile| {
                let bounds = [quantile.lower, quantile.upper].map(number);
                [
                    percent(quantile.probability),
                    number(quantile.estimate),
                    bounds.join(" to "),
                ]
            });
            table(&title, ["quantile", "value", "95 %"], rows)
        }
        (Question::Sensitivity(asked), Answer::Sensitivity(Some(measures))) => {
            let quantity = of_body(&asked.quantity, asked.body);
            sensitivity(study, &quantity, measures)
        }
        (Question::Sensitivity(asked), Answer::Sensitivity(None)) => format!(
            "what {} depends on: not known, as it does not vary or too few members have it",
            of_body(&asked.quantity, asked.body)
        ),
        _ => String::new(),
    }
}

fn sensitivity(study: &Study, quantity: &str, measures: &Measures) -> String {
    let title = format!("what {quantity} depends on");
    let name = |place: usize| study.inputs[place].pointer.clone();
    match measures {
        Measures::Sobol(indices) => {
            let rows = indices.inputs.iter().enumerate().map(|(place, index)| {
                let [first, total] = [&index.first_order, &index.total].map(estimate);
                [name(place), first, total]
            });
            table(&title, ["input", "first order", "total"], rows)
        }
        Measures::FirstOrder(indices) => {
            let rows = indices.inputs.iter().enumerate();
            let rows = rows.map(|(place, index)| [name(place), estimate(&index.first_order)]);
            table(&title, ["input", "first order"], rows)
        }
        Measures::Elementary(effects) => {
            let rows = effects.inputs.iter().enumerate().map(|(place, effect)| {
                let [size, deviation] = [&effect.mean_size, &effect.deviation].map(moment);
                [name(place), size, deviation]
            });
            table(&title, ["input", "μ*", "σ"], rows)
        }
    }
}

fn region(region: &Region) -> [String; 4] {
    let [estimate, bounds] = probability(&region.members);
    [
        percent(region.probability),
        format!("{:.4}", region.area_m2),
        format!("{:.4}", region.area_standard_error_m2),
        format!("{estimate} ({bounds})"),
    ]
}

fn probability(probability: &Probability) -> [String; 2] {
    let estimate = probability.estimate.map_or_else(|| "–".to_owned(), percent);
    let bounds = [probability.lower, probability.upper].map(percent);
    [estimate, bounds.join(" to ")]
}

fn estimate(estimate: &Estimate) -> String {
    format!(
        "{:.3} ({:.3} to {:.3})",
        estimate.value, estimate.lower, estimate.upper
    )
}

fn moment(moment: &Moment) -> String {
    format!("{:.4} ± {:.4}", moment.value, moment.standard_error)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.4}"))
}

fn of_body(quantity: &str, body: Option<usize>) -> String {
    body.map_or_else(
        || quantity.to_owned(),
        |body| format!("{quantity} of body {body}"),
    )
}
