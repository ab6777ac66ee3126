//! Place of a terrain that is nearest to a place in space (docs/method.md, equation 82).

use super::{HeightField, NAME, upward};
use crate::bed::Plane;
use crate::math::Vec3;

/// Steps of a descent at most; few are needed unless the ground is bent as much as the distance.
const STEPS: usize = 40;
/// Halvings of a step that does not come nearer.
const HALVINGS: usize = 12;
/// Length of a step at which a descent ends, over a cell of the map.
const SMALLEST_STEP: f64 = 1e-13;
/// Height up to which the place straight below leads to the nearest one, over a cell of the map:
/// farther away there may be a nearer one beside.
const STRAIGHT: f64 = 0.25;
/// Distance of the other starts, over that of the place below.
const BESIDE: f64 = 0.7;
/// Distances of the other starts of a place behind the surface, over a cell of the map: beside a
/// cliff its face is nearer than the ground straight above.
const BESIDE_BEHIND: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

impl HeightField {
    /// Plane that touches the surface where it is nearest to a place [m]; the height above it is the
    /// distance from the surface, negative below.
    pub fn nearest_plane(&self, place: &Vec3) -> Plane {
        let foot = self.nearest_place(place);
        let up = upward(self.surface().at(foot.x, foot.y).slope);
        let arm = place - foot;
        // Rounding takes the direction of a short arm.
        let is_clear = arm.dot(&up).abs() > 1e-6 * self.surface().cell_size();
        let normal = match is_clear {
            true if self.is_behind(place) => -arm.normalize(),
            true => arm.normalize(),
            false => up,
        };
        Plane {
            name: NAME,
            normal,
            offset: normal.dot(&foot),
            flow_friction: 0.0,
        }
    }

    /// Place of the surface that is nearest to a place [m].
    fn nearest_place(&self, place: &Vec3) -> Vec3 {
        let below = self.descend(place, [place.x, place.y]);
        if self.is_behind(place) {
            return self.nearest_behind(place, below);
        }
        if (place - below).norm() <= STRAIGHT * self.surface().cell_size() {
            return below;
        }
        let height = place.z - self.surface().elevation(place.x, place.y);
        self.nearest_from(place, below, BESIDE * height)
    }

    /// The nearest of a known place of the surface and those that are found from beside a place [m]
    /// behind it.
    fn nearest_behind(&self, place: &Vec3, known: Vec3) -> Vec3 {
        let cell = self.surface().cell_size();
        let rings = BESIDE_BEHIND.into_iter().map(|cells| cells * cell);
        let nearest = rings.fold(known, |nearest, far| {
            if far < (place - nearest).norm() {
                self.nearest_from(place, nearest, far)
            } else {
                nearest
            }
        });
        // Nothing farther aside is nearer; beside the edge of a plateau the face may be, though none of
        // the starts was so near.
        self.nearest_from(place, nearest, (place - nearest).norm())
    }

    /// The nearest of a known place of the surface and those to which ways lead from so far [m]
    /// beside.
    fn nearest_from(&self, place: &Vec3, known: Vec3, far: f64) -> Vec3 {
        let starts = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        let others =
            starts.map(|[x, y]| self.descend(place, [place.x + x * far, place.y + y * far]));
        others.into_iter().fold(known, |nearest, other| {
            if (place - other).norm() < (place - nearest).norm() {
                other
            } else {
                nearest
            }
        })
    }

    fn is_behind(&self, place: &Vec3) -> bool {
        place.z < self.surface().elevation(place.x, place.y)
    }

    /// Place of the surface from which every way leads farther from a place [m], by Newton's method
    /// from (x, y).
    fn descend(&self, place: &Vec3, [x, y]: [f64; 2]) -> Vec3 {
        let cell = self.surface().cell_size();
        let mut foot = self.on_surface(x, y);
        for _ in 0..STEPS {
            let mut step = self.step_from(&foot, place);
            let size = step[0].hypot(step[1]);
            if size > cell {
                step = step.map(|along| along * cell / size);
            }
            let Some(next) = self.nearer(&foot, place, step) else {
                break;
            };
            foot = next;
            if size <= SMALLEST_STEP * cell {
                break;
            }
        }
        foot
    }

    fn on_surface(&self, x: f64, y: f64) -> Vec3 {
        Vec3::new(x, y, self.surface().elevation(x, y))
    }

    /// Place at the end of a step, halved until it is nearer; `None` if none is.
    fn nearer(&self, foot: &Vec3, place: &Vec3, mut step: [f64; 2]) -> Option<Vec3> {
        let now = (place - foot).norm_squared();
        for _ in 0..HALVINGS {
            let next = self.on_surface(foot.x + step[0], foot.y + step[1]);
            if (place - next).norm_squared() < now {
                return Some(next);
            }
            step = step.map(|along| 0.5 * along);
        }
        None
    }

    /// Step of Newton's method towards the least distance; where the distance is not convex, that of
    /// Gauss and Newton, to the nearest place of the plane that touches.
    fn step_from(&self, foot: &Vec3, place: &Vec3) -> [f64; 2] {
        let [sx, sy] = self.surface().at(foot.x, foot.y).slope;
        let [xx, xy, yy] = self.surface().curvature(foot.x, foot.y);
        let above = foot.z - place.z;
        let gradient = [foot.x - place.x + above * sx, foot.y - place.y + above * sy];
        let flat = [1.0 + sx * sx, sx * sy, 1.0 + sy * sy];
        let bent = [
            flat[0] + above * xx,
            flat[1] + above * xy,
            flat[2] + above * yy,
        ];
        let determinant = |of: [f64; 3]| of[0] * of[2] - of[1] * of[1];
        let is_convex = bent[0] > 0.0 && determinant(bent) > 1e-6 * determinant(flat);
        let [a, b, c] = if is_convex { bent } else { flat };
        let size = determinant([a, b, c]);
        [
            (b * gradient[1] - c * gradient[0]) / size,
            (b * gradient[0] - a * gradient[1]) / size,
        ]
    }
}
