//! Driver of studies: one task makes their members, notes their outcomes, and ends them. All that
//! it knows is in the database, so that it goes on after a crash where it was.

use super::StudyService;
use super::members::{NewMembersError, is_allowed, new_members};
use super::outcome;
use super::schedule::{Conclusion, Next, conclusion, next};
use super::study::{MemberCounts, StoredStudy, StudyId, StudyStatus};
use crate::jobs::failure::Failure;
use crate::jobs::store::{
    EndedMember, Enlarged, MemberOutcome, NewMember, StoreError, StudyDismissal, StudyEnd,
};
use scree_studies::Ensemble;
use std::time::Duration;
use thiserror::Error;
use tokio::task::JoinHandle;
use tokio::time::{sleep, timeout};
use tracing::{info, warn};

/// Longest time between two looks at the studies.
const LOOK_PAUSE: Duration = Duration::from_secs(1);

/// Least time between two looks: each reads all members in work.
const LEAST_PAUSE: Duration = Duration::from_millis(50);

/// Members added in one transaction.
const MEMBERS_ADDED_AT_ONCE: usize = 500;

/// Reason why a study can't go on.
#[derive(Debug, Error)]
enum DriveError {
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The study, or what is stored of it, is not as it should be; it can't be mended.
    #[error("{0}")]
    Study(String),
}

/// Starts the driver; it ends when the service closes.
pub(crate) fn start(studies: StudyService) -> JoinHandle<()> {
    tokio::spawn(async move { drive(&studies).await })
}

async fn drive(studies: &StudyService) {
    let mut news = studies.jobs.news();
    loop {
        match studies.store.leads().await {
            Ok(true) => {
                look_at_all(studies).await;
                if let Err(error) = remove_old(studies).await {
                    warn!(%error, "old studies can't be removed now");
                }
            }
            Ok(false) => {}
            Err(error) => warn!(%error, "studies can't be driven now"),
        }
        sleep(LEAST_PAUSE).await;
        // Members that end and studies that come are events; what is missed is seen a little later.
        if timeout(LOOK_PAUSE, studies.wait_for_news(&mut news)).await == Ok(false) {
            return;
        }
    }
}

async fn look_at_all(studies: &StudyService) {
    let (running, most) = match running_studies(studies).await {
        Ok(running) => running,
        Err(error) => return warn!(%error, "studies can't be read now"),
    };
    for (id, counts) in running {
        match advance(studies, id, (counts, most)).await {
            Ok(()) => {}
            Err(DriveError::Store(error)) => warn!(%id, %error, "the study waits"),
            Err(DriveError::Study(why)) => fail(studies, id, &why).await,
        }
    }
}

/// The running studies, and the largest number of members that each may have in work.
async fn running_studies(
    studies: &StudyService,
) -> Result<(Vec<(StudyId, MemberCounts)>, u64), StoreError> {
    let running = studies.store.running_studies().await?;
    if running.is_empty() {
        return Ok((running, 0));
    }
    let most = studies.members_at_once(studies.store.running_jobs().await?);
    Ok((running, most))
}

/// Removes a study after its retention time, and some of the jobs that removed studies have left.
async fn remove_old(studies: &StudyService) -> Result<(), StoreError> {
    if let Some(age) = studies.retention {
        let age_ms = i64::try_from(age.as_millis()).unwrap_or(i64::MAX);
        if let Some(id) = studies.store.study_ended_before(age_ms).await? {
            studies.store.remove_study(id).await?;
            info!(%id, "removed a study that ended long ago");
        }
    }
    studies.store.remove_orphans().await?;
    Ok(())
}

/// Notes the outcomes of members that have ended, and takes the next step of the schedule.
async fn advance(
    studies: &StudyService,
    id: StudyId,
    (before, most): (MemberCounts, u64),
) -> Result<(), DriveError> {
    let is_news = note_outcomes(studies, id).await?;
    // Nothing is left to do since the last step, unless a member has ended or more may be in work.
    let in_work = before.made - before.ended;
    if !is_news && in_work > 0 && in_work >= most {
        return Ok(());
    }
    let stored = match studies.store.study(id).await? {
        Some(stored) if stored.status == StudyStatus::Running => stored,
        _ => return Ok(()),
    };
    let jobs = studies.jobs.clone();
    let in_work = stored.members.made - stored.members.ended;
    let made = studies.store.members_made(id).await?;
    let step = aside(&stored, move |ensemble| {
        match next(ensemble.study(), &made, (in_work, most)) {
            Next::Members(ids) => new_members(ensemble, (id, &ids), &jobs).map(Step::Members),
            Next::Wait => Ok(Step::Wait),
            Next::Conclude => Ok(Step::Conclude),
        }
    });
    match step.await?.map_err(|error| match error {
        NewMembersError::Member(error) => DriveError::Study(error.to_string()),
        NewMembersError::Store(error) => error.into(),
    })? {
        Step::Members(members) => {
            let mut added = 0;
            for some in members.chunks(MEMBERS_ADDED_AT_ONCE) {
                added += studies.store.add_members(id, some).await?;
            }
            if added > 0 {
                studies.jobs.announce();
                // Members without a new job end without an event.
                studies.changed.notify_one();
            }
        }
        Step::Wait => {}
        Step::Conclude => conclude(studies, &stored).await?,
    }
    Ok(())
}

/// Ends a study all of whose members have an outcome, or enlarges it, unless it has been changed
/// meanwhile.
async fn conclude(studies: &StudyService, stored: &StoredStudy) -> Result<(), DriveError> {
    let (id, document) = (stored.id, stored.document.get());
    let outcomes = studies.outcomes(id).await?;
    let jobs = studies.jobs.clone();
    let conclusion = aside(stored, move |ensemble| {
        conclusion(ensemble, &outcomes, |scenario| is_allowed(scenario, &jobs))
    });
    match conclusion.await? {
        Conclusion::Enlarge(larger) => {
            let larger = serde_json::to_string(&larger);
            let larger = larger.map_err(|error| DriveError::Study(error.to_string()))?;
            if studies.enlarge(stored, &larger).await? == Enlarged::Done {
                info!(%id, "enlarged");
            }
        }
        Conclusion::End => {
            let end = StudyEnd {
                status: StudyStatus::Successful,
                problem: None,
                document: Some(document),
            };
            if let StudyDismissal::Done(_) = studies.end(id, end).await? {
                info!(%id, "ended");
            }
        }
    }
    Ok(())
}

/// Step of a study, ready to be taken.
enum Step {
    Members(Vec<NewMember>),
    Wait,
    Conclude,
}

/// Result of `make` with the members of a study, on a thread where it delays no request.
async fn aside<T: Send + 'static>(
    stored: &StoredStudy,
    make: impl FnOnce(&Ensemble) -> T + Send + 'static,
) -> Result<T, DriveError> {
    let stored = stored.clone();
    let made = tokio::task::spawn_blocking(move || stored.with_ensemble(make));
    made.await
        .map_err(|error| DriveError::Study(error.to_string()))?
        .map_err(|error| DriveError::Study(error.to_string()))
}

/// Notes the outcomes of members that have ended; true if there were any.
async fn note_outcomes(studies: &StudyService, id: StudyId) -> Result<bool, StoreError> {
    let mut is_news = false;
    loop {
        let ended = studies.store.ended_members(id).await?;
        if ended.is_empty() {
            return Ok(is_news);
        }
        let outcomes: Vec<MemberOutcome> = ended.iter().map(in_short).collect();
        studies.store.note_outcomes(id, &outcomes).await?;
        is_news = true;
    }
}

fn in_short(ended: &EndedMember) -> MemberOutcome {
    MemberOutcome {
        level: ended.level,
        member: ended.member,
        outcome: serde_json::to_string(&outcome::of_ended(ended)).unwrap_or_default(),
    }
}

/// Ends a study that can't go on.
async fn fail(studies: &StudyService, id: StudyId, why: &str) {
    tracing::error!(%id, why, "the study can't go on");
    let error_id = uuid::Uuid::now_v7().to_string();
    let problem = serde_json::to_string(&Failure::internal(&error_id)).unwrap_or_default();
    let end = StudyEnd {
        status: StudyStatus::Failed,
        problem: Some(&problem),
        document: None,
    };
    if let Err(error) = studies.end(id, end).await {
        warn!(%id, %error, "its end can't be written now");
    }
}
