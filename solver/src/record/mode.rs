//! Mode of a body's motion.

use super::Mode;
use super::means::Means;
use crate::math::Vec3;
use crate::rigid::{Body, Freedom};

/// Share of the time on walls and other bodies below which a body saltates.
const SUPPORTED_SHARE: f64 = 0.5;
/// Share of the weight borne by the flow above which it carries a body.
const CARRIED_SHARE: f64 = 0.5;

/// Quantities of a body's motion at a sample time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Movement<'a> {
    /// True if it is at rest.
    pub(super) at_rest: bool,
    /// True if it rolls, provided that it is on a wall or body.
    pub(super) rolls: bool,
    /// Loads on it since the last sample.
    pub(super) means: &'a Means,
    /// Its weight along the normal of the bed, which points up [N].
    pub(super) weight: Vec3,
}

/// The mode of a body with this movement.
pub(super) fn mode(body: &Body, movement: &Movement) -> Mode {
    let means = movement.means;
    if body.freedom == Freedom::Fixed || movement.at_rest {
        Mode::Resting
    } else if is_carried(means, &movement.weight) {
        Mode::Carried
    } else if !is_supported(body, means) {
        Mode::Saltating
    } else if movement.rolls {
        Mode::Rolling
    } else {
        Mode::Sliding
    }
}

/// True if the flow bears enough of a body's weight, and more than walls and other bodies do.
fn is_carried(means: &Means, weight: &Vec3) -> bool {
    let borne = |impulse: &Vec3| means.mean(impulse).dot(weight) / weight.norm_squared();
    let flow = borne(&means.flow.force);
    let solid = borne(&means.wall.force) + borne(&means.bodies.force);
    flow >= CARRIED_SHARE && flow > solid
}

fn is_supported(body: &Body, means: &Means) -> bool {
    if means.duration == 0.0 {
        return body.is_supported();
    }
    means.supported >= SUPPORTED_SHARE * means.duration
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::Load;
    use crate::rigid::fixture::cuboid;

    /// Means over a second of a body of 1 N, supported for this share of it, its weight borne by
    /// flow and walls in these shares.
    fn acted(supported: f64, [flow, walls]: [f64; 2]) -> Means {
        let up = |force: f64| Load {
            force: Vec3::z() * force,
            torque: Vec3::zeros(),
        };
        Means {
            duration: 1.0,
            supported,
            flow: up(flow),
            wall: up(walls),
            ..Means::default()
        }
    }

    fn mode_of(at_rest: bool, rolls: bool, means: &Means) -> Mode {
        let weight = Vec3::z();
        let movement = Movement {
            at_rest,
            rolls,
            means,
            weight,
        };
        mode(&cuboid([0.04; 3]), &movement)
    }

    #[test]
    fn modes_tell_what_bears_a_body_and_how_it_moves_on_it() {
        let (walls, flow) = (acted(1.0, [0.0, 1.0]), acted(0.2, [0.9, 0.1]));
        assert_eq!(mode_of(true, true, &walls), Mode::Resting);
        assert_eq!(mode_of(false, false, &walls), Mode::Sliding);
        assert_eq!(mode_of(false, true, &walls), Mode::Rolling);
        assert_eq!(mode_of(false, true, &flow), Mode::Carried);
        // Pushed along the floor, pressed onto it, and hit in flight.
        assert_eq!(
            mode_of(false, false, &acted(0.9, [0.4, 0.6])),
            Mode::Sliding
        );
        assert_eq!(
            mode_of(false, false, &acted(0.9, [-2.0, 3.0])),
            Mode::Sliding
        );
        assert_eq!(
            mode_of(false, true, &acted(0.4, [0.1, 0.4])),
            Mode::Saltating
        );
        assert_eq!(
            mode_of(false, false, &acted(0.0, [0.0, 0.0])),
            Mode::Saltating
        );
    }

    #[test]
    fn what_is_fixed_rests() {
        let mut body = cuboid([0.04; 3]);
        body.freedom = Freedom::Fixed;
        let movement = Movement {
            at_rest: false,
            rolls: true,
            means: &acted(0.0, [5.0, 0.0]),
            weight: Vec3::z(),
        };
        assert_eq!(mode(&body, &movement), Mode::Resting);
    }
}
