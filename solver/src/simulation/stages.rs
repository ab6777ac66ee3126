//! Timing of the stages of the step by a caller: the solver itself has no clock.

use std::fmt;

/// Stages of the step, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum StepStage {
    /// Grid laid, mass, momentum and first forces scattered to it.
    P2g,
    /// Nodes at walls and points near bodies found.
    Search,
    /// Forces between bodies and points.
    Contact,
    /// Tiles summed, momentum advanced, nodes displaced.
    GridUpdate,
    /// Walls.
    Boundary,
    /// Gradient gathered, stress updated, forces scattered.
    StressUpdate,
    /// Bodies moved.
    RigidBodies,
    /// Motion gathered at the points.
    G2p,
    /// Points re-sorted by block.
    Rebin,
    /// Points and bodies checked.
    Checks,
    /// Sums compared.
    Audit,
}

impl StepStage {
    /// All stages, in order.
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

/// Callback for each stage when it is done.
pub type StageTimer = Box<dyn FnMut(StepStage) + Send + Sync>;

/// Notification of the caller at the end of a stage.
#[derive(Default)]
pub(super) struct StageEnds(Option<StageTimer>);

impl StageEnds {
    /// Sets the callback.
    pub(super) fn tell(&mut self, watch: StageTimer) {
        self.0 = Some(watch);
    }

    /// Reports that a stage is done.
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
