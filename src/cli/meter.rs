//! Progress of a run for people.

use super::console;
use indicatif::{ProgressBar, ProgressStyle};
use scree::runs::Progress;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Positions of the bar.
const TICKS: u64 = 1_000;

/// Least time between two lines, so that quick runs fill no log.
const LEAST_PAUSE: Duration = Duration::from_secs(2);

/// Longest time between two lines, so that slow runs are seen to go on.
const LONGEST_PAUSE: Duration = Duration::from_secs(10);

/// A progress bar on a terminal, otherwise lines; nothing if that is asked for.
#[derive(Debug)]
pub(super) enum Meter {
    /// A bar on standard error.
    Bar(ProgressBar),
    /// Lines on standard error, without control codes.
    Lines(LineSchedule),
    /// Nothing.
    Silent,
}

/// Schedule of lines: at every tenth of the run, but neither too often nor too seldom.
#[derive(Debug)]
pub(super) struct LineSchedule {
    /// Tenths of the run at which the next line is due.
    next: u32,
    /// Time of the last line.
    last: Instant,
}

impl LineSchedule {
    fn new(now: Instant) -> Self {
        Self { next: 1, last: now }
    }

    /// True if a line is due; the next one is then due later.
    fn is_due(&mut self, fraction: f64, now: Instant) -> bool {
        let tenths = (fraction * 10.0) as u32;
        let pause = now - self.last;
        let due = (tenths >= self.next && pause >= LEAST_PAUSE) || pause >= LONGEST_PAUSE;
        if due {
            self.next = tenths + 1;
            self.last = now;
        }
        due
    }
}

impl Meter {
    /// A bar if standard error is a terminal, else lines.
    pub(super) fn bar_or_lines() -> Self {
        Self::bar().unwrap_or_else(|| Self::Lines(LineSchedule::new(Instant::now())))
    }

    /// True if it shows nothing.
    pub(super) fn is_silent(&self) -> bool {
        matches!(self, Self::Silent)
    }

    fn bar() -> Option<Self> {
        let template = "{wide_bar} {percent:>3} %  {msg}";
        let style = ProgressStyle::with_template(template).ok()?;
        let terminal = std::io::stderr().is_terminal();
        terminal.then(|| Self::Bar(ProgressBar::new(TICKS).with_style(style)))
    }

    /// Shows this progress.
    pub(super) fn show(&mut self, progress: &Progress) {
        match self {
            Self::Bar(bar) => {
                bar.set_position((progress.fraction * TICKS as f64) as u64);
                bar.set_message(in_words(progress));
            }
            Self::Lines(schedule) => {
                if schedule.is_due(progress.fraction, Instant::now()) {
                    let percent = (progress.fraction * 100.0).floor();
                    console::note(&format!("{percent:>3} %  {}", in_words(progress)));
                }
            }
            Self::Silent => {}
        }
    }

    /// Removes the bar.
    pub(super) fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}

/// Simulated time, pace and remaining time.
fn in_words(progress: &Progress) -> String {
    let to_go = progress.eta_s.map_or(String::new(), |eta_s| {
        let seconds = eta_s.ceil().clamp(0.0, 1e9) as u64;
        format!(", {}:{:02} min to go", seconds / 60, seconds % 60)
    });
    format!(
        "t = {:.3} s, {:.1} M point-steps/s{to_go}",
        progress.simulated_time_s,
        progress.point_steps_per_s / 1e6
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_reads_well() {
        let progress = Progress {
            fraction: 0.4,
            simulated_time_s: 1.2,
            steps: 1,
            substeps: 2,
            point_steps_per_s: 4.25e6,
            eta_s: Some(125.2),
        };
        let expected = "t = 1.200 s, 4.2 M point-steps/s, 2:06 min to go";
        assert_eq!(in_words(&progress), expected);
    }

    /// A line per tenth if tenths take a while, one for several if they are quick, and one
    /// every ten seconds if they are slow.
    #[test]
    fn lines_are_neither_too_many_nor_too_few() {
        let percents_told = |seconds_per_percent: f64| {
            let began = Instant::now();
            let mut schedule = LineSchedule::new(began);
            let told = (1..=100).filter(|percent| {
                let percent = f64::from(*percent);
                let now = began + Duration::from_secs_f64(percent * seconds_per_percent);
                schedule.is_due(percent / 100.0, now)
            });
            told.collect::<Vec<i32>>()
        };
        assert_eq!(percents_told(0.015), [0; 0]);
        assert_eq!(percents_told(0.1), [20, 40, 60, 80, 100]);
        assert_eq!(
            percents_told(0.5),
            [10, 20, 30, 40, 50, 60, 70, 80, 90, 100]
        );
        assert_eq!(percents_told(5.0)[..5], [2, 4, 6, 8, 10]);
    }
}
