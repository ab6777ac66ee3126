//! Features of two cores that may touch, listed once for several body sub-steps (a neighbour list
//! with a margin, Verlet 1967).

use super::segments::distance_of;
use super::separation::{Corners, Gap};
use crate::math::Vec3;
use crate::rigid::Body;

/// Margin of the list over the sum of the sphero radii: features that are farther apart than both
/// are not listed.
const MARGIN: f64 = 0.1;

/// Features of two cores that may touch while the bodies come nearer by no more than a margin.
#[derive(Debug, Default)]
pub(super) struct NearFeatures {
    /// Vertices of each core, by their numbers.
    pub(super) vertices: [Vec<usize>; 2],
    /// Pairs of edges, in the order of the first's and then of the second's.
    pub(super) edges: Vec<EdgePair>,
    /// Edges of each core that may touch.
    near_edges: [Vec<NearEdge>; 2],
    /// Distance by which the bodies may still come nearer [m]; 0 or less if nothing is listed.
    margin: f64,
}

/// An edge of the first core and one of the second.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgePair {
    /// Their numbers.
    pub(super) numbers: [usize; 2],
    /// The vertices at the ends of each.
    pub(super) ends: [[usize; 2]; 2],
}

/// An edge that may touch the other core.
#[derive(Debug, Clone, Copy)]
struct NearEdge {
    number: usize,
    ends: [usize; 2],
    bounds: Bounds,
}

impl NearFeatures {
    /// True if all features that may touch are listed.
    pub(super) fn are_listed(&self) -> bool {
        self.margin > 0.0
    }

    /// Distance by which the bodies may come nearer before a feature that is not listed touches [m].
    pub(super) fn margin(&self) -> f64 {
        self.margin
    }

    /// Uses up the margin for bodies that come nearer by at most `by` [m].
    pub(super) fn approach(&mut self, by: f64) {
        self.margin -= by;
    }

    /// Lists the features of two bodies with these core vertices and this gap.
    pub(super) fn list(&mut self, bodies: [&Body; 2], corners: &Corners, gap: &Gap) {
        let radii = bodies.map(|body| body.shape.sphero_radius());
        let margin = MARGIN * (radii[0] + radii[1]);
        let reach = radii[0] + radii[1] + margin;
        // Features farther than `reach` from the beginning of the other core, in the direction of
        // the gap or along an axis, can't touch.
        let Gap {
            direction,
            first_to,
            second_from,
            ..
        } = gap;
        let on_first = |x: &Vec3| second_from - direction.dot(x) < reach;
        let on_second = |x: &Vec3| direction.dot(x) - first_to < reach;
        self.list_of(0, bodies, corners, reach, on_first);
        self.list_of(1, bodies, corners, reach, on_second);
        let places = |which: usize, ends: &[usize; 2]| ends.map(|end| corners[which][end]);
        self.edges.clear();
        for first in &self.near_edges[0] {
            let reached = first.bounds.grown(reach);
            let on_first = places(0, &first.ends);
            for second in &self.near_edges[1] {
                let near = || distance_of(&on_first, &places(1, &second.ends)) < reach;
                if reached.meets(&second.bounds) && near() {
                    self.edges.push(EdgePair {
                        numbers: [first.number, second.number],
                        ends: [first.ends, second.ends],
                    });
                }
            }
        }
        self.margin = margin;
    }

    /// Lists the vertices and edges of one of the two that are within reach of the other core.
    fn list_of(
        &mut self,
        which: usize,
        bodies: [&Body; 2],
        corners: &Corners,
        reach: f64,
        in_reach: impl Fn(&Vec3) -> bool,
    ) {
        let own = &corners[which];
        let centres = [
            Vec3::zeros(),
            bodies[1].state.position - bodies[0].state.position,
        ];
        let (body, other) = (bodies[which], bodies[1 - which]);
        let reached = Bounds::of(&corners[1 - which]).grown(reach);
        let distance = |place: &Vec3| {
            let from_other = place - centres[1 - which];
            other
                .shape
                .closest_feature(&other.to_body(&from_other))
                .distance
        };
        self.vertices[which].clear();
        let vertices = own.iter().enumerate().filter(|(_, place)| {
            in_reach(place) && reached.meets(&Bounds::of(&[**place])) && distance(place) < reach
        });
        self.vertices[which].extend(vertices.map(|(number, _)| number));
        let edges = body.shape.edges().enumerate();
        let edges = edges.map(|(number, edge)| NearEdge {
            number,
            ends: edge.vertices,
            bounds: Bounds::of(&edge.vertices.map(|vertex| own[vertex])),
        });
        self.near_edges[which].clear();
        self.near_edges[which].extend(edges.filter(|edge| {
            edge.ends.iter().any(|&end| in_reach(&own[end])) && reached.meets(&edge.bounds)
        }));
    }
}

/// An axis-aligned box.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    fn of(places: &[Vec3]) -> Self {
        let start = Vec3::repeat(f64::INFINITY);
        Self {
            low: places.iter().fold(start, |low, x| low.inf(x)),
            high: places.iter().fold(-start, |high, x| high.sup(x)),
        }
    }

    fn grown(mut self, by: f64) -> Self {
        self.low -= Vec3::repeat(by);
        self.high += Vec3::repeat(by);
        self
    }

    /// True if another box overlaps this one.
    fn meets(&self, other: &Self) -> bool {
        (0..3).all(|axis| other.low[axis] < self.high[axis] && other.high[axis] > self.low[axis])
    }
}
