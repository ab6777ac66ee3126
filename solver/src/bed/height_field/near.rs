//! Features of a body near the ground: core vertices against the surface, and nodes of the terrain
//! against faces and edges (docs/method.md, equations 82 and 83).
//!
//! A plane face can touch ground between its vertices only where the ground bulges upwards. So
//! nodes are looked at there alone: on a plane or in a hollow a body meets the terrain by its
//! vertices, as it meets a wall.

use super::HeightField;
use crate::bed::Plane;
use crate::math::Vec3;
use crate::shape::SpheroPolyhedron;
use nalgebra::UnitQuaternion;

/// Largest distance of neighbouring nodes, over the side of a cell of the height map: two in
/// each piece of the surface.
const NODES_PER_CELL: f64 = 2.0;
/// Nodes across a body: at least, and at most.
const NODES_PER_BODY: [f64; 2] = [4.0, 16.0];
/// Height of a bulge under a body, over its sphero radius, below which it is level.
const LEVEL: f64 = 1e-3;
/// Distance beyond what is asked that is looked at, over the body's bounding radius: a body
/// moves that far before it is looked at again.
const AHEAD: f64 = 0.25;

/// A body's shape in its place.
#[derive(Debug, Clone, Copy)]
pub struct PlacedSolid<'a> {
    /// Shape.
    pub shape: &'a SpheroPolyhedron,
    /// Centre of mass [m].
    pub position: Vec3,
    /// Body frame to world.
    pub orientation: UnitQuaternion<f64>,
}

/// Feature by which a body and the ground meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum GroundFeature {
    /// A core vertex of the body.
    Vertex(usize),
    /// A node of the terrain, by its indices.
    Node([i32; 2]),
}

/// A place of a body's core near the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundPlace {
    /// Feature by which they meet.
    pub feature: GroundFeature,
    /// The place, from the centre of mass [m].
    pub arm: Vec3,
    /// Unit normal of the contact, out of the ground.
    pub normal: Vec3,
    /// Distance from the ground [m]; negative inside it.
    pub height: f64,
}

/// Features of a body near the ground, and the pose for which they were found.
#[derive(Debug, Clone, Default)]
pub struct NearGround {
    found: Option<Found>,
    features: Vec<GroundFeature>,
    /// Distance of neighbouring nodes [m].
    spacing: f64,
}

#[derive(Debug, Clone, Copy)]
struct Found {
    position: Vec3,
    orientation: UnitQuaternion<f64>,
    /// Every feature nearer to the ground than this was found [m].
    reach: f64,
}

impl NearGround {
    /// Looks for the features nearer than `reach` [m], unless they are known.
    pub fn look(&mut self, solid: &PlacedSolid, ground: &HeightField, reach: f64) {
        if self.reach(solid) < reach {
            self.search(solid, ground, reach + AHEAD * solid.shape.bounding_radius());
        }
    }

    /// Distance from the ground up to which every feature is known [m]; negative if none is.
    pub fn reach(&self, solid: &PlacedSolid) -> f64 {
        let Some(found) = &self.found else {
            return f64::NEG_INFINITY;
        };
        let shifted = (solid.position - found.position).norm();
        let turned = solid.orientation.angle_to(&found.orientation);
        // No place of a body moves farther.
        found.reach - shifted - turned * solid.shape.bounding_radius()
    }

    fn search(&mut self, solid: &PlacedSolid, ground: &HeightField, reach: f64) {
        let nodes = NodesUnder::of(solid, ground);
        self.spacing = nodes.spacing;
        self.found = Some(Found {
            position: solid.position,
            orientation: solid.orientation,
            reach,
        });
        self.features.clear();
        let clear = solid.clear_of(ground);
        if clear >= reach {
            self.found.iter_mut().for_each(|found| found.reach = clear);
            return;
        }
        let vertices = (0..solid.shape.core_vertices().len()).map(GroundFeature::Vertex);
        let features = vertices.chain(nodes.bulging(solid, ground, reach));
        let near = features.filter(|feature| {
            let place = solid.meet(ground, *feature, nodes.spacing);
            place.height < reach
        });
        self.features.extend(near);
    }

    /// The places that it found, where they are now.
    pub fn places<'a>(
        &'a self,
        solid: &'a PlacedSolid,
        ground: &'a HeightField,
    ) -> impl Iterator<Item = GroundPlace> + 'a {
        let meet = |feature: &GroundFeature| solid.meet(ground, *feature, self.spacing);
        self.features.iter().map(meet)
    }

    /// The overlaps with the ground, each with its depth [m].
    pub fn overlaps(&self, solid: &PlacedSolid, ground: &HeightField) -> Vec<(GroundPlace, f64)> {
        let radius = solid.shape.sphero_radius();
        let overlaps = self
            .places(solid, ground)
            .map(|place| (place, radius - place.height));
        overlaps.filter(|(_, overlap)| *overlap > 0.0).collect()
    }
}

impl PlacedSolid<'_> {
    /// Lower bound of its distance from the ground [m], up to its bounding diameter.
    fn clear_of(&self, ground: &HeightField) -> f64 {
        let radius = self.shape.bounding_radius();
        let [x, y] = [self.position.x, self.position.y];
        // Beside what is looked at, ground is farther away than the bound.
        let beside = 3.0 * radius;
        let (highest, steepest) =
            (ground.surface()).bounds([x - beside, y - beside], [x + beside, y + beside]);
        let over = (self.position.z - radius - highest) / 1f64.hypot(steepest);
        over.min(beside - radius)
    }

    /// Least distance of its surface from the ground [m], negative inside, and how far it falls until
    /// the feature that is there touches a plane [m].
    fn gap_to(&self, ground: &HeightField) -> [f64; 2] {
        let radius = self.shape.sphero_radius();
        let mut near = NearGround::default();
        near.look(self, ground, 2.0 * self.shape.bounding_radius());
        let gaps = near.places(self, ground).map(|place| {
            let gap = place.height - radius;
            [gap, gap / place.normal.z.max(0.1)]
        });
        let apart = self.shape.bounding_radius();
        gaps.min_by(|one, other| one[0].total_cmp(&other[0]))
            .unwrap_or([apart; 2])
    }

    /// Place at which it meets the ground by a feature.
    fn meet(&self, ground: &HeightField, feature: GroundFeature, spacing: f64) -> GroundPlace {
        match feature {
            GroundFeature::Vertex(vertex) => {
                let arm = self.orientation * self.shape.core_vertices()[vertex];
                let place = self.position + arm;
                let plane = ground.nearest_plane(&place);
                GroundPlace {
                    feature,
                    arm,
                    normal: plane.normal,
                    height: plane.height(&place),
                }
            }
            GroundFeature::Node(index) => {
                let node = node_at(ground, index, spacing) - self.position;
                let seen = self.orientation.inverse_transform_vector(&node);
                let closest = self.shape.closest_feature(&seen);
                let outward = self.orientation * closest.normal;
                GroundPlace {
                    feature,
                    arm: node - outward * closest.distance,
                    normal: -outward,
                    height: closest.distance,
                }
            }
        }
    }
}

/// Position of a node of the terrain [m].
fn node_at(ground: &HeightField, index: [i32; 2], spacing: f64) -> Vec3 {
    let [x, y] = index.map(|along| f64::from(along) * spacing);
    Vec3::new(x, y, ground.surface().at(x, y).elevation)
}

/// Nodes of the terrain in the shadow of a body.
struct NodesUnder {
    spacing: f64,
    /// First and last indices along x and y.
    first: [i32; 2],
    last: [i32; 2],
}

impl NodesUnder {
    fn of(solid: &PlacedSolid, ground: &HeightField) -> Self {
        let radius = solid.shape.bounding_radius();
        let [most, least] = NODES_PER_BODY.map(|nodes| 2.0 * radius / nodes);
        let spacing = (ground.surface().cell_size() / NODES_PER_CELL)
            .min(most)
            .max(least);
        let index = |axis: usize, side: f64| (solid.position[axis] + side * radius) / spacing;
        Self {
            spacing,
            first: [0, 1].map(|axis| index(axis, -1.0).floor() as i32),
            last: [0, 1].map(|axis| index(axis, 1.0).ceil() as i32),
        }
    }

    /// Nodes where the ground bulges, as near the body as they can be within `reach` [m]; none of a
    /// ball, which has nothing but its vertex.
    fn bulging<'a>(
        &'a self,
        solid: &'a PlacedSolid,
        ground: &'a HeightField,
        reach: f64,
    ) -> impl Iterator<Item = GroundFeature> + 'a {
        let radius = solid.shape.bounding_radius();
        // A sagitta of half the body's width squared over twice the radius of curvature.
        let level = 2.0 * LEVEL * solid.shape.sphero_radius() / (radius * radius);
        let nodes = (self.first[1]..=self.last[1])
            .flat_map(move |j| (self.first[0]..=self.last[0]).map(move |i| [i, j]));
        let has_edges = solid.shape.core_vertices().len() > 1;
        let bulging = nodes.filter(move |_| has_edges).filter(move |index| {
            let node = node_at(ground, *index, self.spacing);
            (node - solid.position).norm() < radius + reach
                && ground.surface().bulge(node.x, node.y) > level
        });
        bulging.map(GroundFeature::Node)
    }
}

/// Places along each axis at which the slope under a body is averaged.
const UNDER: usize = 5;
/// Rounds in which a body is lowered to the ground; a plane takes two.
const ROUNDS: usize = 80;

impl HeightField {
    /// Rotation that lays a horizontal body flat on the mean slope within a distance [m] of
    /// (x, y), without a turn about the normal.
    pub fn tilt_over(&self, x: f64, y: f64, distance: f64) -> UnitQuaternion<f64> {
        let mut slope = [0.0; 2];
        for n in 0..UNDER * UNDER {
            let [u, v] = [n % UNDER, n / UNDER].map(|n| {
                distance
                    * (2.0 * n as f64 / (UNDER - 1) as f64 - 1.0)
                    * std::f64::consts::FRAC_1_SQRT_2
            });
            let here = self.surface().at(x + u, y + v).slope;
            slope = [slope[0] + here[0], slope[1] + here[1]];
        }
        let normal = super::upward(slope.map(|sum| sum / (UNDER * UNDER) as f64));
        UnitQuaternion::rotation_between(&Vec3::z(), &normal).unwrap_or_default()
    }

    /// Plane that touches the ground where a body in its place is nearest to it.
    pub fn plane_under(&self, solid: &PlacedSolid) -> Option<Plane> {
        let mut near = NearGround::default();
        near.look(solid, self, 2.0 * solid.shape.sphero_radius());
        let places = near.places(solid, self);
        let nearest = places.min_by(|one, other| one.height.total_cmp(&other.height))?;
        let place = solid.position + nearest.arm;
        Some(Plane {
            name: super::NAME,
            normal: nearest.normal,
            offset: nearest.normal.dot(&place) - nearest.height,
            flow_friction: 0.0,
        })
    }

    /// Elevation [m] of the centre at (x, y) of a body in this orientation that touches the ground.
    pub fn lowest_centre(
        &self,
        shape: &SpheroPolyhedron,
        orientation: UnitQuaternion<f64>,
        x: f64,
        y: f64,
    ) -> f64 {
        let reach = shape.bounding_radius();
        let (highest, _) = (self.surface()).bounds([x - reach, y - reach], [x + reach, y + reach]);
        // The higher a body, the farther it is from the ground.
        let mut low = self.surface().elevation(x, y) - reach;
        let mut high = highest + reach;
        let mut elevation = high;
        for _ in 0..ROUNDS {
            let solid = PlacedSolid {
                shape,
                position: Vec3::new(x, y, elevation),
                orientation,
            };
            let [gap, fall] = solid.gap_to(self);
            if gap < 0.0 {
                low = low.max(elevation);
            } else {
                high = high.min(elevation);
            }
            let next = elevation - fall;
            if (next - elevation).abs() <= 1e-14 * (1.0 + elevation.abs()) {
                break;
            }
            elevation = if low < next && next < high {
                next
            } else {
                0.5 * (low + high)
            };
        }
        elevation
    }
}
