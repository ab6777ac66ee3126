//! Tests of a point's rebound, of the energy of damping, and of the force along a path.

use super::*;

// With the restitution e a lone point that strikes a fixed body rebounds at e times its speed;
// the effective mass of the grid with one point is the point's own.
#[test]
fn a_point_rebounds_as_asked() {
    for restitution in [0.0, 0.3, 0.6, 1.0] {
        let mut body = cube();
        body.freedom = crate::rigid::Freedom::Fixed;
        body.flow_law = ContactLaw::hertz(1e5, SPHERE.radius, restitution, 0.0);
        let (mut height, mut speed) = (1.0, -1.0f64);
        loop {
            let cloud = Cloud::new(vec![above(height)], Vec3::new(0.0, 0.0, speed));
            let mut loads = Loads::default();
            let bodies = std::slice::from_ref(&body);
            loads.find_candidates(&cloud, bodies, REACH);
            cloud.loads(bodies, &mut loads, 0.0);
            let push = loads.on_points.first().map_or(0.0, |(_, force)| force.z);
            if speed > 0.0 && push == 0.0 {
                break;
            }
            // A point at rest on the surface does not rebound at all.
            if push == 0.0 && height < 1.0 {
                break;
            }
            speed += push / MASS * DT;
            height += speed * DT / SPHERE.radius;
        }
        // Error of the time step: a twentieth of the contact's time scale.
        assert!((speed - restitution).abs() < 0.05, "{restitution}: {speed}");
    }
}

// Points all over a body, moving towards it and along it at random: one sub-step of damping
// and friction alone dissipates energy, even if the body is far lighter than the points.
#[test]
fn braking_makes_no_energy_however_light_the_body() {
    for mass in [1e-6, 1e-3, 1.0] {
        let mut body = cube();
        let ratio = mass / body.mass;
        body.mass = mass;
        body.inertia *= ratio;
        body.inverse_inertia = InverseInertia::of(&body.inertia).expect("a solid has inertia");
        // Next to no spring, and as much damping as the bound allows.
        body.flow_law = ContactLaw {
            stiffness: 1e-9,
            damping: 1e12,
            friction: 5.0,
        };
        let places = lump(16, 0.07, 0.004);
        let velocity = Vec3::new(0.3, -0.2, 0.4);
        let cloud = Cloud::new(places.clone(), velocity);
        let mut loads = Loads::default();
        loads.find_candidates(&cloud, std::slice::from_ref(&body), REACH);
        cloud.loads(std::slice::from_ref(&body), &mut loads, 0.0);
        // Energy of the points through the grid, and of the body.
        let mut impulses = vec![Vec3::zeros(); cloud.grid.nodes.len()];
        for (point, force) in &loads.on_points {
            for (node, weight) in cloud.stencil(*point) {
                impulses[node as usize] += force * (weight * DT);
            }
        }
        let mut change = 0.0;
        for (node, impulse) in cloud.grid.nodes.iter().zip(&impulses) {
            if node.mass > 0.0 {
                change += impulse.dot(&(velocity + impulse / (2.0 * node.mass)));
            }
        }
        body.kick(&loads.on_bodies[0].load, DT);
        change += body.kinetic_energy();
        assert!(
            loads.on_points.len() > 50 && change < 0.0,
            "{mass}: {change}"
        );
    }
}

// A point moves round every shape, over faces, edges and vertices: its force never jumps, and
// is everywhere that of one contact. Along a path at a constant distance from the core only
// the normal turns, by no more than the path over the distance.
#[test]
fn the_force_is_continuous_over_faces_edges_and_vertices() {
    let boulder = [
        [0.0, 0.0, 0.0],
        [0.04, 0.0, 0.0],
        [0.01, 0.03, 0.0],
        [0.045, 0.012, 0.018],
        [0.012, 0.035, 0.015],
        [-0.004, 0.004, 0.02],
        [0.02, 0.012, 0.032],
    ];
    let mut sharp: Vec<_> = RegularSolid::ALL
        .iter()
        .map(|solid| SharpPolyhedron::regular(*solid, 0.04).unwrap())
        .collect();
    sharp.push(SharpPolyhedron::hull_of(&boulder.map(Vec3::from)).unwrap());
    for sharp in sharp {
        let shape = sharp.rounded(0.1 * sharp.inradius()).unwrap();
        let mut body = of_shape(shape);
        body.state.orientation = UnitQuaternion::from_euler_angles(0.3, -0.5, 0.8);
        let reach = SPHERE.radius + body.shape.sphero_radius();
        let away = reach - 0.5 * SPHERE.radius;
        let expected = body.flow_law.elastic_force(0.5 * SPHERE.radius);
        // The foot of a ray's end, lifted off the core by the distance asked for.
        let steps = 40_000;
        let at = |step: i32| {
            let angle = f64::from(step) * std::f64::consts::TAU / f64::from(steps);
            let tilt = 7.0 * angle;
            let ray = Vec3::new(
                angle.cos() * tilt.cos(),
                angle.sin() * tilt.cos(),
                tilt.sin(),
            );
            let closest = body.shape.closest_feature(&(ray * 0.2));
            (
                body.to_world(&(closest.point + closest.normal * away)),
                closest.feature,
            )
        };
        let force = |position: Vec3| {
            let cloud = Cloud::new(vec![position], Vec3::zeros());
            let contact = PointContact::find(&cloud, 0, &body, SPHERE.radius);
            let contact = contact.expect("it touches");
            let compliance = Compliance {
                body: 0.0,
                total: 1.0 / MASS,
            };
            contact.force(&body.flow_law, compliance, DT).force
        };
        let (mut place, _) = at(0);
        let mut before = force(place);
        let mut kinds = [false; 3];
        for step in 1..=steps {
            let (next, feature) = at(step);
            let now = force(next);
            assert!((now.norm() / expected - 1.0).abs() < 1e-9);
            let most = expected * (next - place).norm() / away;
            assert!(
                (now - before).norm() <= 1.001 * most + 1e-9 * expected,
                "{feature:?}"
            );
            (place, before) = (next, now);
            match feature {
                Feature::Vertex(_) => kinds[0] = true,
                Feature::Edge(_) => kinds[1] = true,
                Feature::Face(_) => kinds[2] = true,
            }
        }
        assert_eq!(kinds, [true; 3]);
    }
}
