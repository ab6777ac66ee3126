//! Initial placement of bodies and release according to the scenario.

use super::sliding_block::SlidingBlock;
use super::{Body, Channel, Ground, Place, Release, Scenario, Source, Terrain};
use crate::bed::{Bed, HeightField, PlanarBed};
use crate::shape::SpheroPolyhedron;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};
use std::ops::Range;

/// Position and orientation of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre of mass [m].
    pub position: Vector3<f64>,
    /// Turns body axes into those of the ground.
    pub orientation: UnitQuaternion<f64>,
}

impl Pose {
    /// The pose as a rigid motion from body to channel coordinates.
    pub fn isometry(&self) -> Isometry3<f64> {
        Isometry3::from_parts(Translation3::from(self.position), self.orientation)
    }
}

/// Initial support of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Support {
    /// It rests on the horizontal floor.
    Floor,
    /// It rests on the incline.
    Incline,
    /// It rests on the terrain.
    Terrain,
    /// Its elevation is given: it may be in contact or not.
    Free,
}

/// The released volume: between two vertical planes across the whole channel,
/// from the bed up to a surface parallel to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReleaseBox {
    /// Downstream coordinate of the back face [m].
    pub back_m: f64,
    /// Downstream coordinate of the front face [m].
    pub front_m: f64,
    /// Thickness along z [m]: the release height over cos θ.
    pub vertical_thickness_m: f64,
    /// Width, the channel's [m].
    pub width_m: f64,
}

impl ReleaseBox {
    /// Horizontal distance of the front from the back [m].
    pub fn length_m(&self) -> f64 {
        self.front_m - self.back_m
    }
}

impl Channel {
    /// Inclination of the inclined part \[rad\].
    pub fn inclination_rad(&self) -> f64 {
        self.inclination_deg.to_radians()
    }

    /// Its bed.
    pub fn bed(&self) -> PlanarBed {
        PlanarBed::channel(self.inclination_rad(), self.base_friction)
    }

    /// Speed [m/s] that a flow may reach under this gravity [m/s²]: the back of the release sliding
    /// to the foot against base friction, and the release collapsing, as energies (docs/method.md,
    /// equation 31).
    pub(crate) fn fastest_flow(
        &self,
        (volume, release): (f64, &Release),
        gravity_m_s2: f64,
    ) -> f64 {
        let block = SlidingBlock::of(self, (volume, release), gravity_m_s2);
        let collapsing = || (gravity_m_s2 * release.height_m).sqrt();
        block.map_or_else(collapsing, |block| block.fastest())
    }

    /// Box of a released volume [m³].
    pub(super) fn release_box(&self, volume: f64, release: &Release) -> ReleaseBox {
        let vertical_thickness_m = release.height_m / self.inclination_rad().cos();
        let front_m = -release.toe_distance_m;
        let length = volume / (vertical_thickness_m * self.width_m);
        ReleaseBox {
            back_m: front_m - length,
            front_m,
            vertical_thickness_m,
            width_m: self.width_m,
        }
    }
}

impl Body {
    /// True if loads move it.
    pub fn is_free(&self) -> bool {
        !self.fixed && self.motion.is_none()
    }

    /// Speed of the fastest place of a body of this bounding radius [m] at the start, or at any
    /// time of its prescribed motion [m/s], its turning included.
    pub fn thrown_m_s(&self, bounding_radius: f64) -> f64 {
        if let Some(motion) = &self.motion {
            return motion.prescribed().fastest(bounding_radius);
        }
        let spin = Vector3::from(self.angular_velocity_rad_s).norm();
        Vector3::from(self.velocity_m_s).norm() + spin * bounding_radius
    }

    /// Orientation at the start: as given, or flat on the bed under the centre and turned by the
    /// yaw about its normal.
    fn initial_orientation(
        &self,
        tilt: impl FnOnce() -> UnitQuaternion<f64>,
    ) -> UnitQuaternion<f64> {
        if let Some([w, x, y, z]) = self.orientation {
            // Unit already (ensured by the parser), so its bits are kept.
            return UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        }
        let yaw = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw_deg.to_radians());
        let tilt = tilt();
        // Zeros keep their signs.
        if tilt == UnitQuaternion::identity() {
            yaw
        } else {
            tilt * yaw
        }
    }

    /// Pose at the start; without an elevation the body is lowered until it
    /// touches the bed under its centre.
    pub(super) fn pose(&self, shape: &SpheroPolyhedron, channel: &Channel) -> Pose {
        let [x, y] = self.position.place.coordinates();
        let orientation = self.initial_orientation(|| channel.bed().tilt(x, y));
        let bed = channel.bed().tangent(x, y);
        let elevation = self.position.elevation_m.unwrap_or_else(|| {
            let below = orientation.inverse_transform_vector(&-bed.normal);
            bed.lowest_centre(shape.extent_along(&below), x, y)
        });
        Pose {
            position: Vector3::new(x, y, elevation),
            orientation,
        }
    }

    /// Pose at the start on a terrain; without an elevation the body lies flat on the mean slope
    /// under it, lowered until it touches.
    pub(super) fn pose_on(
        &self,
        shape: &SpheroPolyhedron,
        terrain: &Terrain,
        ground: &HeightField,
    ) -> Pose {
        let [x, y] = terrain.to_local(self.position.place.coordinates());
        let radius = shape.bounding_radius();
        let orientation = self.initial_orientation(|| ground.tilt_over(x, y, radius));
        let elevation = match self.position.elevation_m {
            Some(elevation) => terrain.to_local_elevation(elevation),
            None => ground.lowest_centre(shape, orientation, x, y),
        };
        Pose {
            position: Vector3::new(x, y, elevation),
            orientation,
        }
    }
}

impl Scenario {
    /// The bed; a terrain as it is for the scenario's cells.
    pub fn bed(&self) -> Box<dyn Bed> {
        match &self.ground {
            Ground::Channel(channel) => Box::new(channel.bed()),
            Ground::Terrain(terrain) => Box::new(terrain.ground(self.cell_size_m())),
        }
    }

    /// Extents of the ground along x and y [m].
    ///
    /// # Panics
    /// If the scenario has a terrain and was read without its maps.
    pub fn extents(&self) -> [Range<f64>; 2] {
        match &self.ground {
            Ground::Channel(channel) => {
                let half = 0.5 * channel.width_m;
                [
                    -channel.incline_length_m..channel.runout_length_m,
                    -half..half,
                ]
            }
            Ground::Terrain(terrain) => terrain.extent().map(|extent| 0.0..extent),
        }
    }

    /// Initial position and orientation of a body.
    ///
    /// # Panics
    /// If there is no such body, or the scenario did not come from the parser.
    pub fn initial_pose(&self, body: usize) -> Pose {
        self.poses_of(body..body + 1).remove(0)
    }

    /// Initial positions and orientations of all bodies.
    ///
    /// # Panics
    /// If the scenario did not come from the parser.
    pub fn initial_poses(&self) -> Vec<Pose> {
        self.poses_of(0..self.bodies.len())
    }

    fn poses_of(&self, bodies: Range<usize>) -> Vec<Pose> {
        let each = bodies.map(|body| (&self.bodies[body], self.shape_of(body)));
        match &self.ground {
            Ground::Channel(channel) => each
                .map(|(body, shape)| body.pose(&shape, channel))
                .collect(),
            Ground::Terrain(terrain) => {
                let ground = terrain.ground(self.cell_size_m());
                each.map(|(body, shape)| body.pose_on(&shape, terrain, &ground))
                    .collect()
            }
        }
    }

    /// Initial support of a body.
    ///
    /// # Panics
    /// If there is no such body.
    pub fn support_of(&self, body: usize) -> Support {
        let position = &self.bodies[body].position;
        match (position.elevation_m, position.place) {
            (Some(_), _) => Support::Free,
            (None, Place::OnTerrain { .. }) => Support::Terrain,
            (None, Place::InChannel { downstream_m, .. }) if downstream_m < 0.0 => Support::Incline,
            (None, Place::InChannel { .. }) => Support::Floor,
        }
    }

    /// Solid of a body.
    ///
    /// # Panics
    /// If there is no such body, or the scenario did not come from the parser,
    /// which refuses dimensions that make no solid.
    pub fn shape_of(&self, body: usize) -> SpheroPolyhedron {
        let built = self.bodies[body].build();
        built.expect("the parser refuses dimensions that make no solid")
    }

    /// Box of the flow's release in a channel; `None` if there is none, or none of it.
    pub fn release(&self) -> Option<ReleaseBox> {
        let channel = self.channel()?;
        match &self.flow.as_ref()?.source {
            Source::Channel { volume_m3, release } if *volume_m3 > 0.0 => {
                Some(channel.release_box(*volume_m3, release))
            }
            Source::Channel { .. } | Source::Terrain { .. } => None,
        }
    }
}
