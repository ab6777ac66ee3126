//! A body on a terrain (docs/method.md, equations 82 and 83).

use crate::bed::{GroundFeature, HeightField, NearGround};
use crate::contact::friction::Spring;
use crate::contact::wall_touch::WallTouch;
use crate::rigid::{Body, BodyState};

/// Distance from the sphere-swept body that is always known, over its bounding radius: far more
/// than it moves in a sub-step.
const KNOWN: f64 = 0.1;

/// Puts every overlap with the ground into `touches`, in the order of their springs; returns the
/// energy of the springs of nodes that it has left [J].
pub(super) fn find_on_ground(
    body: &mut Body,
    ground: &HeightField,
    touches: &mut Vec<WallTouch>,
) -> f64 {
    let radius = body.shape.sphero_radius();
    let mut near = std::mem::take(&mut body.near_ground);
    let known = radius + KNOWN * body.shape.bounding_radius();
    near.look(&body.placed(), ground, known);
    let mut overlaps = near.overlaps(&body.placed(), ground);
    overlaps.sort_unstable_by_key(|(place, _)| place.feature);
    let nodes = overlaps
        .iter()
        .filter_map(|(place, _)| match place.feature {
            GroundFeature::Node(index) => Some(index),
            GroundFeature::Vertex(_) => None,
        });
    let vertices = body.shape.core_vertices().len();
    let lost = follow_nodes(&mut body.state, vertices, nodes.collect());
    body.near_ground = near;
    touches.clear();
    let mut next_node = vertices;
    for (place, overlap) in overlaps {
        let index = match place.feature {
            GroundFeature::Vertex(vertex) => vertex,
            GroundFeature::Node(_) => {
                next_node += 1;
                next_node - 1
            }
        };
        touches.push(WallTouch {
            place: index,
            arm: place.arm - place.normal * (radius - 0.5 * overlap),
            normal: place.normal,
            overlap,
            mass: body.mass,
            force: 0.0,
        });
    }
    lost
}

/// Gives the springs of nodes that it still touches to their new places, and new ones to others;
/// returns the energy of those that it has left [J].
fn follow_nodes(state: &mut BodyState, vertices: usize, nodes: Vec<[i32; 2]>) -> f64 {
    let mut lost = 0.0;
    if nodes == state.ground_nodes {
        return lost;
    }
    for springs in [&mut state.springs, &mut state.rolling] {
        if springs.is_empty() {
            continue;
        }
        let mut before: Vec<Spring> = springs.drain(vertices.min(springs.len())..).collect();
        for node in &nodes {
            let known = state.ground_nodes.iter().position(|known| known == node);
            let known = known.and_then(|place| before.get_mut(place));
            springs
                .push(known.map_or(Spring::NEW, |spring| std::mem::replace(spring, Spring::NEW)));
        }
        lost += before.iter().map(Spring::energy).sum::<f64>();
    }
    state.ground_nodes = nodes;
    lost
}

/// Deepest overlap of the body with the ground [m]; negative when apart, and −infinite if it is
/// farther than `within` [m].
pub(super) fn deepest_on_ground(body: &Body, ground: &HeightField, within: f64) -> f64 {
    let (placed, radius) = (body.placed(), body.shape.sphero_radius());
    let deepest = |near: &NearGround| {
        let overlaps = near
            .places(&placed, ground)
            .map(|place| radius - place.height);
        overlaps.fold(f64::NEG_INFINITY, f64::max)
    };
    if body.near_ground.reach(&placed) >= radius + within {
        return deepest(&body.near_ground);
    }
    let mut near = NearGround::default();
    near.look(&placed, ground, radius + within);
    deepest(&near)
}

/// Lower bound of the body's distance from the ground [m], as far as it is known; negative if it
/// touches.
pub fn ground_gap(body: &Body, ground: &HeightField) -> f64 {
    let placed = body.placed();
    let known = body.near_ground.reach(&placed);
    let heights = body.near_ground.places(&placed, ground);
    let least = heights.map(|place| place.height).fold(known, f64::min);
    least - body.shape.sphero_radius()
}
