//! Front of a flow: how far it has come, downstream in a channel, and on a terrain from the middles
//! of its releases.

use crate::math::Vec3;
use crate::simulation::{Division, PreparedScene, Simulation};
use serde::{Deserialize, Serialize};

/// Share of the mass beyond the front in a channel.
const FRONT_SHARE: f64 = 1e-3;
/// The same on a terrain, where the flow spreads to all sides: single points far out are no front.
const FRONT_SHARE_ON_TERRAIN: f64 = 0.01;

/// Measure of a front.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum FrontMeasure {
    /// Along x in a channel.
    Downstream {
        /// x of the release's toe [m]; `None` without one.
        toe: Option<f64>,
        /// x of the open end [m].
        end: f64,
    },
    /// Horizontal distance on a terrain: the largest reach of a release, and how far a place is
    /// beyond the circle round the release that it is least beyond. With one release that is the
    /// distance from its middle.
    Around {
        /// Circles round the releases.
        circles: Vec<Circle>,
        /// Largest reach [m].
        reach: f64,
    },
}

/// Circle round a release.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Circle {
    /// Middle of the release [m].
    middle: [f64; 2],
    /// Distance of its farthest place [m].
    reach: f64,
}

impl Circle {
    /// Circle round a release, by its places and the thickness there [m].
    fn round(places: impl Iterator<Item = ([f64; 2], f64)> + Clone) -> Self {
        let (mut middle, mut whole) = ([0.0; 2], 0.0);
        for (place, thickness) in places.clone() {
            whole += thickness;
            middle = [0, 1].map(|axis| middle[axis] + thickness * place[axis]);
        }
        let middle = middle.map(|sum| sum / f64::max(whole, f64::MIN_POSITIVE));
        let circle = Self { middle, reach: 0.0 };
        let distances = places.map(|(place, _)| circle.beyond(place));
        Self {
            reach: distances.fold(0.0, f64::max),
            ..circle
        }
    }

    /// Distance of a place beyond it [m]; negative inside.
    fn beyond(&self, place: [f64; 2]) -> f64 {
        (place[0] - self.middle[0]).hypot(place[1] - self.middle[1]) - self.reach
    }
}

impl FrontMeasure {
    /// Measure of a scene's front.
    pub(super) fn of(prepared: &PreparedScene) -> Self {
        let scenario = &prepared.scenario;
        if let Some(channel) = scenario.channel() {
            return Self::Downstream {
                toe: scenario.release().map(|release| release.front_m),
                end: channel.runout_length_m,
            };
        }
        let columns = prepared.division.as_ref().and_then(Division::on_terrain);
        let releases = columns.into_iter().flat_map(|columns| columns.releases());
        let circles: Vec<Circle> = releases.map(Circle::round).collect();
        let reaches = circles.iter().map(|circle| circle.reach);
        let reach = reaches.fold(0.0, f64::max);
        Self::Around { circles, reach }
    }

    /// Distance of a place [m].
    pub(super) fn of_place(&self, place: &Vec3) -> f64 {
        match self {
            Self::Downstream { .. } => place.x,
            Self::Around { circles, reach } => {
                let beyond = circles
                    .iter()
                    .map(|circle| circle.beyond([place.x, place.y]));
                reach + beyond.fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// Reach of the release [m]; `None` without one.
    pub(super) fn toe(&self) -> Option<f64> {
        match self {
            Self::Downstream { toe, .. } => *toe,
            Self::Around { reach, .. } => Some(*reach),
        }
    }

    /// Share of the mass beyond it.
    fn share(&self) -> f64 {
        match self {
            Self::Downstream { .. } => FRONT_SHARE,
            Self::Around { .. } => FRONT_SHARE_ON_TERRAIN,
        }
    }

    /// Distance beyond which that share of the released mass lies [m]; that of the open end of
    /// a channel once that much has left, and unknown once that much has left a terrain.
    pub(super) fn front(&self, simulation: &Simulation) -> Option<f64> {
        self.front_of(simulation, &self.places(simulation))
    }

    /// Distance of each point [m], and its mass with that of its images [kg].
    pub(super) fn places(&self, simulation: &Simulation) -> Vec<(f64, f64)> {
        let mut places = Vec::with_capacity(simulation.computed_points());
        simulation.visit_computed_points(|point, mass| {
            places.push((self.of_place(&point.position), mass));
        });
        places
    }

    /// The front by which a run's end is judged: where it is unknown, that of what has stayed on the
    /// terrain.
    pub(super) fn front_of_rest(
        &self,
        simulation: &Simulation,
        places: &[(f64, f64)],
    ) -> Option<f64> {
        self.front_of(simulation, places).or_else(|| {
            let audit = simulation.audit();
            let stayed = audit.released_mass - audit.outflow_mass();
            beyond(places, simulation.point_spacing_m(), self.share() * stayed)
        })
    }

    /// The front if each point (with its images' mass, in kg) were this far [m].
    pub(super) fn front_of(&self, simulation: &Simulation, places: &[(f64, f64)]) -> Option<f64> {
        let audit = simulation.audit();
        let wanted = self.share() * audit.released_mass - audit.outflow_mass();
        if audit.released_mass <= 0.0 {
            return None;
        }
        if wanted <= 0.0 {
            return match self {
                Self::Downstream { end, .. } => Some(*end),
                Self::Around { .. } => None,
            };
        }
        beyond(places, simulation.point_spacing_m(), wanted)
    }
}

/// The x beyond which this mass [kg] lies, each point's (at x, mass in kg) spread evenly
/// over `spacing` [m]: the front may lie within a point.
fn beyond(places: &[(f64, f64)], spacing: f64, wanted: f64) -> Option<f64> {
    // Mass per metre that begins or ends at each x, going upstream [kg/m].
    let ends = places.iter().flat_map(|&(x, mass)| {
        let density = mass / spacing;
        [(x + 0.5 * spacing, density), (x - 0.5 * spacing, -density)]
    });
    let mut ends: Vec<(f64, f64)> = ends.collect();
    ends.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    let (mut last, mut density, mut mass) = (f64::INFINITY, 0.0, 0.0);
    for (x, change) in ends {
        let passed = if density > 0.0 {
            density * (last - x)
        } else {
            0.0
        };
        if mass + passed >= wanted {
            return Some(last - (wanted - mass) / density);
        }
        mass += passed;
        density += change;
        last = x;
    }
    None
}

#[cfg(test)]
mod tests;
