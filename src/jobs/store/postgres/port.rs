//! The port, served by the operations of this folder. Each is an inherent function in the file
//! of its subject; here their errors are sorted into those of the port.

use super::PostgresStore;
use super::error::Answer;
use super::news::Subject;
use crate::jobs::failure::Failure;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::store::{
    AttemptStart, Claim, Claimant, Dismissal, EndedMember, Enlarged, Event, FailedAttempt,
    FormerRequest, JobCounts, JobPage, JobStore, KeptAnswer, Key, KeyRetention, Lease,
    ListedMember, MemberOutcome, NewMember, NewResults, NewStudy, NewTerrain, Page, Removal,
    Renewal, Returned, Room, StoreError, StoredChunk, StoredState, StoredTerrain, StudyDismissal,
    StudyEnd, StudyPage, StudyStore, StudySubmitted, Submission, Submitted, TerrainPage,
    TerrainRemoval, TerrainStore,
};
use crate::results::FlowSnapshot;
use crate::results::columns::{Selection, TrajectoryColumns};
use crate::results::terrain::{MapQuantity, StoredMap};
use crate::runs::Progress;
use crate::studies::study::{MemberCounts, StoredStudy, StudyId};
use crate::terrains::TerrainHash;
use async_trait::async_trait;
use std::time::Duration;
use tokio::time::timeout;

/// Time after which an operation is given up: a server that is out of reach may not answer for
/// hours.
const PATIENCE: Duration = Duration::from_secs(60);

async fn within<T>(operation: impl Future<Output = Answer<T>> + Send) -> Result<T, StoreError> {
    match timeout(PATIENCE, operation).await {
        Ok(answer) => Ok(answer?),
        Err(late) => Err(StoreError::Unavailable(late.into())),
    }
}

#[async_trait]
impl JobStore for PostgresStore {
    async fn submit(&self, submission: &Submission<'_>) -> Result<Submitted, StoreError> {
        within(Self::submit(self, submission)).await
    }

    async fn former_request(
        &self,
        submitter: Option<&str>,
        key: &Key,
    ) -> Result<Option<FormerRequest>, StoreError> {
        within(Self::former_request(self, submitter, key)).await
    }

    async fn keep_answer(
        &self,
        submitter: Option<&str>,
        key: &Key,
        answer: &KeptAnswer,
    ) -> Result<Option<KeptAnswer>, StoreError> {
        within(Self::keep_answer(self, submitter, key, answer)).await
    }

    async fn finished_like(
        &self,
        scenario_hash: &str,
        solver: (&str, &str),
    ) -> Result<Option<JobId>, StoreError> {
        within(Self::finished_like(self, scenario_hash, solver)).await
    }

    async fn claim(&self, claimant: &Claimant) -> Result<Vec<Claim>, StoreError> {
        within(Self::claim(self, claimant)).await
    }

    async fn is_idle(&self, memory_bytes: u64) -> Result<bool, StoreError> {
        within(Self::is_idle(self, memory_bytes)).await
    }

    async fn wait_for_jobs(&self) {
        self.news.wait(Subject::Queue).await;
    }

    async fn wait_for_events(&self) {
        self.news.wait(Subject::Events).await;
    }

    async fn leads(&self) -> Result<bool, StoreError> {
        within(self.leader.leads()).await
    }

    async fn dismiss(&self, id: JobId) -> Result<Dismissal, StoreError> {
        within(Self::dismiss(self, id)).await
    }

    async fn remove(&self, id: JobId) -> Result<Removal, StoreError> {
        within(Self::remove(self, id)).await
    }

    async fn remove_ended(&self, age_ms: i64) -> Result<u64, StoreError> {
        within(Self::remove_ended(self, age_ms)).await
    }

    async fn forget_keys(&self, kept: KeyRetention) -> Result<u64, StoreError> {
        within(Self::forget_keys(self, kept)).await
    }

    async fn renew(
        &self,
        lease: Lease,
        lease_duration: Duration,
        progress: &Progress,
    ) -> Result<Renewal, StoreError> {
        // One that is held up must not cost the leases that are renewed after it.
        let renewal = within(Self::renew(self, lease, lease_duration, progress));
        match timeout(lease_duration / 3, renewal).await {
            Ok(renewal) => renewal,
            Err(late) => Err(StoreError::Unavailable(late.into())),
        }
    }

    async fn reclaim_own(&self, owner: &str) -> Result<usize, StoreError> {
        within(Self::reclaim_own(self, owner)).await
    }

    async fn reclaim_expired(&self, owner: &str) -> Result<usize, StoreError> {
        within(Self::reclaim_expired(self, owner)).await
    }

    async fn begin(
        &self,
        lease: Lease,
        beginning: &AttemptStart,
        threads: usize,
    ) -> Result<bool, StoreError> {
        within(Self::begin_attempt(self, lease, beginning, threads)).await
    }

    async fn keep(&self, lease: Lease, results: &NewResults) -> Result<bool, StoreError> {
        within(Self::keep(self, lease, results)).await
    }

    async fn succeed(
        &self,
        lease: Lease,
        outcome: &str,
        fingerprint: &str,
    ) -> Result<bool, StoreError> {
        within(Self::succeed(self, lease, outcome, fingerprint)).await
    }

    async fn fail(&self, lease: Lease, failure: &Failure) -> Result<bool, StoreError> {
        within(Self::fail(self, lease, failure)).await
    }

    async fn release(&self, lease: Lease) -> Result<bool, StoreError> {
        within(Self::release(self, lease)).await
    }

    async fn fail_attempt(
        &self,
        lease: Lease,
        failed_attempt: &FailedAttempt,
    ) -> Result<Returned, StoreError> {
        within(Self::fail_attempt(self, lease, failed_attempt)).await
    }

    async fn job(&self, id: JobId) -> Result<Option<Job>, StoreError> {
        within(Self::job(self, id)).await
    }

    async fn status(&self, id: JobId) -> Result<Option<JobStatus>, StoreError> {
        within(Self::status(self, id)).await
    }

    async fn page(&self, page: &Page) -> Result<JobPage, StoreError> {
        within(Self::page(self, page)).await
    }

    async fn events(&self, after: i64, job: Option<JobId>) -> Result<Vec<Event>, StoreError> {
        within(Self::events(self, after, job)).await
    }

    async fn last_event(&self) -> Result<i64, StoreError> {
        within(Self::last_event(self)).await
    }

    async fn webhook_position(&self, name: &str) -> Result<Option<i64>, StoreError> {
        within(Self::webhook_position(self, name)).await
    }

    async fn note_webhook_position(&self, name: &str, position: i64) -> Result<(), StoreError> {
        within(Self::note_webhook_position(self, name, position)).await
    }

    async fn running_jobs(&self) -> Result<u64, StoreError> {
        within(Self::running_jobs(self)).await
    }

    async fn count_jobs(&self) -> Result<JobCounts, StoreError> {
        within(Self::count_jobs(self)).await
    }

    async fn results_bytes(&self, job: JobId) -> Result<u64, StoreError> {
        within(Self::results_bytes(self, job)).await
    }

    async fn state(&self, job: JobId) -> Result<Option<StoredState>, StoreError> {
        within(Self::state(self, job)).await
    }

    async fn chunk(
        &self,
        job: JobId,
        body: usize,
        from_sample: i64,
        selection: &Selection,
    ) -> Result<Option<StoredChunk>, StoreError> {
        within(Self::chunk(self, job, body, from_sample, selection)).await
    }

    async fn last_chunk(
        &self,
        job: JobId,
        body: usize,
    ) -> Result<Option<(usize, TrajectoryColumns)>, StoreError> {
        within(Self::last_chunk(self, job, body)).await
    }

    async fn samples(&self, job: JobId, body: usize) -> Result<usize, StoreError> {
        within(Self::samples(self, job, body)).await
    }

    async fn snapshot_times(&self, job: JobId) -> Result<Vec<f64>, StoreError> {
        within(Self::snapshot_times(self, job)).await
    }

    async fn snapshot(
        &self,
        job: JobId,
        time_s: Option<f64>,
    ) -> Result<Option<FlowSnapshot>, StoreError> {
        within(Self::snapshot(self, job, time_s)).await
    }

    async fn flow_maps(&self, job: JobId) -> Result<Vec<MapQuantity>, StoreError> {
        within(Self::flow_maps(self, job)).await
    }

    async fn flow_map(
        &self,
        job: JobId,
        quantity: MapQuantity,
    ) -> Result<Option<StoredMap>, StoreError> {
        within(Self::flow_map(self, job, quantity)).await
    }

    async fn ping(&self) -> Result<(), StoreError> {
        within(Self::ping(self)).await
    }

    async fn probe(&self) -> Result<(), StoreError> {
        within(Self::probe(self)).await
    }

    async fn maintain(&self) -> Result<(), StoreError> {
        within(Self::maintain(self)).await
    }

    async fn close(&self) {
        Self::close(self).await;
    }
}

#[async_trait]
impl StudyStore for PostgresStore {
    async fn add_study(&self, study: &NewStudy<'_>) -> Result<StudySubmitted, StoreError> {
        within(Self::add_study(self, study)).await
    }

    async fn study(&self, id: StudyId) -> Result<Option<StoredStudy>, StoreError> {
        within(Self::study(self, id)).await
    }

    async fn studies(&self, page: &StudyPage) -> Result<Vec<StoredStudy>, StoreError> {
        within(Self::studies(self, page)).await
    }

    async fn running_studies(&self) -> Result<Vec<(StudyId, MemberCounts)>, StoreError> {
        within(Self::running_studies(self)).await
    }

    async fn enlarge_study(
        &self,
        id: StudyId,
        documents: (&str, &str),
        room: Room,
    ) -> Result<Enlarged, StoreError> {
        within(Self::enlarge_study(self, id, documents, room)).await
    }

    async fn add_members(
        &self,
        study: StudyId,
        members: &[NewMember],
    ) -> Result<usize, StoreError> {
        within(Self::add_members(self, study, members)).await
    }

    async fn members_made(&self, study: StudyId) -> Result<Vec<u64>, StoreError> {
        within(Self::members_made(self, study)).await
    }

    async fn members(
        &self,
        study: StudyId,
        from: (u32, u64),
        limit: u32,
    ) -> Result<Vec<ListedMember>, StoreError> {
        within(Self::members(self, study, from, limit)).await
    }

    async fn ended_members(&self, study: StudyId) -> Result<Vec<EndedMember>, StoreError> {
        within(Self::ended_members(self, study)).await
    }

    async fn note_outcomes(
        &self,
        study: StudyId,
        outcomes: &[MemberOutcome],
    ) -> Result<(), StoreError> {
        within(Self::note_outcomes(self, study, outcomes)).await
    }

    async fn outcomes(&self, study: StudyId) -> Result<Vec<MemberOutcome>, StoreError> {
        within(Self::outcomes(self, study)).await
    }

    async fn end_study(
        &self,
        id: StudyId,
        end: StudyEnd<'_>,
    ) -> Result<StudyDismissal, StoreError> {
        within(Self::end_study(self, id, end)).await
    }

    async fn remove_study(&self, id: StudyId) -> Result<Removal, StoreError> {
        within(Self::remove_study(self, id)).await
    }

    async fn study_ended_before(&self, age_ms: i64) -> Result<Option<StudyId>, StoreError> {
        within(Self::study_ended_before(self, age_ms)).await
    }

    async fn remove_orphans(&self) -> Result<u64, StoreError> {
        within(Self::remove_orphans(self)).await
    }
}

#[async_trait]
impl TerrainStore for PostgresStore {
    async fn put_terrain(&self, terrain: &NewTerrain<'_>) -> Result<bool, StoreError> {
        within(Self::put_terrain(self, terrain)).await
    }

    async fn terrain(&self, hash: TerrainHash) -> Result<Option<StoredTerrain>, StoreError> {
        within(Self::terrain(self, hash)).await
    }

    async fn terrain_piece(
        &self,
        hash: TerrainHash,
        piece: u32,
    ) -> Result<Option<Vec<u8>>, StoreError> {
        within(Self::terrain_piece(self, hash, piece)).await
    }

    async fn terrains(&self, page: &TerrainPage) -> Result<Vec<StoredTerrain>, StoreError> {
        within(Self::terrains(self, page)).await
    }

    async fn remove_terrain(&self, hash: TerrainHash) -> Result<TerrainRemoval, StoreError> {
        within(Self::remove_terrain(self, hash)).await
    }
}
