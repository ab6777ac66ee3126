//! Levels of cell size (Giles 2008): all members are computed on the coarsest, and the first of
//! them on finer ones, too.

use super::pointer::Pointer;
use super::{Study, Violation};
use crate::design::Design;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Place of the cell size in a scenario.
pub(super) const CELL_SIZE: &str = "/numerics/cell_size_m";
/// Most finer levels.
pub(crate) const MOST_FINER: usize = 6;
/// Fewest members of a finer level: fewer tell little of how it differs from the coarser one.
pub(crate) const FEWEST_MEMBERS: u64 = 8;
/// Smallest and largest ratio of the cell sizes of neighbouring levels.
const RATIOS: [f64; 2] = [1.2, 4.0];

/// Level of finer cells.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct FinerLevel {
    /// Cell size [m], smaller than that of the level before by a factor of 1.2 to 4.
    pub cell_size_m: f64,
    /// Number of members, at least 8 and at most those of the level before: the first of the design.
    pub members: u64,
}

/// Name of a run of a study: a member on a level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MemberId {
    /// Level, 0 the coarsest.
    pub level: u32,
    /// Index in the design.
    pub index: u64,
}

impl MemberId {
    /// Member on the coarsest level.
    pub fn coarsest(index: u64) -> Self {
        Self { level: 0, index }
    }
}

impl Study {
    /// Number of levels, at least one.
    pub fn levels(&self) -> u32 {
        1 + self.finer_levels.len() as u32
    }

    /// Number of members on a level: all on level 0, none beyond the finest.
    pub fn members_on(&self, level: u32) -> u64 {
        match level.checked_sub(1) {
            None => self.members(),
            Some(finer) => {
                let finer = self.finer_levels.get(finer as usize);
                finer.map_or(0, |level| level.members)
            }
        }
    }

    /// Names of all runs, those of the finest level first, since they take longest.
    pub fn ids(&self) -> impl Iterator<Item = MemberId> {
        let levels = (0..self.levels()).rev();
        let levels = levels.map(|level| (level, self.members_on(level)));
        levels.flat_map(|(level, members)| (0..members).map(move |index| MemberId { level, index }))
    }

    /// Number of runs: the members of all levels together.
    pub fn runs(&self) -> u64 {
        (0..self.levels()).map(|level| self.members_on(level)).sum()
    }

    /// Cell size of a level [m]; none of level 0 if the scenario leaves it to the solver.
    pub fn cell_size_m(&self, level: u32) -> Option<f64> {
        match level.checked_sub(1) {
            None => self.scenario.pointer(CELL_SIZE).and_then(Value::as_f64),
            Some(finer) => {
                let finer = self.finer_levels.get(finer as usize);
                finer.map(|level| level.cell_size_m)
            }
        }
    }

    /// True if the other study has this one's levels first, with any numbers of members.
    pub fn levels_go_on_in(&self, other: &Self) -> bool {
        let sizes = |study: &Self| -> Vec<f64> {
            let finer = study.finer_levels.iter();
            finer.map(|level| level.cell_size_m).collect()
        };
        sizes(other).starts_with(&sizes(self))
    }
}

/// All that is wrong with the levels, in the order of the document.
pub(super) fn violations(study: &Study) -> Vec<Violation> {
    let mut found = unsuited(study);
    if study.finer_levels.len() > MOST_FINER {
        let given = format!("a list of {}", study.finer_levels.len());
        let allowed = format!("at most {MOST_FINER} finer levels");
        found.push(Violation::of("/finer_levels", given, allowed));
        return found;
    }
    for (place, level) in study.finer_levels.iter().enumerate() {
        let at = format!("/finer_levels/{place}");
        found.extend(Violation::under(&at, wrong_level(study, place, *level)));
    }
    found
}

/// What a study with levels can't have.
fn unsuited(study: &Study) -> Vec<Violation> {
    if study.finer_levels.is_empty() && study.accuracy.is_none() {
        return Vec::new();
    }
    let mut found = Vec::new();
    if !study.cell_size_m(0).is_some_and(|size| size > 0.0) {
        let pointer = format!("/scenario{CELL_SIZE}");
        let given = study.scenario.pointer(CELL_SIZE).unwrap_or(&Value::Null);
        let allowed = "a number x > 0 [m], the cell size of the coarsest level";
        found.push(Violation::of(&pointer, given, allowed));
    }
    for (place, input) in study.inputs.iter().enumerate() {
        let (given, cells) = (Pointer::parse(&input.pointer), Pointer::parse(CELL_SIZE));
        if let (Ok(given), Ok(cells)) = (given, cells)
            && given.overlaps(&cells)
        {
            let at = format!("/inputs/{place}/pointer");
            let allowed = "another place than the cell size, which the levels set";
            found.push(Violation::of(&at, format!("{:?}", input.pointer), allowed));
        }
    }
    if !matches!(study.design, Design::Sobol(_)) {
        let message = "levels need a design whose first members are balanced, too: sobol";
        found.push(Violation::new("/design", message));
    }
    found
}

fn wrong_level(study: &Study, place: usize, level: FinerLevel) -> Vec<Violation> {
    let coarser = place as u32;
    let mut found = Vec::new();
    if let Some(size) = study.cell_size_m(coarser) {
        let [least, most] = [size / RATIOS[1], size / RATIOS[0]];
        if !(level.cell_size_m >= least && level.cell_size_m <= most) {
            let allowed =
                format!("{least} <= x <= {most} [m], 1.2 to 4 times finer than the level before");
            found.push(Violation::of("/cell_size_m", level.cell_size_m, allowed));
        }
    }
    let most = study.members_on(coarser);
    if level.members < FEWEST_MEMBERS || level.members > most {
        let allowed = format!("{FEWEST_MEMBERS} <= x <= {most}, the members of the level before");
        found.push(Violation::of("/members", level.members, allowed));
    }
    found
}
