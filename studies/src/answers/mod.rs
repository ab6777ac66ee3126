//! Answers to a study's questions, from the outcomes of its members.

mod binomial;
mod estimate;
mod failures;
mod halves;
mod levels;
mod mean;
mod probability;
mod quantiles;
mod region;
mod sample;
mod sensitivity;

pub use estimate::Estimate;
pub use failures::{Counts, Failures};
pub use levels::{AccuracyReached, QuantityOnLevel, StudyLevel};
pub use mean::Mean;
pub use probability::{Exceedance, Probability};
pub use quantiles::Quantile;
pub use region::{Atom, DensityGrid, Polygon, Region, RestDistribution};
pub use sample::{LevelError, RestingPlaces, Sample};
pub use sensitivity::{
    ElementaryEffect, ElementaryEffects, FirstOrderIndex, FirstOrderIndices, Measures, Moment,
    SobolIndex, SobolIndices,
};

use crate::outcome::Member;
use crate::study::{Ensemble, Question};
use serde::{Deserialize, Serialize};

/// Answers to a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyAnswers))]
pub struct Answers {
    /// Members by the fate of their runs, those of all levels.
    pub members: Counts,
    /// Levels, the coarsest first; none of a study on one level.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<StudyLevel>,
    /// Accuracy reached, if one is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<AccuracyReached>,
    /// Answers, in the order of the questions.
    pub answers: Vec<Answer>,
}

/// Answer to a question, of the question's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyAnswer))]
#[serde(rename_all = "snake_case")]
pub enum Answer {
    /// Distribution of the body's resting place.
    Rest(RestDistribution),
    /// Probability of each threshold.
    Exceeds(Vec<Exceedance>),
    /// Probability that the body ends below the surface.
    Buried(Probability),
    /// Mean of the quantity.
    Mean(Mean),
    /// Quantiles of the quantity.
    Quantiles(Vec<Quantile>),
    /// Inputs that the quantity depends on; none if it does not vary or too few members have it.
    Sensitivity(Option<Measures>),
}

impl Answers {
    /// Answers from the members that have an outcome; a member that is not in the list is pending.
    /// The order of the list does not matter.
    pub fn of(ensemble: &Ensemble, members: &[Member]) -> Self {
        let questions = ensemble.study().questions.iter();
        let levels = StudyLevel::all(ensemble, members);
        Self {
            members: Counts::of(ensemble, members),
            accuracy: AccuracyReached::of(ensemble, members, &levels),
            levels,
            answers: questions
                .map(|one| Answer::of(ensemble, members, one))
                .collect(),
        }
    }
}

impl Answer {
    /// Answer to one question.
    pub fn of(ensemble: &Ensemble, members: &[Member], question: &Question) -> Self {
        let sample = |name: &str, body: Option<usize>| Sample::of(ensemble, members, name, body);
        match question {
            Question::Rest(rest) => {
                let places = RestingPlaces::of(ensemble, members, rest.body);
                Self::Rest(RestDistribution::of(&places, &rest.regions))
            }
            Question::Exceeds(exceeds) => {
                let sample = sample(&exceeds.quantity, exceeds.body);
                Self::Exceeds(Exceedance::curve(&sample, &exceeds.thresholds))
            }
            Question::Buried(buried) => {
                let sample = sample("buried_m", Some(buried.body));
                Self::Buried(Probability::exceeding(&sample, buried.deeper_than_m))
            }
            Question::Mean(asked) => {
                Self::Mean(Mean::of(ensemble, members, &asked.quantity, asked.body))
            }
            Question::Quantiles(asked) => {
                let sample = sample(&asked.quantity, asked.body);
                let probabilities = asked.probabilities.iter();
                Self::Quantiles(probabilities.map(|p| Quantile::of(&sample, *p)).collect())
            }
            Question::Sensitivity(asked) => {
                let (name, body) = (&asked.quantity, asked.body);
                Self::Sensitivity(Measures::of(ensemble, members, name, body))
            }
        }
    }
}
