//! Ctrl-C and SIGTERM during a run.

use crate::cli::console;
use crate::cli::signals::{Signal, Signals};
use scree::runs::{RunControl, Stop};
use std::io;
use std::sync::{Arc, OnceLock};

/// Watch for signals: the first asks the run to stop, the second ends the process.
#[derive(Debug, Default)]
pub(super) struct Interrupts {
    stop: RunControl,
    first: OnceLock<Signal>,
}

impl Interrupts {
    /// Watches from now on, on a thread of its own.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn watch(stop: Stop) -> io::Result<Arc<Self>> {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()?;
        let mut signals = {
            let _inside = runtime.enter();
            Signals::listen()?
        };
        let watch = Arc::new(Self::default());
        let told = Arc::clone(&watch);
        std::thread::Builder::new()
            .name("signals".to_owned())
            .spawn(move || {
                told.take(runtime.block_on(signals.next()), stop);
                let second = runtime.block_on(signals.next());
                std::process::exit(i32::from(second.exit_code()));
            })?;
        Ok(watch)
    }

    fn take(&self, signal: Signal, stop: Stop) {
        let _ = self.first.set(signal);
        self.stop.ask(stop);
        if stop == Stop::OnceSaved {
            console::note("stopping at the end of this step; a second Ctrl-C ends at once");
        }
    }

    /// The request to the run.
    pub(super) fn stop(&self) -> &RunControl {
        &self.stop
    }

    /// The signal that stopped the run.
    pub(super) fn first(&self) -> Signal {
        self.first.get().copied().unwrap_or(Signal::Interrupt)
    }
}
