//! Place of a terrain that is nearest to a place in space (docs/method.md, equation 82).

use super::{HeightField, NAME, upward};
use crate::bed::Plane;
use crate::math::Vec3;
use crate::method::METHOD;

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
/// Directions of a place in each of which the nearest steep ground is a start: a face may be nearer than
/// the place straight below, and none of the other starts lead to it.
const DIRECTIONS: usize = 8;
/// Distance up to which steep ground is looked for, in cells of the map.
const FARTHEST: f64 = 64.0;

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
        let height = place.z - self.surface().elevation(place.x, place.y);
        let is_straight = (place - below).norm() <= STRAIGHT * self.surface().cell_size();
        let nearest = if height > 0.0 && !is_straight {
            self.nearest_from(place, below, BESIDE * height)
        } else {
            below
        };
        self.nearest_on_faces(place, nearest)
    }

    /// The nearest of a known place of the surface and those to which ways lead from steep ground round
    /// a place [m].
    fn nearest_on_faces(&self, place: &Vec3, known: Vec3) -> Vec3 {
        let far = (place - known).norm();
        let far = far.min(FARTHEST * self.surface().cell_size());
        let mut starts = [None; DIRECTIONS];
        let steep = METHOD.boundary.steep;
        let corners = [-far, far].map(|by| [place.x + by, place.y + by]);
        self.surface().visit_steep(corners, steep, |[x, y]| {
            let (east, north) = (x - place.x, y - place.y);
            let away = east.hypot(north);
            let turn = 0.5 + 0.5 * north.atan2(east) / std::f64::consts::PI;
            let start = &mut starts[(turn * DIRECTIONS as f64) as usize % DIRECTIONS];
            if start.is_none_or(|(nearest, _)| away < nearest) {
                *start = Some((away, [x, y]));
            }
        });
        let others = starts.into_iter().flatten();
        others.fold(known, |nearest, (_, start)| {
            nearer_of(place, nearest, self.descend(place, start))
        })
    }

    /// The nearest of a known place of the surface and those to which ways lead from so far [m]
    /// beside.
    fn nearest_from(&self, place: &Vec3, known: Vec3, far: f64) -> Vec3 {
        let starts = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        let others =
            starts.map(|[x, y]| self.descend(place, [place.x + x * far, place.y + y * far]));
        others
            .into_iter()
            .fold(known, |nearest, other| nearer_of(place, nearest, other))
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

/// The nearer of two places, the first if they are as near.
fn nearer_of(place: &Vec3, one: Vec3, other: Vec3) -> Vec3 {
    if (place - other).norm() < (place - one).norm() {
        other
    } else {
        one
    }
}
