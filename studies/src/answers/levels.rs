//! Levels of a study, and the accuracy that they reach.

use super::Mean;
use crate::multilevel::{LevelMeans, Needed, Progress};
use crate::outcome::Member;
use crate::study::{Accuracy, Ensemble};
use serde::{Deserialize, Serialize};

/// Level of a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct StudyLevel {
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Members on the level.
    pub members: u64,
    /// Those of them whose run came to its end.
    pub finished: u64,
    /// Mean work of such a member [point-steps], or what it is expected to be.
    pub point_steps_per_member: f64,
}

/// Accuracy that a study has reached.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyAccuracyReached))]
pub struct AccuracyReached {
    /// Mean that the accuracy is about.
    pub mean: Mean,
    /// Largest distance of the interval's ends from the mean that was asked for, over the mean.
    pub target: f64,
    /// That distance so far; none of too few members.
    pub reached: Option<f64>,
    /// Need for the target; of a study that has ended, the one that it ended with.
    pub needed: Needed,
    /// The quantity on the levels with enough members, the coarsest first.
    pub levels: Vec<QuantityOnLevel>,
    /// Work so far [point-steps].
    pub point_steps: f64,
    /// Members of the finest level alone whose mean would have the same sampling error.
    pub one_level_members: Option<u64>,
    /// Their work over the work so far: how many times cheaper the levels are.
    pub gain: Option<f64>,
}

/// A quantity on a level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct QuantityOnLevel {
    /// Mean on the level.
    pub mean: f64,
    /// Standard deviation, over the members, of what the level adds: of the residuals of a regression
    /// on the inputs, and on all but the coarsest on the next coarser level.
    pub standard_deviation: f64,
}

impl StudyLevel {
    /// Levels of a study; none of a study on one level.
    pub fn all(ensemble: &Ensemble, members: &[Member]) -> Vec<Self> {
        let study = ensemble.study();
        let costs = crate::multilevel::costs(study, members);
        let of_one = |(level, cost): (u32, f64)| {
            let of_level = members.iter().filter(|member| member.level == level);
            let first = of_level.filter(|member| member.index < study.members_on(level));
            Some(Self {
                cell_size_m: study.cell_size_m(level)?,
                members: study.members_on(level),
                finished: first.filter(|member| member.finished().is_some()).count() as u64,
                point_steps_per_member: cost,
            })
        };
        let is_one = study.finer_levels.is_empty() && study.accuracy.is_none();
        let levels = (0..).zip(costs).filter(|_| !is_one);
        levels.filter_map(of_one).collect()
    }
}

impl AccuracyReached {
    /// Accuracy reached by a study that one is asked of, with these levels.
    pub(super) fn of(
        ensemble: &Ensemble,
        members: &[Member],
        levels: &[StudyLevel],
    ) -> Option<Self> {
        let study = ensemble.study();
        let accuracy = study.accuracy.as_ref()?;
        let progress = Progress::of(ensemble, members, accuracy);
        let needed = progress.next(study, accuracy, &|_| true).needed;
        Some(Self::found(accuracy, (&progress, needed), levels))
    }

    fn found(
        accuracy: &Accuracy,
        (progress, needed): (&Progress, Needed),
        levels: &[StudyLevel],
    ) -> Self {
        let mean = progress.mean;
        let work = levels
            .iter()
            .map(|level| level.finished as f64 * level.point_steps_per_member);
        let point_steps: f64 = work.sum();
        let one_level = progress.one_level_members();
        let finest = progress.means.as_ref().map_or(0, LevelMeans::levels).max(1) - 1;
        let one_level_work = one_level.zip(progress.costs.get(finest));
        Self {
            mean,
            target: accuracy.target,
            reached: mean.relative_error(),
            needed,
            levels: progress.means.as_ref().map(on_levels).unwrap_or_default(),
            point_steps,
            one_level_members: one_level.map(|members| members.ceil() as u64),
            gain: one_level_work
                .map(|(members, cost)| members * cost / point_steps)
                .filter(|gain| gain.is_finite()),
        }
    }
}

fn on_levels(means: &LevelMeans<1>) -> Vec<QuantityOnLevel> {
    let levels = means.on_levels().into_iter();
    let of_one = |(mean, standard_deviation)| QuantityOnLevel {
        mean,
        standard_deviation,
    };
    levels.map(of_one).collect()
}
