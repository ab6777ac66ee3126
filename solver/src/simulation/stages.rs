//! Lets a caller time the stages of the step: the solver itself has no clock.

use std::fmt;

/// A part of the step, in the order in which they come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum StepStage {
    /// Grid laid, mass, momentum and first forces scattered to it.
    P2g,
    /// Nodes at walls and points near bodies found.
    Search,
    /// Forces between bodies and points.
    Contact,
    /// Tiles added up, momentum advanced, nodes displaced.
    GridUpdate,
    /// Walls.
    Boundary,
    /// Gradient gathered, stress renewed, forces scattered.
    StressUpdate,
    /// Bodies moved.
    RigidBodies,
    /// Motion handed back to the points.
    G2p,
    /// Points brought into the order of their blocks.
    Rebin,
    /// Points and bodies looked at for what should not be.
    Checks,
    /// Sums compared.
    Audit,
}

impl StepStage {
    /// All of them, in order.
    pub const ALL: [Self; 11] = [
        Self::P2g,
        Self::Search,
        Self::Contact,
        Self::GridUpdate,
        Self::Boundary,
        Self::StressUpdate,
        Self::RigidBodies,
        Self::G2p,
        Self::Rebin,
        Self::Checks,
        Self::Audit,
    ];
}

/// Called with each stage when it is done.
pub type StageTimer = Box<dyn FnMut(StepStage) + Send + Sync>;

/// Tells who wants to know when a stage is done.
#[derive(Default)]
pub(super) struct StageEnds(Option<StageTimer>);

impl StageEnds {
    /// Tells this one from now on.
    pub(super) fn tell(&mut self, watch: StageTimer) {
        self.0 = Some(watch);
    }

    /// A stage is done.
    pub(super) fn done(&mut self, stage: StepStage) {
        if let Some(watch) = &mut self.0 {
            watch(stage);
        }
    }
}

impl fmt::Debug for StageEnds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("StageEnds")
    }
}
