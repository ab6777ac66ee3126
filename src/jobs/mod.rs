//! Jobs: their data ([`job`]), validation ([`submit`]), storage ([`store`]), execution
//! ([`pool`]), failures ([`failure`]) and forecasts of their wall time ([`forecast`]). HTTP uses
//! them through [`JobService`].

mod admission;
mod admission_pool;
pub mod clock;
pub mod documents;
mod drawing;
pub mod failure;
mod fair_queue;
mod flow_export;
mod flow_frames;
pub mod forecast;
pub(crate) mod identifier;
pub mod job;
mod job_limits;
mod job_service;
mod lease_heartbeat;
mod memory_budget;
mod news;
mod open_chunk;
mod packs;
pub mod pool;
mod reading;
mod recent;
pub mod recording;
mod running_jobs;
mod running_progress;
pub mod store;
pub mod submit;
mod terrain_results;
mod worker;

pub use admission::{Submission, SubmissionRequest, SubmitError};
pub use admission_pool::{AdmissionError, AdmissionPool, Admitted};
pub use drawing::{DrawError, Drawing, Picture};
pub use flow_export::{ExportError, FlowExport};
pub use flow_frames::FlowFrames;
pub use job_limits::{Excess, JobLimits};
pub use job_service::{Dismissed, JobService, PlanError};
pub use news::{Followers, News};
pub use reading::TrajectoryRange;
pub use running_progress::RunningProgress;
pub use terrain_results::{AskedCoordinates, TerrainResultsError, Tracks};
