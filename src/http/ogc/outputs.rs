//! Outputs of the process: the outcome by value, everything else by reference.

use super::links::{Base, JSON, Link};
use crate::jobs::job::Job;

/// Output of the process.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Output {
    /// The answer in short.
    Outcome,
    /// Trajectory of the first body.
    Trajectory,
    /// Snapshots of the flow.
    Flow,
    /// Picture of the motion.
    Motion,
    /// Picture from above.
    Aerial,
}

impl Output {
    /// All outputs.
    pub(super) const ALL: [Self; 5] = [
        Self::Outcome,
        Self::Trajectory,
        Self::Flow,
        Self::Motion,
        Self::Aerial,
    ];

    /// Name of the output.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Outcome => "outcome",
            Self::Trajectory => "trajectory",
            Self::Flow => "flow",
            Self::Motion => "motion",
            Self::Aerial => "aerial",
        }
    }

    /// Name for people.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Outcome => "Outcome",
            Self::Trajectory => "Trajectory of the first body",
            Self::Flow => "Snapshots of the flow",
            Self::Motion => "Picture of the bodies' motion",
            Self::Aerial => "Picture of flow and bodies from above",
        }
    }

    /// Contents of the output.
    pub(super) fn about(self) -> &'static str {
        match self {
            Self::Outcome => "The answer in short, by value.",
            Self::Trajectory => {
                "A table with a line per sample, by reference; absent without a body. `?body=1` \
                 leads to the next body."
            }
            Self::Flow => "An archive for ParaView, by reference.",
            Self::Motion | Self::Aerial => "By reference.",
        }
    }

    /// Media type of the output.
    pub(super) fn media_type(self) -> &'static str {
        match self {
            Self::Outcome => JSON,
            Self::Trajectory => "text/csv",
            Self::Flow => "application/zip",
            Self::Motion | Self::Aerial => "image/svg+xml",
        }
    }

    /// Reference to the output of a job; `None` if it is given by value, or the job lacks it.
    pub(super) fn reference(self, job: &Job, base: &Base) -> Option<Link> {
        let file = match self {
            Self::Outcome => return None,
            Self::Trajectory if job.bodies == 0 => return None,
            Self::Trajectory => "trajectory.csv",
            Self::Flow => "flow.zip",
            Self::Motion => "motion.svg",
            Self::Aerial => "aerial.svg",
        };
        Some(Link {
            href: base.at(format_args!("/v1/jobs/{}/{file}", job.summary.id)),
            rel: "item",
            media_type: self.media_type(),
            title: self.title(),
        })
    }
}
