//! Study service: all operations on studies that clients may ask for.

use super::study::{StoredStudy, StudyId, StudyStatus};
use crate::jobs::job::JobId;
use crate::jobs::store::{
    Enlarged, Key, ListedMember, NewStudy, Removal, Room, StoreError, StudyDismissal, StudyEnd,
    StudyPage, StudyStore, StudySubmitted,
};
use crate::jobs::{JobService, News};
use crate::terrains::TerrainHash;
use scree_studies::{Member, MemberOutcome};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Notify;
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;

/// Members of a study that wait or run at a time, for each worker: enough that none waits for the
/// next to be made.
const MEMBERS_PER_WORKER: u64 = 8;

/// Largest number of members of a study that wait or run at a time, however many workers there are.
const MEMBERS_AT_ONCE: u64 = 10_000;

/// Service that clients use to submit, enlarge, read, dismiss and remove studies.
#[derive(Debug, Clone)]
pub struct StudyService {
    pub(super) store: Arc<dyn StudyStore>,
    pub(super) jobs: JobService,
    workers: usize,
    /// Told when a study comes or goes on.
    pub(super) changed: Arc<Notify>,
    room: u32,
    /// Time for which ended studies are kept; `None`: until they are removed.
    pub(super) retention: Option<Duration>,
}

impl StudyService {
    /// Service for the studies in this store, whose members are jobs of this service with so many
    /// workers; at most `room` studies run at a time, and ended ones are kept for `retention`.
    pub fn new(
        store: Arc<dyn StudyStore>,
        jobs: JobService,
        workers: usize,
        (room, retention): (u32, Option<Duration>),
    ) -> Self {
        Self {
            store,
            jobs,
            workers: workers.max(1),
            changed: Arc::default(),
            room,
            retention,
        }
    }

    /// Number of workers.
    pub fn workers(&self) -> usize {
        self.workers
    }

    /// Members of a study that wait or run at a time, while so many jobs run here and elsewhere:
    /// as long as workers take all that is made for them, more is made.
    pub(super) fn members_at_once(&self, running_jobs: u64) -> u64 {
        let members = MEMBERS_PER_WORKER * running_jobs.max(self.workers as u64);
        members.min(MEMBERS_AT_ONCE)
    }

    fn room_for(&self, submitter: Option<&str>) -> Room {
        Room {
            queue: self.room,
            submitter: submitter.map(|_| self.room_of_one()),
        }
    }

    /// Largest number of studies of one token that run at a time: half of all, so that none takes
    /// all places.
    pub fn room_of_one(&self) -> u32 {
        (self.room / 2).max(1)
    }

    /// Largest number of studies that run at a time.
    pub fn room(&self) -> u32 {
        self.room
    }

    /// Keeps a study whose members name these terrains; they are made from now on.
    ///
    /// # Errors
    /// The store's own.
    pub async fn submit(
        &self,
        (title, document): (&str, &str),
        (submitter, key): (Option<&str>, Option<&Key>),
        terrains: &[TerrainHash],
    ) -> Result<(StudySubmitted, StudyId), StoreError> {
        let id = StudyId::new();
        let new = NewStudy {
            id,
            title,
            document,
            submitter,
            key,
            terrains,
            room: self.room_for(submitter),
        };
        let submitted = self.store.add_study(&new).await?;
        self.changed.notify_one();
        Ok((submitted, id))
    }

    /// The study, if there is one.
    ///
    /// # Errors
    /// The store's own.
    pub async fn study(&self, id: StudyId) -> Result<Option<StoredStudy>, StoreError> {
        self.store.study(id).await
    }

    /// Studies, newest first.
    ///
    /// # Errors
    /// The store's own.
    pub async fn studies(&self, page: &StudyPage) -> Result<Vec<StoredStudy>, StoreError> {
        self.store.studies(page).await
    }

    /// Members of a study on a level, from this number on.
    ///
    /// # Errors
    /// The store's own.
    pub async fn members(
        &self,
        id: StudyId,
        from: (u32, u64),
        limit: u32,
    ) -> Result<Vec<ListedMember>, StoreError> {
        self.store.members(id, from, limit).await
    }

    /// Goes on with another document instead of the one that it has.
    ///
    /// # Errors
    /// The store's own.
    pub async fn enlarge(
        &self,
        study: &StoredStudy,
        document: &str,
    ) -> Result<Enlarged, StoreError> {
        let documents = (study.document.get(), document);
        let room = self.room_for(study.submitter.as_deref());
        let enlarged = self.store.enlarge_study(study.id, documents, room).await?;
        self.changed.notify_one();
        Ok(enlarged)
    }

    /// Dismisses a study with its members.
    ///
    /// # Errors
    /// The store's own.
    pub async fn dismiss(&self, id: StudyId) -> Result<StudyDismissal, StoreError> {
        let end = StudyEnd {
            status: StudyStatus::Dismissed,
            problem: None,
            document: None,
        };
        self.end(id, end).await
    }

    /// Ends a study, and stops its members that run.
    pub(super) async fn end(
        &self,
        id: StudyId,
        end: StudyEnd<'_>,
    ) -> Result<StudyDismissal, StoreError> {
        let ended = self.store.end_study(id, end).await?;
        if let StudyDismissal::Done(jobs) = &ended {
            self.stop(jobs);
        }
        Ok(ended)
    }

    fn stop(&self, jobs: &[JobId]) {
        for job in jobs {
            self.jobs.stop_running(*job);
        }
    }

    /// Removes a study that has ended, with all jobs that were made for it alone.
    ///
    /// # Errors
    /// The store's own. What is left then is removed by the upkeep.
    pub async fn remove(&self, id: StudyId) -> Result<Removal, StoreError> {
        let removal = self.store.remove_study(id).await?;
        if removal == Removal::Removed {
            while self.store.remove_orphans().await? > 0 {}
        }
        Ok(removal)
    }

    /// Members with an outcome.
    ///
    /// # Errors
    /// The store's own.
    pub async fn outcomes(&self, id: StudyId) -> Result<Vec<Member>, StoreError> {
        let stored = self.store.outcomes(id).await?;
        let read = |member: &crate::jobs::store::MemberOutcome| Member {
            level: member.level,
            index: member.member,
            outcome: serde_json::from_str(&member.outcome)
                .unwrap_or_else(|_| MemberOutcome::failed("unreadable")),
        };
        Ok(stored.iter().map(read).collect())
    }

    /// Waits for news of a job or a study; false if the service closes.
    pub(super) async fn wait_for_news(&self, news: &mut Receiver<News>) -> bool {
        tokio::select! {
            news = news.recv() => !matches!(news, Ok(News::Closing) | Err(RecvError::Closed)),
            () = self.changed.notified() => true,
        }
    }
}
