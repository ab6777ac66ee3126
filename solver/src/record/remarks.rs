//! Remarks on an outcome: what happened, in words.

use super::{BodyOutcome, FlowOutcome};
use crate::math::Vec3;
use crate::plan::names;
use crate::simulation::Outlet;

/// Outcome and end of a run, as far as the remarks tell of them.
pub(super) struct Seen<'a> {
    pub(super) bodies: &'a [BodyOutcome],
    /// True of each body that is free to move.
    pub(super) free: Vec<bool>,
    /// The flow, with its released mass [kg]; `None` without one.
    pub(super) flow: Option<(&'a FlowOutcome, f64)>,
    /// Open ends, where flow leaves.
    pub(super) outlet: Outlet,
    /// Simulated time at the end of the run [s].
    pub(super) ended_s: f64,
    /// True if the run ended because nothing moved any more; `None` if it was to go on
    /// for its whole duration.
    pub(super) at_rest: Option<bool>,
}

impl Seen<'_> {
    /// Sentences about bodies, flow and end of the run.
    pub(super) fn remarks(&self) -> Vec<String> {
        let remarks = [
            self.not_reached(),
            self.not_moved(),
            self.came_to_rest(),
            self.still_moving(),
            self.left_the_map(),
            self.outflow(),
            self.end(),
        ];
        remarks.into_iter().flatten().collect()
    }

    /// Names of the bodies of which this holds.
    fn which(&self, holds: impl Fn(usize, &BodyOutcome) -> bool) -> Option<String> {
        let bodies = self.bodies.iter().enumerate();
        let found = bodies.filter(|(place, body)| holds(*place, body));
        let found: Vec<usize> = found.map(|(place, _)| place).collect();
        (!found.is_empty()).then(|| names(&found))
    }

    fn not_reached(&self) -> Option<String> {
        self.flow?;
        let missed = self.which(|_, body| body.first_contact_time_s.is_none())?;
        Some(format!(
            "the flow had not reached {missed} when the run ended, at {}",
            time(self.ended_s)
        ))
    }

    fn not_moved(&self) -> Option<String> {
        let stayed = self.which(|place, body| {
            self.free[place] && body.first_contact_time_s.is_some() && body.onset_time_s.is_none()
        })?;
        Some(format!("the flow reached {stayed} without moving it away"))
    }

    fn came_to_rest(&self) -> Option<String> {
        let rests = |place: usize, body: &BodyOutcome| {
            self.free[place] && body.onset_time_s.is_some() && body.stop_time_s.is_some()
        };
        let which = self.which(rests)?;
        let bodies = self.bodies.iter().enumerate();
        let rested = bodies.filter(|(place, body)| rests(*place, body));
        let stops = rested.filter_map(|(_, body)| body.stop_time_s.zip(Some(body.displacement_m)));
        let (last, farthest) = stops.fold((0.0f64, 0.0f64), |(last, farthest), (stop, way)| {
            (last.max(stop), farthest.max(way))
        });
        let (last, farthest) = (time(last), short(farthest));
        Some(if which.starts_with("bodies") {
            format!(
                "{which} came to rest, the last at {last}, at most {farthest} m from their starts"
            )
        } else {
            format!("{which} came to rest at {last}, {farthest} m from its start")
        })
    }

    fn still_moving(&self) -> Option<String> {
        let moving = self.which(|place, body| {
            self.free[place] && body.onset_time_s.is_some() && body.stop_time_s.is_none()
        })?;
        Some(format!(
            "{moving} still moved when the run ended, at {}",
            time(self.ended_s)
        ))
    }

    fn outflow(&self) -> Option<String> {
        let (flow, released) = self.flow.filter(|(flow, _)| flow.outflow_mass_kg > 0.0)?;
        let share = 100.0 * flow.outflow_mass_kg / released;
        let way = match self.outlet {
            Outlet::End(_) => "through the open end",
            Outlet::Edges(_) => "over the edges of the height map",
        };
        Some(format!("{} % of the flow left {way}", short(share)))
    }

    fn left_the_map(&self) -> Option<String> {
        let is_terrain = matches!(self.outlet, Outlet::Edges(_));
        let beyond = |body: &BodyOutcome| self.outlet.is_beyond(&Vec3::from(body.final_position_m));
        let which = self.which(|_, body| is_terrain && beyond(body))?;
        Some(format!(
            "{which} left the height map: beyond its edges the ground is made up, and so is what \
             happened there"
        ))
    }

    fn end(&self) -> Option<String> {
        let ended = time(self.ended_s);
        Some(if self.at_rest? {
            format!("all was at rest at {ended}, and the run ended there")
        } else {
            format!(
                "the run ended at its duration, {ended}, before all was seen to be at rest: a \
                 longer duration_s may change the answer"
            )
        })
    }
}

fn time(seconds: f64) -> String {
    format!("{} s", short(seconds))
}

/// Three significant digits.
fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 9.0);
    format!("{value:.*}", digits as usize)
}
