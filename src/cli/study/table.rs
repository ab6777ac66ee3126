//! Answers of a study for people.

use crate::cli::columns::table;
use scree_studies::answers::{Answer, Estimate, Measures, Moment, Probability, Region};
use scree_studies::{Answers, Question, Study};

/// A paragraph on the members, and a table for each question.
pub(super) fn answers(study: &Study, answers: &Answers) -> String {
    let mut paragraphs = vec![members(answers)];
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
