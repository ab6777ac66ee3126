//! A run in a process of its own, with its wall time and memory.

use crate::cli::failure::Failure;
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use std::io::Write;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use std::{fs, thread};

/// Time after which a new process waits for its scenario.
const STARTED_AFTER: Duration = Duration::from_millis(100);
/// Time between two looks at a process's memory.
const LOOK_INTERVAL: Duration = Duration::from_millis(5);

/// A finished run.
pub(super) struct OwnRun {
    /// Wall time of the process once it has its scenario [s].
    pub(super) wall_s: f64,
    /// Growth of its resident memory, at its largest, over the idle process [bytes]; `None` where
    /// the system does not tell.
    pub(super) memory_bytes: Option<u64>,
    pub(super) outcome: Outcome,
}

/// Runs a scenario by `scree run`: memory that this process has once had would be none that the
/// run needs.
pub(super) fn run(scenario: &Scenario, threads: usize) -> Result<OwnRun, Failure> {
    let mut child = start(threads).map_err(|error| failed(&error.to_string()))?;
    thread::sleep(STARTED_AFTER);
    let id = child.id();
    let idle = memory(id, "VmRSS:");
    let begun = Instant::now();
    let (output, peak) = thread::scope(|scope| {
        let peak = scope.spawn(|| peak(id));
        let output = hand_over(&mut child, scenario).and_then(|()| child.wait_with_output());
        (output, peak.join().ok().flatten())
    });
    let wall_s = begun.elapsed().as_secs_f64();
    let output = output.map_err(|error| failed(&error.to_string()))?;
    if !output.status.success() {
        return Err(failed(&String::from_utf8_lossy(&output.stderr)));
    }
    Ok(OwnRun {
        wall_s,
        memory_bytes: peak.zip(idle).map(|(peak, idle)| peak.saturating_sub(idle)),
        outcome: serde_json::from_slice(&output.stdout)?,
    })
}

fn start(threads: usize) -> std::io::Result<Child> {
    Command::new(std::env::current_exe()?)
        .args(["run", "-", "--json", "--threads", &threads.to_string()])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
}

/// Gives the process its scenario; the end of its input follows.
fn hand_over(child: &mut Child, scenario: &Scenario) -> std::io::Result<()> {
    match child.stdin.take() {
        Some(mut input) => input.write_all(scenario.to_json().as_bytes()),
        None => Ok(()),
    }
}

/// Largest resident memory that the process ever has [bytes], looked at until its end.
fn peak(id: u32) -> Option<u64> {
    let mut largest = None;
    while let Some(bytes) = memory(id, "VmHWM:") {
        largest = Some(bytes);
        thread::sleep(LOOK_INTERVAL);
    }
    largest
}

/// A quantity of memory of a process that has not ended [bytes], where Linux tells it.
fn memory(id: u32, quantity: &str) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{id}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(quantity));
    let kilobytes: u64 = line?.split_whitespace().next()?.parse().ok()?;
    Some(1024 * kilobytes)
}

fn failed(reason: &str) -> Failure {
    Failure::Other(format!("a run in a process of its own failed: {reason}"))
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn memory_of_a_process_is_told_while_it_lives() {
        let own = std::process::id();
        assert!(memory(own, "VmRSS:") > Some(1 << 16));
        assert!(memory(own, "VmRSS:") <= memory(own, "VmHWM:"));
        assert_eq!(memory(own, "VmNone:"), None);
        assert_eq!(memory(u32::MAX, "VmRSS:"), None);
    }
}
