//! Cores and memory of the machine, as far as this process may have them.

use sysinfo::System;

/// Number of hardware threads.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// Memory of the machine, or of the control group that this process is in [bytes]; without end if
/// the system does not tell.
pub(crate) fn total_memory() -> u64 {
    let Some(system) = memory() else {
        return u64::MAX;
    };
    let group = system.cgroup_limits().map(|limits| limits.total_memory);
    let group = group.filter(|bytes| *bytes > 0).unwrap_or(u64::MAX);
    group.min(system.total_memory())
}

/// Memory that this process can still get: of the machine, of its control group and of its
/// resource limits [bytes].
pub(crate) fn available_memory() -> u64 {
    let system = memory();
    let machine = system.as_ref().map(System::available_memory);
    let group = system.as_ref().and_then(System::cgroup_limits);
    let group = group.map(|limits| limits.free_memory);
    let free = [machine, group, left_of_limits()];
    free.into_iter().flatten().min().unwrap_or(u64::MAX)
}

fn memory() -> Option<System> {
    let mut system = System::new().ok()?;
    system.refresh_memory();
    Some(system)
}

/// Address space left of the process's resource limit (`ulimit -v`) [bytes]; `None` if it has
/// none.
#[cfg(target_os = "linux")]
fn left_of_limits() -> Option<u64> {
    use rustix::process::{Resource, getrlimit};
    let limit = getrlimit(Resource::As).current?;
    let statm = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: u64 = statm.split_whitespace().next()?.parse().ok()?;
    Some(limit.saturating_sub(pages * rustix::param::page_size() as u64))
}

#[cfg(not(target_os = "linux"))]
fn left_of_limits() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_available_is_part_of_the_whole() {
        let available = available_memory();
        assert!(available > 1 << 20, "{available}");
        assert!(available <= total_memory());
    }
}
