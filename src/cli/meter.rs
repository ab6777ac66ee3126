//! Progress of a run for people.

use super::console;
use indicatif::{ProgressBar, ProgressStyle};
use scree::runs::Progress;
use std::io::IsTerminal;

/// Positions of the bar.
const TICKS: u64 = 1_000;

/// Share of the run between two lines if there is no terminal.
const LINE_STEP: f64 = 0.1;

/// A progress bar on a terminal; otherwise silence or a line at every tenth.
#[derive(Debug)]
pub(super) enum Meter {
    /// A bar on standard error.
    Bar(ProgressBar),
    /// A line each time the next tenth is reached.
    Lines {
        /// Share of the run at which the next line is due.
        next: f64,
    },
    /// No output.
    Silent,
}

impl Meter {
    /// A bar if standard error is a terminal, else no output.
    pub(super) fn bar_or_silence() -> Self {
        Self::bar().unwrap_or(Self::Silent)
    }

    /// A bar if standard error is a terminal, else lines.
    pub(super) fn bar_or_lines() -> Self {
        Self::bar().unwrap_or(Self::Lines { next: LINE_STEP })
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
            Self::Lines { next } => {
                if progress.fraction >= *next {
                    let percent = (progress.fraction * 100.0).floor();
                    console::note(&format!("{percent:>3} %  {}", in_words(progress)));
                    *next = ((progress.fraction / LINE_STEP).floor() + 1.0) * LINE_STEP;
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

    /// Lines are printed once per tenth however often progress is reported, and a jump over
    /// several tenths is one line.
    #[test]
    fn lines_are_due_once_a_tenth() {
        let mut meter = Meter::Lines { next: LINE_STEP };
        let mut due = Vec::new();
        for fraction in [0.05, 0.1, 0.15, 0.55, 0.58, 0.61] {
            meter.show(&Progress {
                fraction,
                ..Progress::default()
            });
            if let Meter::Lines { next } = meter {
                due.push((next * 10.0).round() as i32);
            }
        }
        assert_eq!(due, [1, 2, 2, 6, 6, 7]);
    }
}
