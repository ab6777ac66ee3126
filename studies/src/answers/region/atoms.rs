//! Places at which many members come to rest.

use serde::{Deserialize, Serialize};

/// Distance up to which places are the same, over the extent of all places.
const SAME: f64 = 1e-6;
/// Smallest share of the members at an atom.
const LEAST_SHARE: f64 = 0.02;
/// Fewest members at an atom.
const FEWEST: usize = 5;

/// Place at which many members come to rest exactly.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = RestAtom))]
pub struct Atom {
    /// Place, downstream and across [m].
    pub place_m: [f64; 2],
    /// Distance up to which a place is this one [m].
    pub radius_m: f64,
    /// Members that rest there.
    pub members: u64,
    /// Their share of the members with a known place.
    pub share: f64,
}

impl Atom {
    /// True if a place is this one.
    pub(super) fn holds(&self, place_m: [f64; 2]) -> bool {
        let near = |axis: usize| (place_m[axis] - self.place_m[axis]).abs() <= self.radius_m;
        near(0) && near(1)
    }
}

/// Atoms, the most frequent first, and all other places in their order.
pub(super) fn split(places_m: &[[f64; 2]]) -> (Vec<Atom>, Vec<[f64; 2]>) {
    let radius_m = SAME * extent(places_m, 0).max(extent(places_m, 1));
    let least = FEWEST.max((LEAST_SHARE * places_m.len() as f64).ceil() as usize);
    let all: Vec<usize> = (0..places_m.len()).collect();
    let along = groups_along(places_m, all, 0, radius_m).into_iter();
    let groups = along.flat_map(|group| groups_along(places_m, group, 1, radius_m));
    let mut groups: Vec<Vec<usize>> = groups.filter(|group| group.len() >= least).collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    let mut is_other = vec![true; places_m.len()];
    for place in groups.iter().flatten() {
        is_other[*place] = false;
    }
    let others = places_m.iter().zip(is_other).filter(|(_, other)| *other);
    let others = others.map(|(place, _)| *place).collect();
    let atom = |group: &Vec<usize>| Atom {
        place_m: places_m[group[group.len() / 2]],
        radius_m,
        members: group.len() as u64,
        share: group.len() as f64 / places_m.len() as f64,
    };
    (groups.iter().map(atom).collect(), others)
}

/// Distance between the outermost places along an axis.
pub(super) fn extent(places_m: &[[f64; 2]], axis: usize) -> f64 {
    let along = || places_m.iter().map(|place| place[axis]);
    let (low, high) = (along().reduce(f64::min), along().reduce(f64::max));
    high.zip(low).map_or(0.0, |(high, low)| high - low)
}

/// Groups of places, by their indices, whose neighbours along an axis are at most so far apart.
fn groups_along(
    places_m: &[[f64; 2]],
    mut group: Vec<usize>,
    axis: usize,
    distance: f64,
) -> Vec<Vec<usize>> {
    let along = |place: usize| places_m[place][axis];
    group.sort_by(|one, other| along(*one).total_cmp(&along(*other)));
    let near = |one: &usize, other: &usize| along(*other) - along(*one) <= distance;
    group.chunk_by(near).map(<[_]>::to_vec).collect()
}
