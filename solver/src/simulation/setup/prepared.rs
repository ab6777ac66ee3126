//! A checked scenario with all that is known of its run before the set-up.

use super::bodies::bodies;
use super::resolution::{self, Crowd};
use super::{Division, Reductions, Scene, Setup};
use crate::error::SetupError;
use crate::rigid::Body;
use crate::scenario::Scenario;

/// A scenario and its scene, the points apart. Made once, it serves the check at submission, the
/// plan, the recorder and the simulation.
#[derive(Debug)]
pub struct PreparedScene {
    /// The scenario.
    pub scenario: Scenario,
    /// Constant set-up.
    pub given: Setup,
    /// The bodies at the start.
    pub bodies: Vec<Body>,
    /// Division of the release into points; `None` without a flow.
    pub division: Option<Division>,
    /// Reductions of the computation.
    pub reductions: Reductions,
}

impl PreparedScene {
    /// The scene of a scenario, with the reductions of its numerics.
    ///
    /// # Errors
    /// Too many points for one run, or a reduction that the scene does not allow.
    pub fn of(scenario: &Scenario) -> Result<Self, SetupError> {
        let mut prepared = Self::whole(scenario)?;
        prepared.reductions = Reductions::of(
            scenario,
            &prepared.given,
            prepared.division.as_ref().and_then(Division::in_channel),
            &prepared.bodies,
        )?;
        prepared.reductions.confine(&mut prepared.bodies);
        Ok(prepared)
    }

    /// The scene of a scenario that is computed as a whole, whatever the scenario says.
    ///
    /// # Errors
    /// Too many points for one run.
    pub fn whole(scenario: &Scenario) -> Result<Self, SetupError> {
        let crowd = Crowd::of(scenario);
        let expected = resolution::expected(scenario, &crowd);
        let (given, division) = Setup::of(scenario, expected)?;
        Ok(Self {
            scenario: scenario.clone(),
            bodies: bodies(scenario, &given, &crowd, &expected),
            given,
            division,
            reductions: Reductions::none(),
        })
    }

    /// Cell size [m], automatic or given.
    pub fn cell_size_m(&self) -> f64 {
        self.given.lattice.spacing.x
    }

    /// √(K/ρ) [m/s], automatic or given; `None` without a flow.
    pub fn sound_speed_m_s(&self) -> Option<f64> {
        let flow = self.given.flow.as_ref();
        flow.map(|flow| flow.limits.sound_speed)
    }

    /// The whole scene, with its points.
    pub fn scene(self) -> Scene {
        let share = self.reductions.first_share();
        let (points, volume_left_out) = match &self.division {
            Some(division) => division.start(&self.scenario, &self.given, &self.bodies, share),
            None => (Vec::new(), 0.0),
        };
        Scene {
            given: self.given,
            bodies: self.bodies,
            points,
            precision: self.scenario.numerics.precision,
            volume_left_out,
            shares: self.reductions.shares,
        }
    }
}
