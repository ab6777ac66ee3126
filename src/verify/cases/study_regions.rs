//! Case 21: coverage of the regions of studies.
//!
//! Two studies in coarse cells: the source paper's cube, and a cube that a barrier catches or the
//! flow carries through the gap beside it, so that its resting place has two peaks. Each is
//! computed with several seeds, whose Sobol' designs are scrambled independently: to the regions of
//! one seed the members of all others are fresh draws. Reference solution: the probability of the
//! region. Tolerance: of the fresh members the 90 % region holds 90 ± 2 %, with the first seed and
//! on average over the seeds. A body that still moves at the end has no resting place; such a
//! member counts neither as within nor as outside. Their share, and the scatter from seed to seed,
//! are reported. The small version has too few members for a tolerance.

use crate::machine::cores;
use crate::runs::RunControl;
use crate::studies::local;
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, Cost};
use crate::verify::{Case, Effort, How};
use scree_solver::scenario::Maps;
use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{Design, Ensemble, MemberId, Sobol, Study};
use std::time::Instant;

pub(super) const CASE: Case = Case {
    name: "study-regions",
    number: "21",
    title: "regions of studies hold their share of further members",
    source: "the probability that a region is of",
    how: How::Runs(run),
};

/// Studies by name.
const STUDIES: [(&str, &str); 2] = [
    (
        "source paper",
        include_str!("../../../configs/studies/source_paper.json"),
    ),
    ("gap", include_str!("../../../configs/studies/gap.json")),
];
/// Members of a study and number of seeds, small and full version.
const SIZES: [(u64, u64); 2] = [(32, 2), (256, 5)];
/// Probabilities of the regions.
const PROBABILITIES: [f64; 4] = [0.5, 0.75, 0.9, 0.95];
/// Probability with a tolerance, and the largest error of the share within.
const JUDGED: (f64, f64) = (0.9, 0.02);
/// Body whose resting place is asked for.
const BODY: usize = 0;

fn run(effort: Effort, findings: &mut Findings) {
    let (members, seeds) = SIZES[usize::from(effort == Effort::Full)];
    for (name, document) in STUDIES {
        let started = Instant::now();
        let computed = (1..=seeds).map(|seed| Computed::of(document, members, seed));
        let computed: Vec<Computed> = computed.collect();
        let cost = Cost {
            wall_s: started.elapsed().as_secs_f64(),
            point_steps_per_s: None,
        };
        let shares: Vec<[f64; 4]> = (0..computed.len())
            .map(|seed| shares_within(&computed, seed))
            .collect();
        let first = Resolution::named(format!("{members} members, seed 1"));
        take(name, effort, &first, (shares[0], cost), findings);
        let mean = Resolution::named(format!("{members} members, mean of {seeds} seeds"));
        let means = [0, 1, 2, 3].map(|region| statistics(&shares, region).0);
        take(name, effort, &mean, (means, Cost::default()), findings);
        scatter(name, &mean, &shares, findings);
        unknown(name, &mean, &computed, findings);
    }
}

/// Members of a study with one seed, and the regions that follow from them.
struct Computed {
    places: RestingPlaces,
    rest: RestDistribution,
}

impl Computed {
    fn of(document: &str, members: u64, seed: u64) -> Self {
        let mut study: Study = serde_json::from_str(document).expect("it is a study");
        study.design = Design::Sobol(Sobol { members, seed });
        let ensemble = Ensemble::of(&study).expect("the study breaks no rule");
        let ids: Vec<MemberId> = study.ids().collect();
        let mut ended = Vec::new();
        let control = RunControl::default();
        local::compute(
            (&ensemble, &Maps::default()),
            &ids,
            (cores(), &control),
            |member| {
                ended.push(member);
            },
        );
        let places = RestingPlaces::of(&ensemble, &ended, BODY);
        let rest = RestDistribution::of(&places, &PROBABILITIES);
        Self { places, rest }
    }
}

/// Shares of the members of all other seeds within the regions of one; NaN of regions that take
/// more members.
fn shares_within(computed: &[Computed], seed: usize) -> [f64; 4] {
    let others = computed.iter().enumerate().filter(|(one, _)| *one != seed);
    let fresh: Vec<[f64; 2]> = others
        .flat_map(|(_, other)| other.places.places_m.iter().copied())
        .collect();
    let rest = &computed[seed].rest;
    PROBABILITIES.map(|probability| {
        let mut regions = rest.regions.iter();
        let region = regions.position(|region| region.probability == probability);
        region.map_or(f64::NAN, |region| {
            let within = fresh.iter().filter(|place| rest.contains(region, **place));
            within.count() as f64 / fresh.len() as f64
        })
    })
}

/// Mean and standard deviation of the shares within a region over the seeds.
fn statistics(shares: &[[f64; 4]], region: usize) -> (f64, f64) {
    let count = shares.len() as f64;
    let mean = shares.iter().map(|one| one[region]).sum::<f64>() / count;
    let squares = shares.iter().map(|one| (one[region] - mean).powi(2));
    (mean, (squares.sum::<f64>() / (count - 1.0)).sqrt())
}

fn take(
    name: &str,
    effort: Effort,
    resolution: &Resolution,
    (values, cost): ([f64; 4], Cost),
    findings: &mut Findings,
) {
    let questions = PROBABILITIES.map(|probability| {
        let quantity = format!("{name}, within {:.0} %", 100.0 * probability);
        let question = Question::new(quantity, "", probability).by(Error::Absolute);
        match effort {
            Effort::Full if probability == JUDGED.0 => question.within(JUDGED.1),
            _ => question,
        }
    });
    findings.take(resolution, questions, Ok(Answer { values, cost }));
}

fn scatter(name: &str, resolution: &Resolution, shares: &[[f64; 4]], findings: &mut Findings) {
    let questions = PROBABILITIES.map(|probability| {
        let quantity = format!("{name}, scatter within {:.0} %", 100.0 * probability);
        Question::new(quantity, "", 0.0).by(Error::Absolute)
    });
    let values = [0, 1, 2, 3].map(|region| statistics(shares, region).1);
    let cost = Cost::default();
    findings.take(resolution, questions, Ok(Answer { values, cost }));
}

fn unknown(name: &str, resolution: &Resolution, computed: &[Computed], findings: &mut Findings) {
    let unknown: u64 = computed.iter().map(|one| one.places.unknown).sum();
    let known: usize = computed.iter().map(|one| one.places.places_m.len()).sum();
    let question = Question::new(format!("{name}, without a place"), "", 0.0).by(Error::Absolute);
    let values = [unknown as f64 / (unknown as f64 + known as f64)];
    let cost = Cost::default();
    findings.take(resolution, [question], Ok(Answer { values, cost }));
}
