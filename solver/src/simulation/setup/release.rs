//! The release: points on a lattice that follows the slope, near equilibrium
//! (docs/method.md, equation 34).

use super::resolution::points_across;
use super::{GivenFlow, Setup, Share, resting_point};
use crate::bed::Bed;
use crate::contact::point_body::PointSphere;
use crate::error::SetupError;
use crate::kernel::Lattice;
use crate::material::Material;
use crate::math::{Mat3, Sym3, Vec3};
use crate::mpm::constitutive::at_rest;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::{MOST_POINTS, ReleaseBox, Scenario};
use crate::shape::Feature;
use crate::walls::Plane;

/// Counts and distances of the release's points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Columns {
    /// Points along, across and up.
    pub count: [u32; 3],
    /// Their distances [m].
    pub spacing: Vec3,
    /// Volume of one point [m³].
    pub volume: f64,
}

impl Columns {
    /// Number of points, including those excluded by a body.
    pub fn points(&self) -> u64 {
        self.count.iter().map(|count| u64::from(*count)).product()
    }

    /// Points of a share of the release that overlap no body, and the volume excluded from the
    /// whole release.
    pub(in crate::simulation) fn release(
        &self,
        scenario: &Scenario,
        given: &Setup,
        bodies: &[Body],
        share: Share,
    ) -> (Vec<Point>, f64) {
        let (Some(release), Some(flow)) = (scenario.release(), &given.flow) else {
            return (Vec::new(), 0.0);
        };
        let bed = given.walls.bed.as_ref();
        let start = Start {
            material: &flow.material,
            gravity: scenario.gravity_m_s2,
            normal: bed.normal(release.back_m, 0.0),
        };
        let mass = flow.material.bulk_density * self.volume;
        let mut left_out = 0.0;
        let [along, across, up] = self.count;
        let rows = share.rows_across(self, given.walls.halves_across());
        // A list that grows would take twice its memory, and the set-up is when most is needed.
        let mut points = Vec::with_capacity(along as usize * rows as usize * up as usize);
        let images = f64::from(across) / f64::from(rows);
        for i in 0..along {
            for j in 0..rows {
                for k in 0..up {
                    let position = self.place([i, j, k], bed, &release);
                    let Some(position) = given.place_beside(position, bodies) else {
                        left_out += self.volume * images;
                        continue;
                    };
                    let id = (i * across + j) * up + k;
                    let depth = release.vertical_thickness_m - self.along(k, 2);
                    let mut point = resting_point(id, position, mass, self.volume);
                    start.press(&mut point, depth);
                    point.position += flow.way_to_bear(&point, bodies);
                    points.push(point);
                }
            }
        }
        (points, left_out)
    }

    fn along(&self, n: u32, axis: usize) -> f64 {
        (f64::from(n) + 0.5) * self.spacing[axis]
    }

    fn place(&self, [i, j, k]: [u32; 3], bed: &dyn Bed, release: &ReleaseBox) -> Vec3 {
        let x = release.back_m + self.along(i, 0);
        let y = self.along(j, 1) - 0.5 * release.width_m;
        Vec3::new(x, y, bed.elevation(x, y) + self.along(k, 2))
    }

    /// True if any place of the release is `among` these, at any position across.
    pub(super) fn any_place(
        &self,
        scenario: &Scenario,
        bed: &dyn Bed,
        among: impl Fn(&Vec3) -> bool,
    ) -> bool {
        let Some(release) = scenario.release() else {
            return false;
        };
        let [along, _, up] = self.count;
        let mut places = (0..along).flat_map(|i| (0..up).map(move |k| [i, 0, k]));
        places.any(|place| among(&self.place(place, bed, &release)))
    }

    /// Columns as close to the given points per cell as whole numbers allow, the volume being
    /// exact: across the channel every cell has the same number.
    pub(in crate::simulation) fn of(
        scenario: &Scenario,
        lattice: &Lattice,
        release: &ReleaseBox,
    ) -> Result<Self, SetupError> {
        let cell = lattice.spacing;
        let per_cell = f64::from(scenario.numerics.points_per_cell);
        let per_cell_across = points_across(&scenario.numerics);
        let in_plane = (cell.x * cell.z * per_cell_across / per_cell).sqrt();
        let across = (release.width_m / cell.y).round() * per_cell_across;
        let length = release.front_m - release.back_m;
        let along = (length / in_plane).round().max(1.0);
        let up = (release.vertical_thickness_m / in_plane).round().max(1.0);
        let points = along * across * up;
        if points > MOST_POINTS as f64 {
            return Err(SetupError::TooManyPoints {
                points: points as u64,
                limit: MOST_POINTS,
                cell_size_m: cell.x,
            });
        }
        let spacing = Vec3::new(
            length / along,
            release.width_m / across,
            release.vertical_thickness_m / up,
        );
        Ok(Self {
            count: [along, across, up].map(|count| count as u32),
            spacing,
            volume: spacing.product(),
        })
    }
}

/// Distance from a body's surface, over a point's stand-off, above which a point is not moved:
/// a lattice that the surface fits is left as it is.
const CLOSE: f64 = 0.98;

impl Setup {
    /// Position of a point of the release near bodies: unchanged, or at its stand-off from a
    /// surface that is nearer, or from a face that is nearer than a spacing; `None` inside a body
    /// or without room. The excluded volume is thereby that of the bodies, and no face that cuts
    /// the lattice starts with a gap that the flow would first have to close. Round a vertex or an
    /// edge points would cluster.
    pub(super) fn place_beside(&self, position: Vec3, bodies: &[Body]) -> Option<Vec3> {
        let spacing = self.flow.as_ref()?.sphere.spacing;
        // Position of the continuum's surface: at rest the contacts carry the pressure there.
        let stand_off = 0.5 * spacing;
        let mut place = position;
        for body in bodies {
            let Some(Surface {
                feature,
                distance,
                normal,
            }) = surface_within(spacing, body, &place)
            else {
                continue;
            };
            if distance < 0.0 {
                return None;
            }
            let has_gap = distance > stand_off / CLOSE && matches!(feature, Feature::Face(_));
            if has_gap || distance < CLOSE * stand_off {
                place += normal * (stand_off - distance);
            }
        }
        let beside = |body: &Body| body.distance_to(&place) >= CLOSE * stand_off;
        let between = |plane: &Plane| {
            let height = plane.height(&place);
            height >= stand_off.min(plane.height(&position)) * CLOSE
        };
        let walls = self.rigid_walls().planes_at(&place);
        let has_room =
            place == position || (bodies.iter().all(beside) && walls.iter().all(between));
        has_room.then_some(place)
    }
}

/// Largest displacement of a point of the release by which its contact carries its stress
/// [point spacings]; a deeper overlap is intended.
const FARTHEST: f64 = 0.1;

impl GivenFlow {
    /// Displacement [m] of a point in contact with a body to the place where the contact carries
    /// the point's stress. The stand-off holds for the mean pressure of the flow; without this,
    /// bodies would exert that pressure at first, at any depth and in any direction.
    pub(super) fn way_to_bear(&self, point: &Point, bodies: &[Body]) -> Vec3 {
        let PointSphere { radius, spacing } = self.sphere;
        let mut touched = bodies
            .iter()
            .filter_map(|body| surface_within(radius, body, &point.position));
        // Between two bodies no position satisfies both.
        let (Some(surface), None) = (touched.next(), touched.next()) else {
            return Vec3::zeros();
        };
        let Surface {
            distance, normal, ..
        } = surface;
        let pressed = (-normal.dot(&(point.stress.matrix() * normal))).max(0.0);
        let load = pressed * spacing.powi(2);
        let overlap = (load / self.contact_law(0.0, 0.0).stiffness).powf(2.0 / 3.0);
        let way = normal * (radius - overlap - distance);
        if way.norm() <= FARTHEST * spacing {
            way
        } else {
            Vec3::zeros()
        }
    }
}

/// Surface of a body near a place.
struct Surface {
    /// Nearest feature.
    feature: Feature,
    /// Distance [m]; negative inside.
    distance: f64,
    /// Unit vector towards the place.
    normal: Vec3,
}

/// Surface of a body if a place is nearer to it than `reach` [m].
fn surface_within(reach: f64, body: &Body, place: &Vec3) -> Option<Surface> {
    let arm = body.to_body(&(place - body.state.position));
    if arm.norm() > body.shape.bounding_radius() + reach {
        return None;
    }
    let closest = body.shape.closest_feature(&arm);
    let distance = closest.distance - body.shape.sphero_radius();
    (distance < reach).then(|| Surface {
        feature: closest.feature,
        distance,
        normal: body.to_world(&closest.normal),
    })
}

/// Initial stress of a slope at rest.
pub(super) struct Start<'a> {
    pub(super) material: &'a Material,
    pub(super) gravity: f64,
    /// Normal of the bed under the release.
    pub(super) normal: Vec3,
}

impl Start<'_> {
    /// Sets the stress of a point at a vertical depth [m] in an infinite slope, with no more shear
    /// than it can bear.
    pub(super) fn press(&self, point: &mut Point, depth: f64) {
        let (sin, cos) = (self.normal.xy().norm(), self.normal.z);
        let density = self.material.bulk_density;
        let normal_stress = density * self.gravity * depth * cos * cos;
        let shear_stress = density * self.gravity * depth * cos * sin;
        let lateral = self.lateral_ratio();
        let normal = self.normal;
        let ahead = self.normal.xy().try_normalize(0.0).unwrap_or_default();
        let down = Vec3::new(cos * ahead.x, cos * ahead.y, -sin);
        let across = normal * normal.transpose();
        let stress = across * -normal_stress
            - (Mat3::identity() - across) * (lateral * normal_stress)
            + (down * normal.transpose() + normal * down.transpose()) * shear_stress;
        let pressure = (1.0 + 2.0 * lateral) * normal_stress / 3.0;
        point.stress = at_rest(self.material, &Sym3::of(&stress).deviator(), pressure);
        point.volume = point.mass / self.material.density(pressure);
    }

    /// Lateral over vertical stress of an elastic bed, ν/(1 − ν).
    fn lateral_ratio(&self) -> f64 {
        let (k, g) = (self.material.bulk_modulus, self.material.shear_modulus);
        (3.0 * k - 2.0 * g) / (3.0 * k + 4.0 * g)
    }
}
