//! Guards that end a run that has gone wrong (docs/method.md, section 10). They do not change a
//! run that goes well.

use super::Simulation;
use super::flow::{Bounds, OffendingPoint};
use crate::contact::point_body::PenetratingPoint;
use crate::error::{Mover, StepError};
use crate::method::METHOD;
use crate::rigid::Body;

/// Bounds of a run, known at its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guards {
    /// Speed of a fall from the highest place and the fastest throw [m/s].
    pub speed_given: f64,
    /// True if the energy is bounded: not where gravity drives a periodic flow.
    pub energy: bool,
}

impl Guards {
    /// Guards of a scene with unknown speeds.
    pub const ANY_SPEED: Self = Self {
        speed_given: f64::INFINITY,
        energy: false,
    };

    /// Guards of a run in which things fall from `highest` [m] at most, under `gravity`
    /// [m/s²], and bodies start with `thrown` [m/s] at most, their turning included.
    pub fn of(gravity: f64, highest: f64, thrown: f64) -> Self {
        let given = 2.0 * gravity * highest + thrown * thrown;
        Self {
            speed_given: given.sqrt(),
            energy: true,
        }
    }
}

impl Simulation {
    /// Checks that the body sub-steps were as short as required.
    pub(super) fn look_at_body_steps(&self, substep_s: f64) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        let reports = self.scratch.body_reports.iter().enumerate();
        let asked = reports.map(|(body, report)| (body, report.substeps_asked));
        let mut too_many =
            asked.filter(|(_, asked)| asked.is_nan() || *asked > METHOD.body_step.most);
        let Some((body, asked)) = too_many.next() else {
            return Ok(());
        };
        // A non-finite state requires no number of steps.
        Err(match self.state.bodies[body].non_finite() {
            Some(quantity) => StepError::NonFiniteBody {
                time_s,
                body,
                quantity,
            },
            None => StepError::BodyStepCollapse {
                time_s,
                body,
                substep_s,
                asked,
                limit: METHOD.body_step.most,
            },
        })
    }

    /// Checks bodies and points after a step.
    pub(super) fn look_for_culprits(
        &self,
        stuck: Option<&PenetratingPoint>,
    ) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        for (body, state) in self.state.bodies.iter().enumerate() {
            if let Some(quantity) = state.non_finite() {
                return Err(StepError::NonFiniteBody {
                    time_s,
                    body,
                    quantity,
                });
            }
        }
        self.look_behind_walls()?;
        self.look_for_merging_bodies()?;
        self.look_at_points()?;
        self.look_at_speeds()?;
        let radius = self.point_radius_m();
        match stuck.filter(|stuck| stuck.depth > radius) {
            None => Ok(()),
            Some(stuck) => Err(StepError::PointInsideBody {
                time_s,
                point: stuck.point,
                body: stuck.body,
                depth_m: stuck.depth,
            }),
        }
    }

    fn look_at_points(&self) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        let material = self.given.flow.as_ref().map(|flow| flow.material);
        let densest = material.map_or(f64::INFINITY, |material| material.densest());
        let bounds = Bounds {
            walls: self.given.rigid_walls(),
            tolerance: self.given.lattice.spacing.max(),
            densest,
        };
        match self.state.flow.offending_point(&bounds) {
            None => Ok(()),
            Some(OffendingPoint::NonFinite { point, quantity }) => Err(StepError::NonFinitePoint {
                time_s,
                point,
                quantity,
            }),
            Some(OffendingPoint::Crushed { point, density }) => Err(StepError::Crushed {
                time_s,
                point,
                density_kg_m3: density,
                limit_kg_m3: densest,
            }),
            Some(OffendingPoint::BehindWall {
                point,
                wall,
                depth_m,
            }) => Err(StepError::PointBehindWall {
                time_s,
                point,
                wall,
                depth_m,
            }),
        }
    }

    /// Checks that nothing is faster than the bound.
    fn look_at_speeds(&self) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        let limit = METHOD.guards.faster * self.given.guards.speed_given;
        let check = |mover, speed_m_s, limit_m_s| {
            if speed_m_s <= limit_m_s {
                return Ok(());
            }
            Err(StepError::SpeedRunaway {
                time_s,
                mover,
                speed_m_s,
                limit_m_s,
            })
        };
        for (place, body) in self.state.bodies.iter().enumerate() {
            let speed = body.largest_speed();
            if speed > limit {
                check(Mover::Body(place), speed, self.fastest_possible(body))?;
            }
        }
        if self.state.flow.fastest() <= limit {
            return Ok(());
        }
        let (point, speed) = self.fastest_point();
        check(point, speed, limit)
    }

    /// Largest speed [m/s] that a body's fastest place may reach: a light one among heavy ones may
    /// get all their energy, which is that of their mass at the given speed, and the work that
    /// prescribed motions have done.
    fn fastest_possible(&self, body: &Body) -> f64 {
        let given = self.given.guards.speed_given;
        let wide = METHOD.guards.faster * given;
        if !body.is_free() {
            return wide;
        }
        let free = self.state.bodies.iter().filter(|body| body.is_free());
        let mass: f64 = free.map(|body| body.mass).sum();
        let twice_energy = mass * given * given + 2.0 * self.state.audit.work_given().max(0.0);
        (twice_energy / body.least_effective_mass())
            .sqrt()
            .max(wide)
    }

    /// Checks after an audit that the mechanical energy has not risen.
    pub(super) fn look_at_energy(&self) -> Result<(), StepError> {
        let audit = &self.state.audit;
        let limit_j = METHOD.guards.energy_made * audit.energy_scale();
        if !self.given.guards.energy || audit.energy_rise() <= limit_j {
            return Ok(());
        }
        let (mover, speed_m_s) = self.fastest_mover();
        Err(StepError::EnergyRunaway {
            time_s: self.state.clock.time,
            rise_j: audit.energy_rise(),
            limit_j,
            mover,
            speed_m_s,
        })
    }

    /// Checks that no body's contacts made energy.
    pub(super) fn look_at_body_energies(&self) -> Result<(), StepError> {
        let free = self.state.bodies.iter().enumerate();
        for (place, body) in free.filter(|(_, body)| body.is_free()) {
            let energy = &self.state.energies[place];
            let limit_j = METHOD.guards.body_energy_made * energy.scale(body, &self.given.gravity);
            if self.given.guards.energy && energy.rise() > limit_j {
                return Err(StepError::BodyEnergyMade {
                    time_s: self.state.clock.time,
                    body: place,
                    made_j: energy.rise(),
                    limit_j,
                });
            }
        }
        Ok(())
    }

    /// The fastest point or body, and its speed [m/s].
    fn fastest_mover(&self) -> (Mover, f64) {
        let bodies = self.state.bodies.iter().enumerate();
        let speeds = bodies.map(|(place, body)| (Mover::Body(place), body.largest_speed()));
        speeds.fold(self.fastest_point(), faster)
    }

    /// The fastest point, and its speed [m/s]; the first body at rest if there is none.
    fn fastest_point(&self) -> (Mover, f64) {
        let mut fastest = (Mover::Body(0), 0.0);
        self.state.flow.visit(None, &mut |point| {
            fastest = faster(fastest, (Mover::Point(point.id), point.velocity.norm()));
        });
        fastest
    }

    /// Checks that no body's core is behind a wall, where its contacts can't hold it.
    fn look_behind_walls(&self) -> Result<(), StepError> {
        let time_s = self.state.clock.time;
        for (place, body) in self.state.bodies.iter().enumerate() {
            let walls = self.given.rigid_walls();
            for plane in walls.planes {
                let deepest = body.shape.extent_along(&body.to_body(&-plane.normal));
                let core =
                    plane.height(&body.state.position) - deepest + body.shape.sphero_radius();
                if body.is_free() && core < 0.0 {
                    return Err(StepError::BodyBehindWall {
                        time_s,
                        body: place,
                        wall: plane.name,
                        depth_m: -core,
                    });
                }
            }
            let height = walls.terrain.map(|ground| {
                let plane = ground.nearest_plane(&body.state.position);
                (plane.height(&body.state.position), plane.name)
            });
            if let Some((height, wall)) =
                height.filter(|(height, _)| body.is_free() && *height < 0.0)
            {
                return Err(StepError::BodyBehindWall {
                    time_s,
                    body: place,
                    wall,
                    depth_m: -height,
                });
            }
        }
        Ok(())
    }

    /// Checks that no two cores have merged, where their contacts would push in the wrong
    /// direction.
    fn look_for_merging_bodies(&self) -> Result<(), StepError> {
        for contact_pair in &self.state.contact_pairs {
            let [body, other] = contact_pair.bodies;
            let radius = |place: usize| self.state.bodies[place].shape.sphero_radius();
            if contact_pair.deepest > METHOD.guards.deepest_overlap * (radius(body) + radius(other))
            {
                return Err(StepError::BodiesMerge {
                    time_s: self.state.clock.time,
                    body,
                    other,
                    overlap_m: contact_pair.deepest,
                });
            }
        }
        Ok(())
    }
}

/// The faster of two, the first if they are equally fast.
fn faster(one: (Mover, f64), other: (Mover, f64)) -> (Mover, f64) {
    if other.1 > one.1 { other } else { one }
}
