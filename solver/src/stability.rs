//! Bounds of one sub-step and one step (docs/method.md, equations 25 and 27).

use crate::method::METHOD;

/// Bounds of a run's steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// P-wave speed √(M/ρ) [m/s].
    pub p_wave_speed: f64,
    /// √(K/ρ) [m/s].
    pub sound_speed: f64,
    /// Smallest node distance [m].
    pub cell_size: f64,
    /// Courant number of the sub-step.
    pub courant: f64,
    /// Largest travel of the fastest point per step [cells].
    pub flow_courant: f64,
    /// Largest sub-step over a body's own time scale against points.
    pub body_contact_share: f64,
    /// Speed below which a flow steps as if it had this speed [m/s]: one at rest would otherwise
    /// never be transferred.
    pub slow: f64,
}

/// The next step: number and length of its sub-steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Length of a sub-step [s].
    pub substep: f64,
    /// Sub-steps in the step.
    pub count: u32,
    /// True if the run ends with it.
    pub reaches_end: bool,
}

impl Limits {
    /// Longest stable sub-step at this largest speed [s]: a P-wave may cross a
    /// share of a cell, and a lone point, which rings against its own nodes at
    /// 2√(3K/ρ)/h, must not blow up (equation 25).
    pub fn substep(&self, speed: f64) -> f64 {
        let crossing = self.cell_size / (self.p_wave_speed + speed);
        let lone_point = self.cell_size / (3f64.sqrt() * self.sound_speed);
        self.courant * crossing.min(lone_point)
    }

    /// Longest sub-step in which the fastest body does not jump over points [s]
    /// (equation 26).
    pub fn body_substep(&self, speed: f64) -> f64 {
        METHOD.time_step.body_travel * self.cell_size / speed
    }

    /// The speed of the fastest point [m/s], or the expected one if that is larger.
    pub fn governing_speed(&self, fastest: f64) -> f64 {
        fastest.max(self.slow)
    }

    /// Travel of a point at that speed in `duration` [s], in cells.
    pub fn travel(&self, duration: f64, fastest: f64) -> f64 {
        self.governing_speed(fastest) * duration / self.cell_size
    }

    /// Shortest sub-step accepted [s]; below it the run has blown up.
    pub fn shortest_substep(&self) -> f64 {
        self.substep(METHOD.guards.largest_mach_number * self.p_wave_speed)
    }

    /// The next step: equal sub-steps of `longest` [s] or somewhat shorter, the fastest at `speed`
    /// [m/s], and none beyond `remaining` [s], when the run ends.
    pub fn pace(&self, longest: f64, speed: f64, remaining: f64) -> Pace {
        let division = self.division(longest, speed);
        divide(remaining, division.substep, division.count)
    }

    /// Division of the time between two transfers, the fastest at `speed` [m/s], into sub-steps of
    /// `longest` [s]: as many as fit in it, or one more that fill it, whichever is cheaper (equation
    /// 27).
    pub fn division(&self, longest: f64, speed: f64) -> Division {
        let travel = self.governing_speed(speed) * longest;
        let room = (self.flow_courant * self.cell_size / travel).max(1.0);
        let (fits, fills) = (room.floor(), room.ceil());
        // Per time; a transfer costs as much as some sub-steps.
        let of_those_that_fit = (TRANSFER + fits) / fits;
        let of_those_that_fill = (TRANSFER + fills) / room;
        if of_those_that_fill < of_those_that_fit {
            Division {
                substep: longest * (room / fills),
                count: fills,
            }
        } else {
            Division {
                substep: longest,
                count: fits,
            }
        }
    }
}

/// Sub-steps that take as long as the transfers of a step: 4.3 in the collapse of 200,000 points,
/// 5 in the source paper's scene (`scree bench --only stages`).
const TRANSFER: f64 = 4.0;

/// Sub-steps between two transfers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// Length of each [s].
    pub substep: f64,
    /// Their number, whole, but kept as a float.
    pub count: f64,
}

impl Division {
    /// Length of all together [s].
    pub fn step(&self) -> f64 {
        self.substep * self.count
    }
}

/// The next step of a scene without a flow, no longer than `longest` [s].
pub fn pace_without_flow(longest: f64, remaining: f64) -> Pace {
    divide(remaining, longest, 1.0)
}

/// A step of `allowed` sub-steps of the longest size. The remaining time of the last two steps
/// is divided evenly, so that no single sub-step is cut short.
fn divide(remaining: f64, longest: f64, allowed: f64) -> Pace {
    // A whole number up to rounding counts as that number.
    let needed = (remaining / longest - 1e-9).ceil().max(1.0);
    Pace {
        substep: if needed > 2.0 * allowed {
            longest
        } else {
            remaining / needed
        },
        count: allowed.min(needed) as u32,
        reaches_end: needed <= allowed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> Limits {
        Limits {
            p_wave_speed: 25.0,
            sound_speed: 20.0,
            cell_size: 0.01,
            courant: 0.4,
            flow_courant: 0.2,
            body_contact_share: 0.5,
            slow: 0.5,
        }
    }

    #[test]
    fn a_step_moves_the_fastest_point_by_the_flow_courant_number() {
        let limits = limits();
        let longest = limits.substep(2.0);
        let pace = limits.pace(longest, 2.0, 1.0);
        let travel = 2.0 * pace.substep * f64::from(pace.count);
        assert!(travel <= 0.2 * 0.01 && travel > 0.15 * 0.01, "{travel}");
        assert!(pace.substep <= longest && !pace.reaches_end);
    }

    // Room for 1.4 sub-steps: two of 0.7 and their transfer cost 6 per 1.4, one and its transfer
    // 5 per 1. For 3.1, four would cost 8 per 3.1, three cost 7 per 3.
    #[test]
    fn sub_steps_fill_the_time_between_two_transfers_where_that_is_cheaper() {
        let limits = limits();
        let of = |room: f64| {
            let speed = 0.2 * 0.01 / (room * 1e-4);
            let division = limits.division(1e-4, speed);
            (division.count, division.substep / 1e-4)
        };
        let near = |one: (f64, f64), other: (f64, f64)| {
            assert!((one.0 - other.0).abs() < 1e-9, "{one:?}");
            assert!((one.1 - other.1).abs() < 1e-9, "{one:?}");
        };
        near(of(1.4), (2.0, 0.7));
        near(of(3.1), (3.0, 1.0));
        near(of(3.9), (4.0, 0.975));
        near(of(0.3), (1.0, 1.0));
    }

    #[test]
    fn the_last_step_ends_where_the_run_does() {
        let limits = limits();
        let longest = limits.substep(0.0);
        let pace = limits.pace(longest, 0.0, 3.5 * longest);
        assert_eq!((pace.count, pace.reaches_end), (4, true));
        assert!((pace.substep - 0.875 * longest).abs() < 1e-18);
    }

    // With 8 sub-steps per step, 8.01 remain: nine, each a little shorter.
    #[test]
    fn no_sub_step_is_cut_short_alone() {
        let longest = 1e-3;
        let pace = divide(8.01 * longest, longest, 8.0);
        assert_eq!((pace.count, pace.reaches_end), (8, false));
        let last = divide(8.01 * longest - 8.0 * pace.substep, longest, 8.0);
        assert_eq!((last.count, last.reaches_end), (1, true));
        assert!((last.substep / pace.substep - 1.0).abs() < 1e-12);
    }

    #[test]
    fn faster_than_sound_is_a_collapse() {
        let limits = limits();
        assert!(limits.substep(21.0 * 25.0) < limits.shortest_substep());
    }
}
