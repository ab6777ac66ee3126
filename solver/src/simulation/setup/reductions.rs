//! Reductions: parts of a scene that are not computed, with reasons.

use super::symmetry::{Why, partners, uniform_across};
use super::{Columns, Setup, Share, Shares};
use crate::error::SetupError;
use crate::rigid::{Body, Freedom};
use crate::scenario::{Approach, Scenario, Symmetry};

/// Reductions of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Reductions {
    /// Computation of one half only, or the reason against it.
    pub mirror: Result<(), String>,
    /// Beginning with a slab, or the reason against it.
    pub slab: Result<(), String>,
    /// Computed shares of the flow; `None`: all of it.
    pub shares: Option<Shares>,
}

impl Reductions {
    /// Reductions that a scene allows and the scenario does not forbid.
    ///
    /// # Errors
    /// A requested reduction that this scene does not allow.
    pub(super) fn of(
        scenario: &Scenario,
        given: &Setup,
        columns: Option<&Columns>,
        bodies: &[Body],
    ) -> Result<Self, SetupError> {
        let scene = ExaminedScene {
            scenario,
            given,
            columns,
            bodies,
        };
        let partners = scene.mirror()?;
        let last = match partners {
            Ok(_) => Share::Half,
            Err(_) => Share::Whole,
        };
        let slab = scene.slab(last)?;
        let first = match slab {
            Ok(()) => Share::Slab,
            Err(_) => last,
        };
        let (mirror, partners) = match partners {
            Ok(partners) => (Ok(()), partners),
            Err(why) => (Err(why), Vec::new()),
        };
        let shares = columns.filter(|_| first != Share::Whole);
        let shares = shares.map(|columns| Shares {
            first,
            last,
            columns: *columns,
            partners,
        });
        Ok(Self {
            mirror,
            slab,
            shares,
        })
    }

    /// No reductions.
    pub fn none() -> Self {
        let not_asked = || "not asked for".to_owned();
        Self {
            mirror: Err(not_asked()),
            slab: Err(not_asked()),
            shares: None,
        }
    }

    /// Share of the release that is set up.
    pub(super) fn first_share(&self) -> Share {
        let first = |shares: &Shares| shares.first;
        self.shares.as_ref().map_or(Share::Whole, first)
    }

    /// Bodies of a scene computed by halves stay in the centre plane.
    pub(super) fn confine(&self, bodies: &mut [Body]) {
        if self.mirror.is_err() {
            return;
        }
        for body in bodies.iter_mut().filter(|body| body.is_free()) {
            body.freedom = Freedom::InPlane;
            body.state.position.y = 0.0;
        }
    }
}

/// A scene whose possible reductions are examined.
struct ExaminedScene<'a> {
    scenario: &'a Scenario,
    given: &'a Setup,
    columns: Option<&'a Columns>,
    bodies: &'a [Body],
}

impl ExaminedScene<'_> {
    fn without_columns(&self) -> Why {
        match (&self.scenario.flow, self.scenario.terrain()) {
            (Some(_), Some(_)) => "a terrain has no centre plane and no uniform width".to_owned(),
            _ => "there is no flow".to_owned(),
        }
    }

    fn halves_across(&self) -> i32 {
        self.given.walls.halves_across()
    }

    /// Image of each body, or the reason against computation by halves.
    fn mirror(&self) -> Result<Result<Vec<usize>, Why>, SetupError> {
        let asked = self.scenario.numerics.symmetry;
        let found = match (asked, self.columns) {
            (Symmetry::Full, _) => Err(forbidden("symmetry")),
            (_, None) => Err(self.without_columns()),
            _ if Share::Half.halves_across(self.halves_across()) < 2 => {
                Err("the channel is one cell wide".to_owned())
            }
            (_, Some(columns)) => partners(self.scenario, columns, self.bodies),
        };
        insist(found, asked == Symmetry::Mirror, "symmetry", "mirror")
    }

    /// Check that it may begin with a slab before this share; otherwise the reason.
    fn slab(&self, last: Share) -> Result<Result<(), Why>, SetupError> {
        let asked = self.scenario.numerics.approach;
        let found = match (asked, self.columns) {
            (Approach::Full, _) => Err(forbidden("approach")),
            (_, None) => Err(self.without_columns()),
            _ if last.halves_across(self.halves_across()) <= 2 => {
                Err("what is computed is one cell wide anyway".to_owned())
            }
            (_, Some(columns)) => uniform_across(self.scenario, columns, self.given, self.bodies),
        };
        insist(found, asked == Approach::Slab, "approach", "slab")
    }
}

fn forbidden(key: &str) -> Why {
    format!("numerics.{key} is \"full\"")
}

/// The result; an error if it was requested and is not possible.
fn insist<T>(
    found: Result<T, Why>,
    asked: bool,
    key: &'static str,
    word: &'static str,
) -> Result<Result<T, Why>, SetupError> {
    match found {
        Err(why) if asked => Err(SetupError::NotReducible { key, word, why }),
        found => Ok(found),
    }
}
