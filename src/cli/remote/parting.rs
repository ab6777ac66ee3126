//! Ctrl-C and SIGTERM while something goes on elsewhere: this process ends, the other goes on.

use crate::cli::failure::Failure;
use crate::cli::signals::Signals;
use std::sync::{Arc, Mutex, PoisonError};

/// Watch for signals, the first of which ends the process with a word on what goes on.
pub(super) struct Parting(Arc<Mutex<String>>);

impl Parting {
    /// Watches from now on, on a thread of its own.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn watch() -> Result<Self, Failure> {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()?;
        let mut signals = {
            let _inside = runtime.enter();
            Signals::listen()?
        };
        let words = Arc::new(Mutex::new(String::new()));
        let said = Arc::clone(&words);
        let end = move || {
            let signal = runtime.block_on(signals.next());
            let words = said.lock().unwrap_or_else(PoisonError::into_inner);
            let stopped = Failure::Stopped(signal, words.clone());
            stopped.report();
            std::process::exit(i32::from(stopped.exit_code()));
        };
        std::thread::Builder::new()
            .name("signals".to_owned())
            .spawn(end)?;
        Ok(Self(words))
    }

    /// Sets what goes on from now on.
    pub(super) fn say(&self, what_goes_on: &str) {
        let mut words = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *words = format!("; {what_goes_on}");
    }
}
