//! Attacks on the real binary: kills under load and during a run, slow clients,
//! a database that is full, corrupt or truncated.
//!
//! Each test runs a short form. The figures of docs/service.md come from the
//! long form: `ATTACK=long cargo test --test attack -- --nocapture`.

use std::sync::{Mutex, MutexGuard, PoisonError};

mod chaos;
mod client;
mod clients;
mod disk;
mod kills;
mod load;
#[cfg(unix)]
mod machines;
#[cfg(target_os = "linux")]
mod saturation;
mod served;
mod studies;

/// One attack at a time, since concurrent ones would change each other's figures.
pub(crate) fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Prints a figure, the purpose of the long form.
#[expect(
    clippy::print_stdout,
    reason = "figures are for whoever asked for them"
)]
pub(crate) fn tell(figure: &str) {
    println!("{figure}");
}

/// Intensity of the attack.
pub(crate) fn at_length(short: usize, long: usize) -> usize {
    let is_long = std::env::var_os("ATTACK").is_some_and(|word| word == "long");
    if is_long { long } else { short }
}

/// Percentile: the value below which this share of the sorted `values` lies.
pub(crate) fn percentile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let place = (values.len() as f64 * share).ceil() as usize;
    values[place.clamp(1, values.len()) - 1]
}
