//! Attacks on the real binary: killed under load and mid-run, clients that are
//! slow, a database that is full, broken or cut off.
//!
//! The tests run a short form each. The figures of docs/service.md come from the
//! long form: `ATTACK=long cargo test --test attack -- --nocapture`.

use std::sync::{Mutex, MutexGuard, PoisonError};

mod client;
mod clients;
mod disk;
mod kills;
mod load;
mod served;

/// One attack at a time: their figures would be each other's otherwise.
pub(crate) fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Tells a figure, which the long form is run for.
#[expect(
    clippy::print_stdout,
    reason = "figures are for whoever asked for them"
)]
pub(crate) fn tell(figure: &str) {
    println!("{figure}");
}

/// How hard to attack.
pub(crate) fn at_length(short: usize, long: usize) -> usize {
    let is_long = std::env::var_os("ATTACK").is_some_and(|word| word == "long");
    if is_long { long } else { short }
}

/// The value below which so much of the sorted `values` lies.
pub(crate) fn percentile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let place = (values.len() as f64 * share).ceil() as usize;
    values[place.clamp(1, values.len()) - 1]
}
