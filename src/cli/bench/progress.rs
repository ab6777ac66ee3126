//! Errors of the progress that runs tell: fraction and remaining wall time of ten scenes.

use super::forecasts::{SCENES, scenario};
use crate::cli::columns::table;
use crate::cli::failure::Failure;
use crate::cli::machine::cores;
use scree::runs::{Progress, RunControl, Sink, convergence_study};
use scree_solver::Scenario;
use scree_solver::record::Record;
use serde::Serialize;
use std::convert::Infallible;
use std::time::Instant;

/// Shares of the wall time at which the forecasts are shown.
const SHOWN_AT: [f64; 4] = [0.1, 0.25, 0.5, 0.75];
/// Least duration of a scene [s]: a run that comes to rest ends early.
const DURATION: f64 = 1.5;

/// Scenes, and what was told about each.
#[derive(Debug, Serialize)]
pub(super) struct Tracks {
    threads: usize,
    scenes: Vec<Track>,
}

/// Progress that one run has told.
#[derive(Debug, Serialize)]
struct Track {
    scene: &'static str,
    took_s: f64,
    /// Wall time [s], fraction and remaining wall time at each report [s].
    told: Vec<(f64, f64, Option<f64>)>,
}

/// Sink of the progress of a run.
struct Watched {
    began: Instant,
    told: Vec<(f64, f64, Option<f64>)>,
}

impl Sink for Watched {
    type Error = Infallible;

    fn record(&mut self, _: Record) -> Result<(), Infallible> {
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), Infallible> {
        let wall_s = self.began.elapsed().as_secs_f64();
        self.told.push((wall_s, progress.fraction, progress.eta_s));
        Ok(())
    }
}

/// Runs every scene.
pub(super) fn measure() -> Result<Tracks, Failure> {
    let scenes = SCENES.iter().map(|given| {
        let mut scenario = scenario(given)?;
        // Scenes that are to show the cost of many points keep their short time.
        if scenario.duration_s > 0.2 {
            scenario.duration_s = scenario.duration_s.max(DURATION);
        }
        Track::of(given.0, &scenario)
    });
    Ok(Tracks {
        threads: cores(),
        scenes: scenes.collect::<Result<_, Failure>>()?,
    })
}

impl Track {
    fn of(scene: &'static str, scenario: &Scenario) -> Result<Self, Failure> {
        let mut watched = Watched {
            began: Instant::now(),
            told: Vec::new(),
        };
        let ended = convergence_study::run(scenario, cores(), &RunControl::default(), &mut watched);
        ended.map_err(|error| Failure::Numerical(error.to_string()))?;
        Ok(Self {
            scene,
            took_s: watched.began.elapsed().as_secs_f64(),
            told: watched.told,
        })
    }

    /// Whole wall time foretold over the actual, at each report.
    fn foretold(&self) -> impl Iterator<Item = (f64, f64)> {
        let known = self.told.iter();
        known
            .filter_map(|&(wall, _, left)| Some((wall / self.took_s, (wall + left?) / self.took_s)))
    }

    /// Largest factor by which the whole was foretold wrongly after the first tenth.
    fn worst(&self) -> f64 {
        let after = self.foretold().filter(|(share, _)| *share >= SHOWN_AT[0]);
        after
            .map(|(_, over)| over.max(1.0 / over))
            .fold(1.0, f64::max)
    }

    fn is_monotone(&self) -> bool {
        self.told.windows(2).all(|two| two[0].1 <= two[1].1)
    }

    fn row(&self) -> [String; 8] {
        let at = SHOWN_AT.map(|share| {
            let first = self.foretold().find(|(at, _)| *at >= share);
            first.map_or("–".to_owned(), |(_, over)| format!("{over:.2}"))
        });
        let [a, b, c, d] = at;
        [
            self.scene.to_owned(),
            format!("{:.2}", self.took_s),
            a,
            b,
            c,
            d,
            format!("{:.2}", self.worst()),
            if self.is_monotone() { "yes" } else { "no" }.to_owned(),
        ]
    }
}

impl Tracks {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!(
            "progress: whole wall time foretold over actual, at shares of it, {} threads",
            self.threads
        );
        let headings = [
            "scene",
            "took s",
            "at 10 %",
            "25 %",
            "50 %",
            "75 %",
            "worst factor",
            "monotone",
        ];
        table(&title, headings, self.scenes.iter().map(Track::row))
    }
}
