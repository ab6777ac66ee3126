//! Body sub-steps within one of the flow: the length of each is a multiple of the shortest,
//! which resolves all that may happen (docs/method.md, equations 20, 20a and 20b).

use super::flight::clear_for;
use super::in_touch::longest_in_touch;
use super::member::Member;
use super::mover::Mover;
use super::pair::IslandPair;
use super::surroundings::Surroundings;

/// Number of short sub-steps left below which gaps and contacts are not evaluated, since that
/// costs as much as one or two sub-steps.
const WORTH_A_LOOK: u32 = 4;

/// Largest number of doublings of the interval between evaluations that find no room.
const MOST_DOUBLINGS: u32 = 4;

/// Sub-steps of an island within one of the flow, and their lengths.
#[derive(Debug)]
pub(super) struct Strides {
    /// The shortest [s].
    pub(super) shortest: f64,
    /// Total number of shortest sub-steps.
    count: u32,
    /// Number of those done.
    pub(super) done: u32,
    /// Length of the sub-step before, in shortest ones. At the start one: the damping found there
    /// was for a kick of unknown length, and must not act in a longer one.
    before: u32,
    /// Short sub-steps to take before the next evaluation of gaps and contacts.
    wait: u32,
    /// Evaluations in a row that found no room.
    in_vain: u32,
}

impl Strides {
    /// This number of shortest sub-steps, of this length [s].
    pub(super) fn new(shortest: f64, count: u32) -> Self {
        Self {
            shortest,
            count,
            done: 0,
            before: 1,
            wait: 0,
            in_vain: 0,
        }
    }

    /// True until all are done.
    pub(super) fn are_left(&self) -> bool {
        self.done < self.count
    }

    /// Length of the last sub-step [s], if there was one.
    pub(super) fn before(&self) -> Option<f64> {
        (self.done > 0).then(|| f64::from(self.before) * self.shortest)
    }

    /// Begins the next sub-step; returns its length in shortest ones.
    pub(super) fn next(
        &mut self,
        members: &[Member],
        movers: &[Mover],
        contact_pairs: &[IslandPair],
        around: &Surroundings,
    ) -> u32 {
        let left = self.count - self.done;
        let stride = if left < WORTH_A_LOOK || self.is_waiting() {
            1
        } else if touches(members, contact_pairs) {
            self.in_touch(members, movers, contact_pairs, around)
        } else {
            let times = (2.0 * self.shortest, self.shortest * f64::from(left));
            let clear = clear_for(members, movers, contact_pairs, around, times);
            self.found((clear / self.shortest) as u32)
        };
        let stride = stride.clamp(1, left);
        self.before = stride;
        self.done += stride;
        stride
    }

    /// A power of two, so that an impact has steps of one length; at most twice as long as the one
    /// before, so that damping chosen for that one still dissipates. The last is one of the
    /// shortest, as is the first that follows in the flow's next sub-step.
    fn in_touch(
        &mut self,
        members: &[Member],
        movers: &[Mover],
        contact_pairs: &[IslandPair],
        around: &Surroundings,
    ) -> u32 {
        let left = self.count - self.done;
        if self.done == 0 {
            return 1;
        }
        let at_most = (2 * self.before).min(left - 1);
        if at_most == 1 {
            return 1;
        }
        let most = self.shortest * f64::from(at_most);
        let longest = longest_in_touch(members, movers, contact_pairs, around, most);
        let stride = ((longest / self.shortest) as u32).clamp(1, at_most);
        self.found(1 << stride.ilog2())
    }

    fn is_waiting(&mut self) -> bool {
        let is_waiting = self.wait > 0;
        self.wait = self.wait.saturating_sub(1);
        is_waiting
    }

    /// Records an evaluation that allows so long a sub-step; a non-finite one, 0 as a whole number,
    /// allows the shortest.
    fn found(&mut self, stride: u32) -> u32 {
        self.in_vain = if stride > 1 { 0 } else { self.in_vain + 1 };
        self.wait = (1 << self.in_vain.min(MOST_DOUBLINGS)) - 1;
        stride
    }
}

/// True if any body of an island is in contact.
fn touches(members: &[Member], contact_pairs: &[IslandPair]) -> bool {
    contact_pairs
        .iter()
        .any(|island_pair| island_pair.contact_pair.touches())
        || members
            .iter()
            .any(|member| member.body.state.wall_overlap > 0.0)
}
