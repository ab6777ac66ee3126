//! `scree verify`: the solver against cases of known answer.

mod figures;
mod markdown;
mod robustness_tables;

use super::arguments::{Quiet, SuiteWord, VerifyOptions};
use super::columns::{millions, table};
use super::console;
use super::failure::Failure;
use super::machine::Machine;
use scree::verify::findings::{Count, Error, Finding, Verdict};
use scree::verify::limit::Limit;
use scree::verify::order::Order;
use scree::verify::robustness::randomised::{Field, RandomisedReport, randomised};
use scree::verify::robustness::trial::TrialReport;
use scree::verify::robustness::{self, Family, try_family};
use scree::verify::{Case, Effort, How, Verified, cases, count, verify as run_case, work};
use scree_solver::VERSION;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::IsTerminal;

/// Sign for a missing value.
const NOTHING: &str = "–";

/// All results of the verification.
#[derive(Debug, Serialize)]
struct Report {
    solver_version: &'static str,
    machine: Machine,
    effort: Effort,
    count: Count,
    cases: Vec<Verified>,
    robustness: Vec<TrialReport>,
    randomised: Vec<RandomisedReport>,
}

/// Runs the cases asked for and prints the findings.
///
/// # Errors
/// An unknown case, or one that failed its tolerance.
pub(super) fn verify(options: &VerifyOptions) -> Result<(), Failure> {
    let effort = if options.full {
        Effort::Full
    } else {
        Effort::Quick
    };
    let page = options.markdown.as_deref().map(markdown::Page::open);
    let page = page.transpose()?;
    let asked = Asked::of(options)?;
    let mut verified = Vec::new();
    for case in asked.cases {
        tell_of(case.name, options.quiet);
        verified.push(run_case(case, effort));
    }
    let mut tried = Vec::new();
    for family in asked.families {
        tell_of(family.name, options.quiet);
        tried.extend(try_family(family, effort, options.full));
    }
    let tell = |failing: &_| console::note(&robustness_tables::in_words(failing));
    let fields = asked.randomised.iter();
    let report = fields.map(|field| randomised(*field, options.seed, options.count, &tell));
    let report = Report {
        solver_version: VERSION,
        machine: Machine::here(),
        effort,
        count: count(&verified),
        cases: verified,
        robustness: tried,
        randomised: report.collect(),
    };
    let answer = if options.json {
        serde_json::to_string_pretty(&report)?
    } else {
        report.tables()
    };
    if let Some(folder) = &options.figures {
        let machine = report.machine.in_words();
        let way = cases::slide_over_a_rim().map_err(|error| Failure::Other(error.to_string()))?;
        figures::write_slide(&way, folder)?;
        figures::write(&work::diagrams(effort), &machine, folder)?;
    }
    if let Some(page) = &page {
        page.write(&report)?;
    }
    console::only_answer(&answer)?;
    match report.failed() {
        0 => Ok(()),
        failed => Err(Failure::Missed(failed)),
    }
}

/// Announces the case that runs to the user.
fn tell_of(name: &str, quiet: Quiet) {
    if std::io::stderr().is_terminal() {
        quiet.note(&format!("verifying: {name}"));
    }
}

/// Cases to be run.
struct Asked {
    cases: Vec<&'static Case>,
    families: Vec<&'static Family>,
    randomised: &'static [Field],
}

impl Asked {
    /// The cases with the names given, in the order of the lists; all of the suite if
    /// no name is given. A name may belong to any suite.
    fn of(options: &VerifyOptions) -> Result<Self, Failure> {
        let (suite, names) = (options.suite, &options.case);
        let all = cases::ALL.iter().map(|case| case.name);
        let all = all.chain(robustness::cases::ALL.iter().map(|family| family.name));
        let all: Vec<&str> = all.collect();
        if let Some(unknown) = names.iter().find(|name| !all.contains(&name.as_str())) {
            let all = all.join(", ");
            return Err(Failure::Input(format!(
                "there is no case {unknown}; there are: {all}"
            )));
        }
        let asked = |name: &str, part: SuiteWord| match &names[..] {
            [] => suite.takes(part),
            names => names.iter().any(|one| one == name),
        };
        let cases = cases::ALL.iter();
        let families = robustness::cases::ALL.iter();
        Ok(Self {
            cases: cases
                .filter(|case| asked(case.name, SuiteWord::Standard))
                .collect(),
            families: families
                .filter(|family| asked(family.name, SuiteWord::Robustness))
                .collect(),
            randomised: if names.is_empty() {
                suite.randomised()
            } else {
                &[]
            },
        })
    }
}

impl Report {
    /// Number of failed tolerances, of robustness tests that broke a rule, and of failures and
    /// missing runs of randomised tests.
    fn failed(&self) -> usize {
        let broken = self
            .robustness
            .iter()
            .filter(|tried| !tried.is_valid())
            .count();
        let of_report =
            |report: &RandomisedReport| report.failures.len() + report.not_run() as usize;
        let of_randomised: usize = self.randomised.iter().map(of_report).sum();
        self.count.failed + broken + of_randomised
    }

    /// Version, machine and effort.
    fn heading(&self) -> String {
        let effort = match self.effort {
            Effort::Quick => "quick: small versions",
            Effort::Full => "full",
        };
        let machine = self.machine.in_words();
        format!("Scree {}; {machine}\n{effort}", self.solver_version)
    }

    /// All verdicts together.
    fn ending(&self) -> String {
        let Count {
            passed,
            failed,
            reported,
        } = self.count;
        let not_yet = |one: &&Verified| matches!(one.case.how, How::NotYet(_));
        let not_yet = self.cases.iter().filter(not_yet).count();
        format!(
            "{passed} passed, {failed} failed, {reported} reported only; \
             cases not yet expressible: {not_yet}"
        )
    }

    fn tables(&self) -> String {
        let mut text = self.heading() + "\n";
        for verified in &self.cases {
            let _ = write!(text, "\n{}", page(verified));
        }
        if !self.cases.is_empty() {
            let _ = write!(text, "\n{}", self.ending());
        }
        text.push_str(&robustness_tables::tables(self));
        text
    }
}

/// Report of a case for people.
fn page(Verified { case, found }: &Verified) -> String {
    let mut text = format!(
        "{} {}: {}\n  reference: {}\n",
        case.number, case.name, case.title, case.source
    );
    if let How::NotYet(why) = case.how {
        let _ = writeln!(text, "  not yet expressible: {why}");
        return text;
    }
    let headings = [
        "quantity",
        "resolution",
        "measured",
        "reference",
        "unit",
        "error",
        "tolerance",
        "wall [s]",
        "M point-steps/s",
        "verdict",
    ];
    text.push_str(&table("", headings, found.values.iter().map(row))[1..]);
    for failure in found.values.iter().filter_map(|one| one.failure.as_ref()) {
        let _ = writeln!(text, "  failed: {failure}");
    }
    for order in &found.orders {
        let _ = writeln!(text, "  {}", order_in_words(order));
    }
    for limit in &found.limits {
        let _ = writeln!(text, "  {}", limit_in_words(limit));
    }
    text
}

fn row(finding: &Finding) -> [String; 10] {
    let question = &finding.question;
    let of = match question.error {
        Error::Relative => String::new(),
        Error::Absolute => unit(question.unit),
        Error::Over { of, .. } => unit(of),
    };
    let optional = |value: Option<f64>, show: fn(f64) -> String| {
        value.map_or_else(|| NOTHING.to_owned(), show)
    };
    [
        question.quantity.clone(),
        finding.resolution.label.clone(),
        optional(finding.measured, number),
        number(question.reference),
        question.unit.to_owned(),
        optional(finding.measured_error, |error| format!("{error:+.1e}")) + &of,
        optional(question.tolerance, |tolerance| format!("{tolerance:.1e}")),
        format!("{:.2}", finding.cost.wall_s),
        optional(finding.cost.point_steps_per_s, millions),
        word(finding.verdict).to_owned(),
    ]
}

fn unit(unit: &str) -> String {
    format!(" {unit}")
}

/// A value with six digits.
fn number(value: f64) -> String {
    let size = value.abs();
    if value != 0.0 && !(1e-3..1e6).contains(&size) {
        return format!("{value:.4e}");
    }
    let before = if size >= 1.0 {
        size.log10() as usize
    } else {
        0
    };
    format!("{value:.*}", 6 - before.min(6))
}

fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "FAIL",
        Verdict::Report => "report",
    }
}

fn order_in_words(order: &Order) -> String {
    let mut text = format!("order of {}: ", order.quantity);
    match order.fitted {
        Some(fitted) => {
            let pairs = order.pairwise.iter().map(|pair| format!("{pair:.2}"));
            let pairs = pairs.collect::<Vec<_>>().join(", ");
            let _ = write!(text, "{fitted:.2} (pairwise {pairs})");
        }
        None => text.push_str("none, fewer than three resolutions"),
    }
    let _ = write!(text, " over {}", order.used.join("; "));
    if !order.on_the_floor.is_empty() {
        let out = order.on_the_floor.join("; ");
        let _ = write!(text, "; on the floor of {:.0e}: {out}", order.floor);
    }
    if let Some(asked) = order.asked {
        let _ = write!(text, "; asked {asked}: {}", word(order.verdict));
    }
    text
}

fn limit_in_words(limit: &Limit) -> String {
    let over = limit.over.join("; ");
    let found = match limit.found {
        Some(found) => format!(
            "{} {} (order {:.2})",
            number(found.limit),
            limit.unit,
            found.order
        ),
        None => "none, the values don't settle".to_owned(),
    };
    format!("limit of {}: {found} over {over}", limit.quantity)
}

#[cfg(test)]
mod tests {
    use super::*;

    // Every case of the list can be run: a case listed before it can be run must not
    // appear to have been run.
    #[test]
    fn a_case_that_cannot_be_run_yet_says_why() {
        let case = Case {
            name: "perpetual-motion",
            number: "0",
            title: "a wheel that turns for ever",
            source: "none",
            how: How::NotYet("friction is not negative"),
        };
        let verified = run_case(&case, Effort::Quick);
        assert_eq!(verified.found.count(), Count::default());
        let report = Report {
            solver_version: VERSION,
            machine: Machine::here(),
            effort: Effort::Quick,
            count: Count::default(),
            cases: vec![verified],
            robustness: Vec::new(),
            randomised: Vec::new(),
        };
        let text = report.tables();
        assert!(text.contains("not yet expressible: friction is not negative"));
        assert!(text.ends_with("cases not yet expressible: 1"), "{text}");
        assert!(!text.contains("verdict"), "{text}");
    }

    // Regression: a seed without a legal draw was once skipped silently.
    #[test]
    fn a_sweep_that_ran_less_than_asked_fails() {
        let report = |run: u64| Report {
            solver_version: VERSION,
            machine: Machine::here(),
            effort: Effort::Quick,
            count: Count::default(),
            cases: Vec::new(),
            robustness: Vec::new(),
            randomised: vec![RandomisedReport {
                asked: 10,
                run,
                ..RandomisedReport::default()
            }],
        };
        assert_eq!(report(10).failed(), 0);
        assert!(!report(10).tables().contains("NOT RUN"));
        assert_eq!(report(8).failed(), 2);
        let text = report(8).tables();
        assert!(text.contains("2 of 10 NOT RUN"), "{text}");
    }

    #[test]
    fn all_suites_are_all() {
        use clap::ValueEnum;
        let parts = SuiteWord::value_variants().iter();
        for part in parts.filter(|part| **part != SuiteWord::All) {
            assert!(
                part.randomised()
                    .iter()
                    .all(|field| SuiteWord::All.randomised().contains(field)),
                "{part:?}"
            );
            assert!(
                !part.randomised().is_empty() || SuiteWord::All.takes(*part),
                "{part:?}"
            );
        }
    }
}
