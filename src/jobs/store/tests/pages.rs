//! Rules of pages, for every driver.

use super::*;

conformance! {
    members_of_studies_are_left_out_if_they_are_not_wanted
    pages_have_what_they_are_asked_for_newest_first
    a_page_ends_where_its_outcomes_are_large
}

impl Fixture {
    /// Places in `all` of the jobs of all pages of this kind, page by page.
    async fn pages(&self, all: &[JobId], page: &Page) -> Vec<Vec<usize>> {
        let mut page = page.clone();
        let mut pages = Vec::new();
        loop {
            let found = self.store.page(&page).await.unwrap();
            let place = |job: &ListedJob| all.iter().position(|id| *id == job.summary.id).unwrap();
            pages.push(found.jobs.iter().map(place).collect());
            page.before = found.jobs.last().map(|job| job.summary.sequence);
            if !found.more {
                return pages;
            }
        }
    }

    async fn submit_labelled(&self) -> JobId {
        let jobs = [NewJob {
            labels: vec!["odd".to_owned()],
            ..new_job()
        }];
        self.store.submit(&submission(&jobs)).await.unwrap();
        jobs[0].id
    }
}

fn any() -> Page {
    Page {
        statuses: JobStatus::ALL.to_vec(),
        label: None,
        members: true,
        created_from: None,
        created_to: None,
        before: None,
        limit: 3,
        outcomes: false,
    }
}

async fn pages_have_what_they_are_asked_for_newest_first(fixture: &Fixture) {
    let start = fixture.clock.now();
    let mut all = Vec::new();
    for number in 0..8 {
        all.push(match number % 2 {
            0 => fixture.submit().await,
            _ => fixture.submit_labelled().await,
        });
        // The clock is set back in between: the order is that of submission.
        match number {
            3 => fixture.clock.jump(SignedDuration::from_secs(-25)),
            _ => fixture.pass(Duration::from_secs(10)),
        }
    }
    // Accepted after 0, 10, 20, 30, 5, 15, 25, 35 s.
    let first = fixture.claim("a").await;
    assert!(fixture.succeed(first).await);
    fixture.claim("a").await;
    fixture.store.dismiss(all[2]).await.unwrap();

    let at = |seconds: i64| Some(start + SignedDuration::from_secs(seconds));
    let label = Some("odd".to_owned());
    use JobStatus::{Accepted, Dismissed, Running, Successful};
    let page = any();
    assert_eq!(
        fixture.pages(&all, &page).await,
        [vec![7, 6, 5], vec![4, 3, 2], vec![1, 0]]
    );
    let page = Page {
        statuses: vec![Successful, Running, Dismissed],
        ..any()
    };
    assert_eq!(fixture.pages(&all, &page).await, [[2, 1, 0]]);
    let page = Page {
        created_from: at(10),
        created_to: at(25),
        ..any()
    };
    assert_eq!(fixture.pages(&all, &page).await, [vec![6, 5, 2], vec![1]]);
    let almost = SignedDuration::from_micros(1);
    let page = Page {
        created_from: at(10).map(|time| time + almost),
        created_to: at(25).map(|time| time - almost),
        ..any()
    };
    assert_eq!(fixture.pages(&all, &page).await, [[5, 2]]);
    let page = Page {
        statuses: vec![Accepted, Running],
        label: label.clone(),
        limit: 2,
        ..any()
    };
    assert_eq!(fixture.pages(&all, &page).await, [[7, 5], [3, 1]]);
    let page = Page {
        created_to: at(15),
        label,
        ..any()
    };
    assert_eq!(fixture.pages(&all, &page).await, [[5, 1]]);
}

async fn members_of_studies_are_left_out_if_they_are_not_wanted(fixture: &Fixture) {
    let study = fixture.study("a study").await;
    let mut all = Vec::new();
    for number in 0..3 {
        all.push(fixture.submit_labelled().await);
        let scenario = format!("{{\"number\": {number}}}");
        all.push(fixture.add(study, number, &scenario).await);
    }
    let page = Page { limit: 2, ..any() };
    assert_eq!(fixture.pages(&all, &page).await, [[5, 4], [3, 2], [1, 0]]);
    for label in [None, Some("odd".to_owned())] {
        let page = Page {
            members: false,
            label,
            ..page.clone()
        };
        assert_eq!(fixture.pages(&all, &page).await, [vec![4, 2], vec![0]]);
    }
}

async fn a_page_ends_where_its_outcomes_are_large(fixture: &Fixture) {
    let mut all = Vec::new();
    let outcome = format!("\"{}\"", "x".repeat(page::OUTCOME_BYTES / 2));
    for _ in 0..5 {
        all.push(fixture.submit().await);
        let lease = fixture.claim("a").await;
        fixture
            .store
            .succeed(lease, &outcome, FINGERPRINT)
            .await
            .unwrap();
    }
    let page = Page {
        limit: 100,
        outcomes: true,
        ..any()
    };
    assert_eq!(
        fixture.pages(&all, &page).await,
        [vec![4, 3], vec![2, 1], vec![0]]
    );
    let found = fixture.store.page(&page).await.unwrap();
    let with_outcome = |job: &ListedJob| job.outcome.as_ref().map(|text| text.get().to_owned());
    assert_eq!(with_outcome(&found.jobs[0]), Some(outcome));
    let page = Page {
        outcomes: false,
        ..page
    };
    assert_eq!(fixture.pages(&all, &page).await, [[4, 3, 2, 1, 0]]);
    let found = fixture.store.page(&page).await.unwrap();
    assert_eq!(with_outcome(&found.jobs[0]), None);
}
