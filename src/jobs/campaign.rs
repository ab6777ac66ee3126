//! Runs all that a scenario's answer needs: the companions of its bands, then the
//! answer, or as many runs as its target takes.

use super::progress::Progress;
use super::runner::{self, RunEnd, RunError, Sink, StopFlag};
use scree_solver::accuracy::{Campaign, Rung};
use scree_solver::record::Record;
use scree_solver::scenario::Scenario;
use std::time::Instant;

/// Runs `scenario` on `threads` solver threads from its start to its end or until
/// `stop` is raised. The sink gets the records of the answer alone, as they come; of
/// an answer whose cells a target chooses, once it is found. Progress is that of
/// everything together.
///
/// # Errors
/// See [`RunError`]; what the sink had taken by then stays valid.
pub fn run<S: Sink>(
    scenario: &Scenario,
    threads: usize,
    stop: &StopFlag,
    sink: &mut S,
) -> Result<RunEnd, RunError<S::Error>> {
    let mut campaign = Campaign::of(scenario)?;
    let mut whole = Whole::new(sink);
    let mut failure = None;
    while let Some(rung) = campaign.next() {
        let mut part = Part {
            whole: &mut whole,
            campaign: &campaign,
            fate: Fate::of(&campaign, rung),
            kept: Vec::new(),
        };
        let ended = runner::run(&campaign.scenario_of(rung), threads, stop, &mut part);
        let Part { fate, kept, .. } = part;
        match ended {
            Ok(RunEnd::Stopped) => return Ok(RunEnd::Stopped),
            Ok(RunEnd::Completed(outcome)) => {
                if fate == Fate::Kept {
                    whole.kept = kept;
                }
                campaign.take(Ok(*outcome));
            }
            Err(RunError::Step(error)) if campaign.can_do_without(rung) => {
                campaign.take(Err(error.to_string()));
                failure = Some(error);
            }
            Err(error) => return Err(error),
        }
    }
    whole.hand_on_kept().map_err(RunError::Sink)?;
    match (campaign.finish(), failure) {
        (Some(answer), _) => Ok(RunEnd::Completed(Box::new(answer))),
        (None, Some(error)) => Err(error.into()),
        (None, None) => Ok(RunEnd::Stopped),
    }
}

/// What becomes of a run's records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// A companion's: nobody wants them.
    Dropped,
    /// Those of what will be the answer.
    HandedOn,
    /// Those of what will be the answer unless a finer run follows.
    Kept,
}

impl Fate {
    fn of(campaign: &Campaign, rung: Rung) -> Self {
        match (campaign.may_be_the_answer(rung), campaign.has_a_target()) {
            (false, _) => Self::Dropped,
            (true, false) => Self::HandedOn,
            (true, true) => Self::Kept,
        }
    }
}

/// All runs together, and the sink behind them.
struct Whole<'a, S> {
    sink: &'a mut S,
    kept: Vec<Record>,
    began: Instant,
    /// Share told last: it never goes back, though a target may ask for more.
    told: f64,
}

impl<'a, S: Sink> Whole<'a, S> {
    fn new(sink: &'a mut S) -> Self {
        Self {
            sink,
            kept: Vec::new(),
            began: Instant::now(),
            told: 0.0,
        }
    }

    /// The progress of a run as part of the whole.
    fn tell(&mut self, run: &Progress, fraction: f64) -> Result<(), S::Error> {
        let fraction = fraction.clamp(self.told, 1.0);
        self.told = fraction;
        let going = fraction > 0.0 && fraction < 1.0;
        let elapsed = self.began.elapsed().as_secs_f64();
        self.sink.progress(&Progress {
            fraction,
            eta_s: going.then(|| elapsed * (1.0 - fraction) / fraction),
            ..*run
        })
    }

    fn hand_on_kept(&mut self) -> Result<(), S::Error> {
        let mut kept = std::mem::take(&mut self.kept).into_iter();
        kept.try_for_each(|record| self.sink.record(record))
    }
}

/// The sink of one run.
struct Part<'a, 'b, S> {
    whole: &'a mut Whole<'b, S>,
    campaign: &'a Campaign,
    fate: Fate,
    kept: Vec<Record>,
}

impl<S: Sink> Sink for Part<'_, '_, S> {
    type Error = S::Error;

    fn record(&mut self, record: Record) -> Result<(), S::Error> {
        match self.fate {
            Fate::Dropped => {}
            Fate::HandedOn => self.whole.sink.record(record)?,
            Fate::Kept => self.kept.push(record),
        }
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), S::Error> {
        let fraction = self.campaign.share_done(progress.fraction);
        self.whole.tell(progress, fraction)
    }
}
