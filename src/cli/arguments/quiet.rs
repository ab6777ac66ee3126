//! `--quiet`.

use crate::cli::console;
use crate::cli::meter::Meter;
use clap::Args;

/// Choice between progress and silence on standard error; errors are told in any case.
#[derive(Debug, Clone, Copy, Args)]
pub(in crate::cli) struct Quiet {
    /// Write no progress on standard error, only warnings and errors
    #[arg(long, short)]
    quiet: bool,
}

impl Quiet {
    /// Prints a note on progress.
    pub(in crate::cli) fn note(self, text: &str) {
        if !self.quiet {
            console::note(text);
        }
    }

    /// Meter of a run.
    pub(in crate::cli) fn meter(self) -> Meter {
        if self.quiet {
            Meter::Silent
        } else {
            Meter::bar_or_lines()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quiet_run_has_no_meter() {
        assert!(matches!(Quiet { quiet: true }.meter(), Meter::Silent));
        assert!(!matches!(Quiet { quiet: false }.meter(), Meter::Silent));
    }
}
