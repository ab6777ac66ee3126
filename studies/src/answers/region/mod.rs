//! Regions of resting places: the smallest areas that hold a body with given probabilities.

mod atoms;
mod bandwidth;
mod grid;
mod noise;
mod polygon;
mod resampling;
mod scores;

pub use atoms::Atom;
pub use grid::DensityGrid;
pub use polygon::Polygon;

use super::{Probability, RestingPlaces};
use crate::moments;
use grid::Kernel;
use scores::Scores;
use serde::{Deserialize, Serialize};

/// Seed of the resampling, the same for all studies.
const SEED: u64 = 1;

/// Distribution of a body's resting places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RestDistribution {
    /// Places at which many members come to rest exactly, such as that of a body which the flow
    /// leaves alone; the most frequent first.
    pub atoms: Vec<Atom>,
    /// Density of all other places; none if there are too few.
    pub density: Option<DensityGrid>,
    /// Bandwidths of the density downstream and across [m].
    pub bandwidth_m: Option<[f64; 2]>,
    /// Variance of the density over that with independent draws, from differences between parts
    /// of the members: 1 of independent ones, less of a balanced design.
    pub noise_ratio: Option<f64>,
    /// Regions, in the order in which they were asked for.
    pub regions: Vec<Region>,
    /// Probabilities asked for whose region takes more members.
    pub too_few_members_for: Vec<f64>,
    /// Members whose run ended with the body still moving; their places are unknown.
    pub moving: u64,
    /// Half width of what the cells of the finest level may shift the places by, downstream and
    /// across [m]; none of a study on one level.
    pub numerical_error_m: Option<[f64; 2]>,
}

/// Smallest area that holds a body at rest with a given probability.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Region {
    /// Probability.
    pub probability: f64,
    /// Number of atoms that belong to it, the first in the list.
    pub atoms: usize,
    /// Density at its edge [1/m²]; none if the atoms are enough.
    pub level_per_m2: Option<f64>,
    /// Its outline.
    pub polygons: Vec<Polygon>,
    /// Area within the outline [m²].
    pub area_m2: f64,
    /// Standard error of the area, from resampled members [m²].
    pub area_standard_error_m2: f64,
    /// Probability that the smoothed density has within, atoms included. It differs from the
    /// probability asked for by what the smoothing moves over the edge.
    pub smoothed_probability: f64,
    /// Share of the members within, with bounds that members of unknown place widen.
    pub members: Probability,
}

/// Fit of a density to places that aren't atoms.
struct Fit {
    places_m: Vec<[f64; 2]>,
    kernel: Kernel,
    density: DensityGrid,
    scores: Scores,
    noise: f64,
}

impl RestDistribution {
    /// Distribution of resting places, with regions of given probabilities 0 < p < 1.
    ///
    /// The density is a sum of Gaussian kernels at the members' places (Silverman 1986). A region
    /// is where the density is above a level (Hyndman 1996). The level is a quantile of the
    /// members' leave-one-out densities, since a member's own kernel raises the density at it but
    /// not at a further draw. So of further draws the region holds the probability asked for on
    /// average, whatever the bandwidth.
    pub fn of(places: &RestingPlaces, probabilities: &[f64]) -> Self {
        let (atoms, others) = atoms::split(&places.places_m);
        let fit = Fit::of(others);
        let parts = Parts {
            places,
            atoms: &atoms,
            fit: fit.as_ref(),
        };
        let found: Vec<Option<Region>> = probabilities.iter().map(|p| parts.region(*p)).collect();
        let missing = probabilities
            .iter()
            .zip(&found)
            .filter(|(_, region)| region.is_none());
        Self {
            too_few_members_for: missing.map(|(probability, _)| *probability).collect(),
            regions: found.into_iter().flatten().collect(),
            moving: places.moving,
            numerical_error_m: places
                .levels
                .map(|levels| levels.map(|level| level.numerical)),
            bandwidth_m: fit.as_ref().map(|fit| fit.kernel.bandwidth_m),
            noise_ratio: fit.as_ref().map(|fit| fit.noise),
            density: fit.map(|fit| fit.density),
            atoms,
        }
    }

    /// True if a place lies in one of the regions, by its index in the list.
    pub fn contains(&self, region: usize, place_m: [f64; 2]) -> bool {
        let Some(region) = self.regions.get(region) else {
            return false;
        };
        let atoms = &self.atoms[..region.atoms];
        atoms.iter().any(|atom| atom.holds(place_m))
            || region
                .polygons
                .iter()
                .any(|polygon| polygon.contains(place_m))
    }
}

impl Fit {
    /// Fit to places; none of too few for a region of any probability.
    fn of(places_m: Vec<[f64; 2]>) -> Option<Self> {
        let bandwidth_m = bandwidth::bandwidth(&places_m)?;
        let kernel = Kernel::over(&places_m, bandwidth_m);
        let weights = vec![1.0; places_m.len()];
        let density = kernel.density(&places_m, &weights);
        let noise = noise::ratio(&kernel, &density, &places_m);
        let scores = Scores::of(&kernel, &density, &places_m, &weights, noise);
        Some(Self {
            places_m,
            kernel,
            density,
            scores,
            noise,
        })
    }

    /// Standard error of the area of the region of a probability [m²].
    fn area_error_m2(&self, probability: f64) -> f64 {
        let areas = resampling::areas(&self.kernel, &self.places_m, probability, self.noise);
        (self.noise * moments::variance(&areas)).sqrt()
    }
}

/// What a region is made of.
struct Parts<'a> {
    places: &'a RestingPlaces,
    atoms: &'a [Atom],
    fit: Option<&'a Fit>,
}

impl Parts<'_> {
    /// Region of a probability: the atoms first, whose density is infinite, then of the density
    /// as much as is left; none if the members are too few.
    fn region(&self, probability: f64) -> Option<Region> {
        let mut held = 0.0;
        for (place, atom) in self.atoms.iter().enumerate() {
            held += atom.share;
            if held >= probability {
                return Some(self.of_atoms(probability, place + 1));
            }
        }
        let fit = self.fit?;
        let of_density = (probability - held) / (1.0 - held);
        let level = fit.scores.level(of_density)?;
        let polygons = fit.density.polygons(level);
        let within = fit.density.probability_above(level);
        Some(Region {
            level_per_m2: Some(level),
            area_m2: polygons.iter().map(Polygon::area_m2).sum(),
            area_standard_error_m2: self.fewer_draws().sqrt() * fit.area_error_m2(of_density),
            polygons,
            smoothed_probability: held + (1.0 - held) * within,
            members: self.members_within(self.atoms.len(), Some(level)),
            ..self.of_atoms(probability, self.atoms.len())
        })
    }

    /// Region of the first atoms alone.
    fn of_atoms(&self, probability: f64, atoms: usize) -> Region {
        Region {
            probability,
            atoms,
            level_per_m2: None,
            polygons: Vec::new(),
            area_m2: 0.0,
            area_standard_error_m2: 0.0,
            smoothed_probability: self.atoms[..atoms].iter().map(|atom| atom.share).sum(),
            members: self.members_within(atoms, None),
        }
    }

    fn members_within(&self, atoms: usize, level: Option<f64>) -> Probability {
        let at_atoms: u64 = self.atoms[..atoms].iter().map(|atom| atom.members).sum();
        let above = |fit: &Fit| level.map_or(0, |level| fit.scores.above(level));
        let within = at_atoms + self.fit.map_or(0, above);
        let known = self.places.places_m.len() as u64;
        let members = Probability::of(within, known, self.places.unknown);
        match self.draws() {
            Some(draws) => members.with_draws(draws, [within, within]),
            None => members,
        }
    }

    /// Number of independent draws that places known from several levels are worth.
    fn draws(&self) -> Option<f64> {
        let [downstream, across] = self.places.levels?;
        Some(downstream.draws.min(across.draws))
    }

    /// Members with a known place over the draws that they are worth, at least 1.
    fn fewer_draws(&self) -> f64 {
        let known = self.places.places_m.len() as f64;
        self.draws().map_or(1.0, |draws| (known / draws).max(1.0))
    }
}
