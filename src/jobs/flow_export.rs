//! Export of a job's flow and bodies for ParaView: an archive, made instant by instant.

use super::JobService;
use super::admission_pool::AdmissionError;
use super::job::{Job, JobId};
use super::store::StoreError;
use crate::results::columns::Selection;
use crate::results::interpolation::{BodyState, Interpolator};
use crate::results::vtk::{VtkFile, VtkScene};
use crate::results::zip::{Method, ZipWriter};
use crate::terrains::ReadError;
use scree_solver::scenario::{Scenario, ScenarioError};
use std::sync::Arc;
use thiserror::Error;

/// Reason why there is no export, or no more of it.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored document is not what this version reads.
    #[error("a stored document: {0}")]
    Document(#[from] serde_json::Error),
    /// The request is not admitted.
    #[error(transparent)]
    Admission(#[from] AdmissionError),
    /// A stored scenario can't be read any more.
    #[error("a stored scenario: {0}")]
    Scenario(ScenarioError),
}

impl From<ReadError> for ExportError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Scenario(error) => Self::Scenario(error),
            ReadError::Store(error) => Self::Store(error),
        }
    }
}

/// Archive of a job's flow and bodies: it holds one snapshot at a time, and the motion of the
/// bodies at all of them.
#[derive(Debug)]
pub struct FlowExport {
    jobs: JobService,
    job: JobId,
    caller: String,
    scene: Arc<VtkScene>,
    times_s: Vec<f64>,
    /// States of the bodies at each instant.
    motion: Vec<Vec<BodyState>>,
    next: usize,
    archive: ZipWriter,
}

impl JobService {
    /// Export of a job's flow and bodies at the instants of its snapshots so far, for this caller.
    ///
    /// # Errors
    /// A document can't be read, the caller is not admitted, or the store's own.
    pub async fn flow_export(&self, job: Job, caller: &str) -> Result<FlowExport, ExportError> {
        let id = job.summary.id;
        let scenario = job.scenario;
        let jobs = self.clone();
        let read = move |_: &_| -> Result<VtkScene, ExportError> {
            let scenario: Scenario = serde_json::from_str(scenario.get())?;
            Ok(VtkScene::new(&jobs.complete(scenario)?))
        };
        let scene = self.enter(caller)?.work(read).await??;
        let times_s = self.snapshot_times(id).await?;
        Ok(FlowExport {
            jobs: self.clone(),
            job: id,
            caller: caller.to_owned(),
            scene: Arc::new(scene),
            motion: self.motion(id, job.bodies, &times_s).await?,
            times_s,
            next: 0,
            archive: ZipWriter::default(),
        })
    }

    /// States of all bodies at some instants; none where a body has no sample yet.
    async fn motion(
        &self,
        job: JobId,
        bodies: usize,
        times_s: &[f64],
    ) -> Result<Vec<Vec<BodyState>>, StoreError> {
        let mut motion = vec![Vec::with_capacity(bodies); times_s.len()];
        for body in 0..bodies {
            let range = self.range(job, body, Selection::default()).await?;
            let mut interpolator = Interpolator::new(times_s);
            let mut from_sample = 0;
            while let Some(chunk) = self.next_chunk(&range, from_sample).await? {
                for index in 0..chunk.columns.len() {
                    let (time_s, sample) = chunk.columns.sample(index);
                    interpolator.push(time_s, &sample);
                }
                from_sample = chunk.next_sample;
            }
            self.check_whole(&range).await?;
            let states = interpolator.finish().unwrap_or_default();
            for (instant, state) in motion.iter_mut().zip(states) {
                instant.push(state);
            }
        }
        Ok(motion)
    }
}

impl FlowExport {
    /// The next bytes of the archive; `None` after the last.
    ///
    /// # Errors
    /// The store's own.
    pub async fn next(&mut self) -> Result<Option<Vec<u8>>, ExportError> {
        let index = self.next;
        self.next += 1;
        if index > self.times_s.len() {
            return Ok(None);
        }
        let snapshot = match self.times_s.get(index) {
            Some(&time_s) => Some(self.jobs.snapshot_at(self.job, time_s).await?),
            None => None,
        };
        let states = self.motion.get_mut(index).map(std::mem::take);
        let times_s = (index == 0).then(|| self.times_s.clone());
        let mut archive = std::mem::take(&mut self.archive);
        let scene = Arc::clone(&self.scene);
        let pack = move || {
            let mut out = Vec::new();
            let mut add = |file: VtkFile| {
                archive.file(&file.name, Method::Deflated, &file.bytes, &mut out);
            };
            if let Some(times_s) = times_s {
                scene.head(&times_s).into_iter().for_each(&mut add);
            }
            match snapshot {
                Some(snapshot) => {
                    let files = scene.instant(index, &snapshot, &states.unwrap_or_default());
                    files.into_iter().for_each(&mut add);
                }
                None => archive.finish(&mut out),
            }
            (archive, out)
        };
        let (archive, out) = self.jobs.pool.slice(&self.caller, pack).await?;
        self.archive = archive;
        Ok(Some(out))
    }
}
