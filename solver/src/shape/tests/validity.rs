//! Refused shapes.

use super::{SpheroPolyhedron, prism, tetrahedron};
use crate::shape::{ConvexPolyhedron, ShapeError};
use nalgebra::Vector3;

#[test]
fn the_topology_of_a_prism() {
    let (vertices, loops) = prism(7);
    let solid = ConvexPolyhedron::new(vertices, loops).unwrap();
    assert_eq!(
        (
            solid.vertices().len(),
            solid.edges().len(),
            solid.faces().len()
        ),
        (14, 21, 9)
    );
    for edge in solid.edges() {
        let ends = edge.vertices.map(|v| solid.vertices()[v]);
        assert!((ends[0] + edge.direction * edge.length - ends[1]).norm() < 1e-15);
        for face in edge.faces {
            let face = &solid.faces()[face];
            assert!(edge.vertices.iter().all(|v| face.vertices.contains(v)));
        }
    }
    // Interior angles: 90° where a wall meets an end, 5/7 π between walls.
    let right = solid
        .edges()
        .iter()
        .filter(|e| (e.interior_dihedral.to_degrees() - 90.0).abs() < 1e-9);
    assert_eq!(right.count(), 14);
    let obtuse = 180.0 * 5.0 / 7.0;
    let wall = solid
        .edges()
        .iter()
        .filter(|e| (e.interior_dihedral.to_degrees() - obtuse).abs() < 1e-9);
    assert_eq!(wall.count(), 7);
}

#[test]
fn a_cube_needs_room_for_its_rounding() {
    assert!(matches!(
        SpheroPolyhedron::cube(0.04, 0.02),
        Err(ShapeError::RadiusNotBelowInradius {
            radius_m: 0.02,
            inradius_m: 0.02
        })
    ));
    assert!(SpheroPolyhedron::cube(0.04, 0.0).is_err());
    assert!(SpheroPolyhedron::cube(f64::NAN, 0.01).is_err());
    assert!(SpheroPolyhedron::cube(0.04, f64::INFINITY).is_err());
}

#[test]
fn solids_that_are_none() {
    let (vertices, loops) = tetrahedron();
    let build =
        |v: &[Vector3<f64>], l: &[Vec<usize>]| ConvexPolyhedron::new(v.to_vec(), l.to_vec());

    let inside_out: Vec<Vec<usize>> = loops
        .iter()
        .map(|l| l.iter().rev().copied().collect())
        .collect();
    assert!(matches!(
        build(&vertices, &inside_out),
        Err(ShapeError::NotConvex { .. })
    ));

    let mut one_flipped = loops.clone();
    one_flipped[2].reverse();
    assert!(matches!(
        build(&vertices, &one_flipped),
        Err(ShapeError::EdgeNotShared { .. })
    ));

    assert!(matches!(
        build(&vertices, &loops[..3]),
        Err(ShapeError::TooFew { .. })
    ));

    let mut stray = vertices.clone();
    stray.push(Vector3::zeros());
    assert!(matches!(
        build(&stray, &loops),
        Err(ShapeError::NotABall { .. })
    ));

    let mut missing = loops.clone();
    missing[0][0] = 9;
    assert!(matches!(
        build(&vertices, &missing),
        Err(ShapeError::BadLoop { face: 0 })
    ));

    let mut broken = vertices.clone();
    broken[1].y = f64::NAN;
    assert!(matches!(
        build(&broken, &loops),
        Err(ShapeError::NotFinite { vertex: 1 })
    ));

    let flat: Vec<Vector3<f64>> = vertices
        .iter()
        .map(|v| Vector3::new(v.x, v.y, 0.0))
        .collect();
    assert!(build(&flat, &loops).is_err());
    let point = vec![Vector3::zeros(); 4];
    assert!(matches!(
        build(&point, &loops),
        Err(ShapeError::BadFace { .. })
    ));

    let (mut dented, faces) = prism(4);
    dented[6] *= 0.5;
    assert!(build(&dented, &faces).is_err());
}

#[test]
fn coplanar_neighbours_must_be_one_face() {
    let (vertices, mut loops) = prism(4);
    let top = loops[1].clone();
    loops[1] = vec![top[0], top[1], top[2]];
    loops.push(vec![top[0], top[2], top[3]]);
    assert!(matches!(
        ConvexPolyhedron::new(vertices, loops),
        Err(ShapeError::NotConvex { .. })
    ));
}
