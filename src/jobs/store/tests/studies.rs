//! Rules for every driver that keeps studies, one per test.

use super::*;
use crate::studies::study::{MemberCounts, StudyId, StudyStatus};

conformance! {
    members_are_claimed_when_no_other_job_waits
    members_take_no_place_in_the_queue
    a_member_is_made_once_and_only_of_a_running_study
    members_of_each_level_are_counted_and_listed_by_themselves
    members_with_equal_scenarios_share_a_job_of_one_submitter
    the_outcome_of_a_member_is_noted_once_and_outlives_its_job
    a_member_whose_scenario_is_not_allowed_has_an_outcome_and_no_job
    a_study_ends_with_its_members_unless_another_needs_them
    a_removed_study_takes_along_what_it_alone_has
    a_repeated_request_finds_the_study_of_the_first
    only_so_many_studies_run_at_a_time
    a_successful_study_goes_on_when_it_is_enlarged_and_no_other
    a_study_that_was_changed_meanwhile_is_neither_ended_nor_enlarged
    studies_are_listed_newest_first
    running_studies_are_counted_in_the_order_of_submission
}

impl Fixture {
    pub(super) async fn study(&self, title: &str) -> StudyId {
        let id = StudyId::new();
        let submitted = self.store.add_study(&new_study(id, title)).await.unwrap();
        assert_eq!(submitted, StudySubmitted::Accepted);
        id
    }

    pub(super) async fn add(&self, study: StudyId, member: u64, scenario: &str) -> JobId {
        let members = [new_member(member, scenario)];
        let added = self.store.add_members(study, &members).await.unwrap();
        assert_eq!(added, 1);
        self.job_of(study, member).await.unwrap()
    }

    async fn job_of(&self, study: StudyId, member: u64) -> Option<JobId> {
        let members = self.store.members(study, (0, member), 1).await.unwrap();
        assert_eq!(members[0].member, member);
        members[0].job
    }

    async fn state(&self, study: StudyId) -> StudyStatus {
        self.store.study(study).await.unwrap().unwrap().status
    }

    async fn end(&self, study: StudyId, status: StudyStatus) -> StudyDismissal {
        let end = StudyEnd {
            status,
            problem: None,
            document: None,
        };
        self.store.end_study(study, end).await.unwrap()
    }
}

pub(super) fn new_study(id: StudyId, title: &str) -> NewStudy<'_> {
    NewStudy {
        id,
        title,
        document: "{}",
        submitter: None,
        key: None,
        terrains: &[],
        room: room(100, None),
    }
}

fn room(queue: u32, submitter: Option<u32>) -> Room {
    Room { queue, submitter }
}

/// A member whose scenario is told from others by this letter.
pub(super) fn new_member(member: u64, scenario: &str) -> NewMember {
    let job = NewJob {
        scenario_hash: scenario.repeat(64),
        ..new_job()
    };
    NewMember {
        level: 0,
        member,
        work: MemberWork::Job(Box::new(job)),
    }
}

async fn members_are_claimed_when_no_other_job_waits(fixture: &Fixture) {
    let study = fixture.study("a").await;
    let first = fixture.add(study, 0, "a").await;
    let second = fixture.add(study, 1, "b").await;
    let single = fixture.submit().await;
    for expected in [single, first, second] {
        assert_eq!(fixture.claim("w").await.job, expected);
    }
}

async fn members_take_no_place_in_the_queue(fixture: &Fixture) {
    let study = fixture.study("a").await;
    fixture.add(study, 0, "a").await;
    let jobs = [new_job()];
    let narrow = Submission {
        room: Room {
            queue: 1,
            submitter: None,
        },
        ..submission(&jobs)
    };
    let submitted = fixture.store.submit(&narrow).await.unwrap();
    assert_eq!(submitted, Submitted::Accepted);
}

async fn a_member_is_made_once_and_only_of_a_running_study(fixture: &Fixture) {
    let study = fixture.study("a").await;
    let job = fixture.add(study, 0, "a").await;
    let again = [new_member(0, "b"), new_member(1, "c")];
    assert_eq!(fixture.store.add_members(study, &again).await.unwrap(), 1);
    assert_eq!(fixture.job_of(study, 0).await, Some(job));
    let members = fixture.store.study(study).await.unwrap().unwrap().members;
    assert_eq!((members.made, members.ended), (2, 0));
    fixture.end(study, StudyStatus::Dismissed).await;
    let late = [new_member(2, "d")];
    assert_eq!(fixture.store.add_members(study, &late).await.unwrap(), 0);
}

async fn members_of_each_level_are_counted_and_listed_by_themselves(fixture: &Fixture) {
    let (study, other) = (fixture.study("a").await, fixture.study("b").await);
    assert!(fixture.store.members_made(study).await.unwrap().is_empty());
    let on_level = |level: u32, member: u64, scenario: &str| NewMember {
        level,
        ..new_member(member, scenario)
    };
    let members = [
        on_level(0, 0, "a"),
        on_level(2, 0, "b"),
        on_level(0, 1, "c"),
    ];
    fixture.store.add_members(study, &members).await.unwrap();
    fixture.add(other, 0, "d").await;
    let made = fixture.store.members_made(study).await.unwrap();
    assert_eq!(made, [2, 0, 1]);
    let numbers = async |level: u32, from: u64| {
        let found = fixture.store.members(study, (level, from), 10).await;
        let found = found.unwrap().into_iter();
        found
            .map(|member| (member.level, member.member))
            .collect::<Vec<_>>()
    };
    assert_eq!(numbers(0, 0).await, [(0, 0), (0, 1)]);
    assert_eq!(numbers(0, 1).await, [(0, 1)]);
    assert_eq!(numbers(1, 0).await, []);
    assert_eq!(numbers(2, 0).await, [(2, 0)]);
}

async fn members_with_equal_scenarios_share_a_job_of_one_submitter(fixture: &Fixture) {
    let one = fixture.study("one").await;
    let other = fixture.study("other").await;
    let theirs = StudyId::new();
    let of_another = NewStudy {
        submitter: Some("another"),
        ..new_study(theirs, "theirs")
    };
    fixture.store.add_study(&of_another).await.unwrap();
    let job = fixture.add(one, 0, "a").await;
    assert_eq!(fixture.add(other, 7, "a").await, job);
    assert_ne!(fixture.add(other, 8, "b").await, job);
    assert_ne!(fixture.add(theirs, 0, "a").await, job);
}

async fn the_outcome_of_a_member_is_noted_once_and_outlives_its_job(fixture: &Fixture) {
    let study = fixture.study("a").await;
    let job = fixture.add(study, 3, "a").await;
    let lease = fixture.claim("w").await;
    assert!(fixture.store.ended_members(study).await.unwrap().is_empty());
    assert!(fixture.succeed(lease).await);
    let ended = fixture.store.ended_members(study).await.unwrap();
    assert_eq!((ended.len(), ended[0].member), (1, 3));
    assert_eq!(ended[0].status, Some(JobStatus::Successful));
    assert_eq!(ended[0].outcome.as_deref(), Some("{}"));
    for text in ["1", "2"] {
        let noted = MemberOutcome {
            level: 0,
            member: 3,
            outcome: text.to_owned(),
        };
        fixture.store.note_outcomes(study, &[noted]).await.unwrap();
    }
    assert!(fixture.store.ended_members(study).await.unwrap().is_empty());
    assert_eq!(fixture.store.remove(job).await.unwrap(), Removal::Removed);
    let outcomes = fixture.store.outcomes(study).await.unwrap();
    assert_eq!(outcomes.len(), 1);
    assert_eq!(outcomes[0].outcome, "1");
    let listed = fixture.store.members(study, (0, 0), 10).await.unwrap();
    assert_eq!(listed[0].status, None);
}

async fn a_member_whose_scenario_is_not_allowed_has_an_outcome_and_no_job(fixture: &Fixture) {
    let study = fixture.study("a").await;
    let refused = [NewMember {
        level: 0,
        member: 0,
        work: MemberWork::Nothing("1".to_owned()),
    }];
    assert_eq!(fixture.store.add_members(study, &refused).await.unwrap(), 1);
    assert_eq!(fixture.job_of(study, 0).await, None);
    assert_eq!(fixture.try_claim("w").await, None);
    let outcomes = fixture.store.outcomes(study).await.unwrap();
    assert_eq!(outcomes[0].outcome, "1");
    fixture.end(study, StudyStatus::Successful).await;
    assert_eq!(
        fixture.store.remove_study(study).await.unwrap(),
        Removal::Removed
    );
}

async fn a_study_ends_with_its_members_unless_another_needs_them(fixture: &Fixture) {
    let one = fixture.study("one").await;
    let other = fixture.study("other").await;
    let shared = fixture.add(one, 0, "a").await;
    fixture.add(other, 0, "a").await;
    let own = fixture.add(one, 1, "b").await;
    let running = fixture.claim("w").await;
    assert_eq!(running.job, shared);
    assert_eq!(
        fixture.end(one, StudyStatus::Dismissed).await,
        StudyDismissal::Done(vec![own])
    );
    assert_eq!(fixture.status(own).await, JobStatus::Dismissed);
    assert_eq!(fixture.status(shared).await, JobStatus::Running);
    assert_eq!(
        fixture.end(other, StudyStatus::Dismissed).await,
        StudyDismissal::Done(vec![shared])
    );
    assert_eq!(
        fixture.end(other, StudyStatus::Dismissed).await,
        StudyDismissal::Done(Vec::new()),
        "once more changes nothing"
    );
    assert_eq!(
        fixture.end(other, StudyStatus::Successful).await,
        StudyDismissal::Ended(StudyStatus::Dismissed)
    );
    assert!(!fixture.succeed(running).await);
}

async fn a_removed_study_takes_along_what_it_alone_has(fixture: &Fixture) {
    let single = fixture.submit().await;
    let lease = fixture.claim("w").await;
    assert_eq!(lease.job, single);
    let one = fixture.study("one").await;
    let other = fixture.study("other").await;
    // The job that was submitted by itself has this scenario, and is shared once it has succeeded.
    assert_ne!(fixture.add(one, 7, "0").await, single);
    assert!(fixture.succeed(lease).await);
    let shared = fixture.add(one, 1, "a").await;
    fixture.add(other, 0, "a").await;
    let own = fixture.add(one, 2, "b").await;
    assert_eq!(
        fixture.store.remove_study(one).await.unwrap(),
        Removal::Active
    );
    fixture.end(one, StudyStatus::Dismissed).await;
    assert_eq!(
        fixture.store.remove_study(one).await.unwrap(),
        Removal::Removed
    );
    while fixture.store.remove_orphans().await.unwrap() > 0 {}
    assert!(fixture.store.study(one).await.unwrap().is_none());
    assert!(fixture.store.job(own).await.unwrap().is_none());
    for kept in [single, shared] {
        assert!(fixture.store.job(kept).await.unwrap().is_some());
    }
    assert_eq!(
        fixture.store.remove_study(one).await.unwrap(),
        Removal::Unknown
    );
}

async fn a_repeated_request_finds_the_study_of_the_first(fixture: &Fixture) {
    let key = |byte| Key {
        text: "k".to_owned(),
        request_hash: [byte; 32],
    };
    let (first, second) = (StudyId::new(), StudyId::new());
    let request = async |id, key: Key| {
        let study = NewStudy {
            key: Some(&key),
            ..new_study(id, "a")
        };
        fixture.store.add_study(&study).await.unwrap()
    };
    assert_eq!(request(first, key(1)).await, StudySubmitted::Accepted);
    assert_eq!(request(second, key(1)).await, StudySubmitted::Before(first));
    assert_eq!(request(second, key(2)).await, StudySubmitted::OtherRequest);
    assert!(fixture.store.study(second).await.unwrap().is_none());
}

async fn only_so_many_studies_run_at_a_time(fixture: &Fixture) {
    let first = fixture.study("a").await;
    let further = NewStudy {
        room: room(1, None),
        ..new_study(StudyId::new(), "b")
    };
    let submitted = fixture.store.add_study(&further).await.unwrap();
    assert_eq!(submitted, StudySubmitted::Full(1));
    fixture.end(first, StudyStatus::Successful).await;
    let submitted = fixture.store.add_study(&further).await.unwrap();
    assert_eq!(submitted, StudySubmitted::Accepted);
    for (submitter, expected) in [
        ("a", StudySubmitted::Accepted),
        ("a", StudySubmitted::QuotaSpent(1)),
        ("b", StudySubmitted::Accepted),
    ] {
        let of_one = NewStudy {
            submitter: Some(submitter),
            room: room(100, Some(1)),
            ..new_study(StudyId::new(), "c")
        };
        let submitted = fixture.store.add_study(&of_one).await.unwrap();
        assert_eq!(submitted, expected, "{submitter}");
    }
}

async fn a_successful_study_goes_on_when_it_is_enlarged_and_no_other(fixture: &Fixture) {
    let enlarge = async |study, documents| {
        let room = room(1, None);
        let enlarged = fixture.store.enlarge_study(study, documents, room).await;
        enlarged.unwrap()
    };
    let study = fixture.study("a").await;
    fixture.end(study, StudyStatus::Successful).await;
    let ended = fixture.store.study_ended_before(0).await.unwrap();
    assert_eq!(ended, Some(study));
    let other = fixture.study("b").await;
    let documents = ("{}", "{\"n\":2}");
    assert_eq!(enlarge(study, documents).await, Enlarged::Full(1));
    fixture.end(other, StudyStatus::Dismissed).await;
    assert_eq!(enlarge(study, documents).await, Enlarged::Done);
    assert_eq!(fixture.state(study).await, StudyStatus::Running);
    let stored = fixture.store.study(study).await.unwrap().unwrap();
    assert_eq!(stored.document.get(), "{\"n\":2}");
    fixture.end(study, StudyStatus::Dismissed).await;
    let ended = Enlarged::Ended(StudyStatus::Dismissed);
    assert_eq!(enlarge(study, documents).await, ended);
    assert_eq!(enlarge(StudyId::new(), documents).await, Enlarged::Unknown);
}

async fn a_study_that_was_changed_meanwhile_is_neither_ended_nor_enlarged(fixture: &Fixture) {
    let study = fixture.study("a").await;
    let enlarge = async |former, document| {
        let room = room(100, None);
        let documents = (former, document);
        let enlarged = fixture.store.enlarge_study(study, documents, room).await;
        enlarged.unwrap()
    };
    assert_eq!(enlarge("{}", "[1]").await, Enlarged::Done);
    assert_eq!(enlarge("{}", "[2]").await, Enlarged::Changed);
    let end = StudyEnd {
        status: StudyStatus::Successful,
        problem: None,
        document: Some("{}"),
    };
    let ended = fixture.store.end_study(study, end).await.unwrap();
    assert_eq!(ended, StudyDismissal::Changed);
    assert_eq!(fixture.state(study).await, StudyStatus::Running);
    let end = StudyEnd {
        document: Some("[1]"),
        ..end
    };
    fixture.store.end_study(study, end).await.unwrap();
    assert_eq!(fixture.state(study).await, StudyStatus::Successful);
}

async fn studies_are_listed_newest_first(fixture: &Fixture) {
    let mut ids = Vec::new();
    for title in ["a", "b", "c"] {
        ids.push(fixture.study(title).await);
    }
    fixture.end(ids[1], StudyStatus::Dismissed).await;
    let page = |status, before, limit| StudyPage {
        status,
        before,
        limit,
    };
    let found = fixture.store.studies(&page(None, None, 2)).await.unwrap();
    let listed: Vec<StudyId> = found.iter().map(|study| study.id).collect();
    assert_eq!(listed, [ids[2], ids[1]]);
    let before = Some(found[1].sequence);
    let rest = fixture.store.studies(&page(None, before, 2)).await.unwrap();
    assert_eq!(rest.len(), 1);
    assert_eq!(rest[0].title, "a");
    let running = page(Some(StudyStatus::Running), None, 10);
    let running = fixture.store.studies(&running).await.unwrap();
    assert_eq!(running.len(), 2);
}

async fn running_studies_are_counted_in_the_order_of_submission(fixture: &Fixture) {
    let [first, ended, last] = ["a", "b", "c"].map(|title| fixture.study(title));
    let (first, ended, last) = (first.await, ended.await, last.await);
    fixture.add(last, 0, "a").await;
    let job = fixture.add(last, 1, "b").await;
    fixture.end(ended, StudyStatus::Successful).await;
    let dismissed = fixture.store.dismiss(job).await.unwrap();
    assert_eq!(dismissed, Dismissal::Dismissed);
    let found = fixture.store.ended_members(last).await.unwrap();
    let outcomes = found.iter().map(|ended| MemberOutcome {
        level: ended.level,
        member: ended.member,
        outcome: "{}".to_owned(),
    });
    let outcomes: Vec<_> = outcomes.collect();
    fixture.store.note_outcomes(last, &outcomes).await.unwrap();
    let counts = |made, ended| MemberCounts { made, ended };
    let running = fixture.store.running_studies().await.unwrap();
    assert_eq!(running, [(first, counts(0, 0)), (last, counts(2, 1))]);
}
