//! Lets a caller time the verbs of the step: the solver itself has no clock.

use std::fmt;

/// A part of the step, in the order in which they come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verb {
    /// Grid laid, mass, momentum and first forces scattered to it.
    Transfer,
    /// Nodes at walls and points near bodies found.
    Search,
    /// Forces between bodies and points.
    Contact,
    /// Tiles added up, momentum advanced, nodes displaced.
    Nodes,
    /// Walls.
    Walls,
    /// Gradient gathered, stress renewed, forces scattered.
    Points,
    /// Bodies moved.
    Bodies,
    /// Motion handed back to the points.
    Motion,
    /// Points brought into the order of their blocks.
    Settle,
    /// Points and bodies looked at for what should not be.
    Checks,
    /// Sums compared.
    Audit,
}

impl Verb {
    /// All of them, in order.
    pub const ALL: [Self; 11] = [
        Self::Transfer,
        Self::Search,
        Self::Contact,
        Self::Nodes,
        Self::Walls,
        Self::Points,
        Self::Bodies,
        Self::Motion,
        Self::Settle,
        Self::Checks,
        Self::Audit,
    ];
}

/// Called with each verb when it is done.
pub type LapWatch = Box<dyn FnMut(Verb) + Send + Sync>;

/// Tells who wants to know when a verb is done.
#[derive(Default)]
pub(super) struct Laps(Option<LapWatch>);

impl Laps {
    /// Tells this one from now on.
    pub(super) fn tell(&mut self, watch: LapWatch) {
        self.0 = Some(watch);
    }

    /// A verb is done.
    pub(super) fn done(&mut self, verb: Verb) {
        if let Some(watch) = &mut self.0 {
            watch(verb);
        }
    }
}

impl fmt::Debug for Laps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Laps")
    }
}
