//! Initial placement of bodies and release according to the scenario.

use super::sliding_block::SlidingBlock;
use super::{Body, Channel, Flow, Position, Scenario};
use crate::bed::{Bed, PlanarBed};
use crate::shape::SpheroPolyhedron;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion, Vector3};

/// Position and orientation of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre of mass [m].
    pub position: Vector3<f64>,
    /// Turns body axes into channel axes.
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
    pub fn fastest_flow(&self, flow: &Flow, gravity_m_s2: f64) -> f64 {
        let block = SlidingBlock::of(self, flow, gravity_m_s2);
        let collapsing = || (gravity_m_s2 * flow.release.height_m).sqrt();
        block.map_or_else(collapsing, |block| block.fastest())
    }

    /// Box of a flow's release.
    pub(super) fn release_box(&self, flow: &Flow) -> ReleaseBox {
        let vertical_thickness_m = flow.release.height_m / self.inclination_rad().cos();
        let front_m = -flow.release.toe_distance_m;
        let length = flow.volume_m3 / (vertical_thickness_m * self.width_m);
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

    /// Orientation at the start: as given, or flat on the bed under the centre
    /// and turned by the yaw about its normal.
    fn initial_orientation(&self, channel: &Channel) -> UnitQuaternion<f64> {
        if let Some([w, x, y, z]) = self.orientation {
            // Unit already (ensured by the parser), so its bits are kept.
            return UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
        }
        let yaw = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.yaw_deg.to_radians());
        let [x, y] = self.position.in_plane();
        let tilt = channel.bed().tilt(x, y);
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
        let orientation = self.initial_orientation(channel);
        let [x, y] = self.position.in_plane();
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
}

impl Position {
    /// Its place in the plane: downstream and lateral [m].
    fn in_plane(&self) -> [f64; 2] {
        [self.downstream_m, self.lateral_m]
    }
}

impl Scenario {
    /// The bed.
    pub fn bed(&self) -> impl Bed {
        self.channel.bed()
    }

    /// Initial position and orientation of a body.
    ///
    /// # Panics
    /// If there is no such body, or the scenario did not come from the parser.
    pub fn initial_pose(&self, body: usize) -> Pose {
        self.bodies[body].pose(&self.shape_of(body), &self.channel)
    }

    /// Initial support of a body.
    ///
    /// # Panics
    /// If there is no such body.
    pub fn support_of(&self, body: usize) -> Support {
        let position = &self.bodies[body].position;
        match position.elevation_m {
            Some(_) => Support::Free,
            None if position.downstream_m < 0.0 => Support::Incline,
            None => Support::Floor,
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

    /// Box of the flow's release; `None` if there is none, or none of it.
    pub fn release(&self) -> Option<ReleaseBox> {
        let flow = self.flow.as_ref().filter(|flow| flow.volume_m3 > 0.0)?;
        Some(self.channel.release_box(flow))
    }
}
