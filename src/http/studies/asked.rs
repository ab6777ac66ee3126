//! A study asked for, with the outcomes of its members.

use super::named::{NamedStudy, readable};
use crate::http::access::Caller;
use crate::http::problem::Problem;
use crate::http::services::Services;
use crate::jobs::JobService;
use crate::studies::StudyService;
use crate::studies::export::MemberTable;
use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use scree_studies::answers::{Answer, Measures, RestDistribution};
use scree_studies::{Answers, Ensemble, Member, Question};

/// Study about whose members something is asked.
pub(in crate::http) struct AskedStudy {
    jobs: JobService,
    studies: StudyService,
    caller: Caller,
    id: String,
}

impl FromRequestParts<Services> for AskedStudy {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &Services) -> Result<Self, Problem> {
        let caller = Caller::from_request_parts(parts, state).await?;
        let NamedStudy(id) = NamedStudy::from_request_parts(parts, state).await?;
        Ok(Self {
            jobs: state.jobs.clone(),
            studies: state.studies.clone(),
            caller,
            id,
        })
    }
}

/// Members of a study that have an outcome.
pub(super) struct Outcomes<'a> {
    pub(super) ensemble: &'a Ensemble<'a>,
    pub(super) members: Vec<Member>,
}

impl AskedStudy {
    /// Its name in the path.
    pub(super) fn id(&self) -> &str {
        &self.id
    }

    /// Result of `make` with the outcomes, in the caller's place in the admission pool.
    pub(super) async fn make<T: Send + 'static>(
        self,
        make: impl FnOnce(&Outcomes) -> Result<T, Problem> + Send + 'static,
    ) -> Result<T, Problem> {
        let stored = readable(&self.studies, &self.caller, &self.id).await?;
        let place = self.jobs.enter(&self.caller.share())?;
        let members = self.studies.outcomes(stored.id).await?;
        let made = place
            .work(move |_| stored.with_ensemble(|ensemble| make(&Outcomes { ensemble, members })));
        made.await??
    }
}

impl Outcomes<'_> {
    /// Answers to all questions of the study.
    pub(super) fn answers(&self) -> Answers {
        Answers::of(self.ensemble, &self.members)
    }

    pub(super) fn table(&self) -> MemberTable {
        MemberTable::of(self.ensemble, &self.members)
    }

    /// The first question of a kind from this place on, and its answer.
    fn answer<T>(
        &self,
        asked: Option<usize>,
        what: &str,
        of_kind: impl Fn(Answer) -> Option<T>,
        is_of_kind: impl Fn(&Question) -> bool,
    ) -> Result<(usize, T), Problem> {
        let mut questions = self.ensemble.study().questions.iter().enumerate();
        let found = questions.find(|(place, question)| {
            is_of_kind(question) && asked.is_none_or(|asked| asked == *place)
        });
        let answer = found.and_then(|(place, question)| {
            let answer = Answer::of(self.ensemble, &self.members, question);
            Some((place, of_kind(answer)?))
        });
        answer.ok_or_else(|| {
            let detail = match asked {
                Some(place) => format!("question {place} of the study has no {what}"),
                None => format!("no question of the study has a {what}"),
            };
            Problem::not_found("no-answer", detail)
        })
    }

    pub(super) fn rest(&self, asked: Option<usize>) -> Result<(usize, RestDistribution), Problem> {
        let rest = |answer| match answer {
            Answer::Rest(rest) => Some(rest),
            _ => None,
        };
        let is_rest = |question: &Question| matches!(question, Question::Rest(_));
        self.answer(asked, "resting place", rest, is_rest)
    }

    pub(super) fn sensitivity(&self, asked: Option<usize>) -> Result<(usize, Measures), Problem> {
        let measures = |answer| match answer {
            Answer::Sensitivity(measures) => measures,
            _ => None,
        };
        let is_it = |question: &Question| matches!(question, Question::Sensitivity(_));
        self.answer(asked, "sensitivity", measures, is_it)
    }
}
