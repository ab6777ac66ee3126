//! A block of flow that hardly yields slides down an incline that is not aligned with the grid:
//! docs/accuracy.md, case 9.

use crate::scenes::{PRECISIONS, Scene, mean_velocity, run};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use serde_json::json;

const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.2;

const CELL_M: f64 = 0.015;

/// The block: 0.06 m thick (four cells), 0.3 m long, two cells wide between smooth walls, of a
/// material that hardly yields with the largest frictions allowed.
fn block(inclination_deg: f64) -> Scene {
    let cos = inclination_deg.to_radians().cos();
    let (height_m, length_m, width) = (0.06, 0.3, 2.0 * CELL_M);
    let volume = width * height_m * length_m;
    Scene::channel(inclination_deg, 1.6 * cos, 0.1, width)
        .set("channel", "base_friction", FRICTION)
        .flow(json!({
            "volume_m3": volume,
            "release": {"height_m": height_m, "toe_distance_m": 1.1 * cos},
            "material": {"static_friction": 10.0, "limiting_friction": 10.0}
        }))
        .set("numerics", "cell_size_m", CELL_M)
        .lasting(0.4)
}

/// Acceleration along the slope between two times after the start [m/s²].
fn acceleration(scene: &Scene, inclination_deg: f64, from_s: f64, to_s: f64) -> f64 {
    let (sin, cos) = inclination_deg.to_radians().sin_cos();
    let down = Vec3::new(cos, 0.0, -sin);
    let mut simulation = scene.start();
    run(&mut simulation, from_s);
    let (first, start) = (mean_velocity(&simulation).dot(&down), simulation.time_s());
    run(&mut simulation, to_s);
    let (last, end) = (mean_velocity(&simulation).dot(&down), simulation.time_s());
    (last - first) / (end - start)
}

// Tolerance: 1 % of g (docs/accuracy.md, case 9). Measured on cells of 0.015 m, in parts of g:
// +0.02 % at 20°, +0.04 % at 30°, −0.06 % at 45°, and in single precision +0.07 %, +0.01 % and
// −0.06 %; over windows half as long the block's own ringing shows, ±0.4 %.
#[test]
fn a_block_slides_at_the_acceleration_of_coulomb() {
    for inclination_deg in [20.0, 30.0, 45.0] {
        let (sin, cos) = f64::to_radians(inclination_deg).sin_cos();
        let exact = GRAVITY * (sin - FRICTION * cos);
        for precision in PRECISIONS {
            let scene = block(inclination_deg).precision(precision);
            let got = acceleration(&scene, inclination_deg, 0.1, 0.4);
            let error = (got - exact) / GRAVITY;
            println!(
                "{inclination_deg}°, {precision}: {got:.4} against {exact:.4} m/s², error {error:+.5} g"
            );
            assert!(error.abs() < 0.01, "{inclination_deg}°: {error}");
        }
    }
}

/// Mean place along the slope [m].
fn place(simulation: &Simulation, inclination_deg: f64) -> f64 {
    let (sin, cos) = inclination_deg.to_radians().sin_cos();
    let down = Vec3::new(cos, 0.0, -sin);
    let points = simulation.points();
    let sum: f64 = points.iter().map(|p| p.position.dot(&down)).sum();
    sum / points.len() as f64
}

// Below the angle of friction, 11.3°, a block stays: in a second after it has settled it may
// travel 1 % of the path on which gravity along the slope would take it. It rocks on its base
// without end, a few mm/s to and fro, which is not counted here.
//
// Nearer to that angle it does not stay, which is a known flaw: at 10° it creeps downhill,
// driven by its own ringing.
#[test]
fn a_block_well_below_the_angle_of_friction_stays() {
    for inclination_deg in [5.0, 7.0] {
        for precision in PRECISIONS {
            let scene = block(inclination_deg).lasting(1.2).precision(precision);
            let mut simulation = scene.start();
            run(&mut simulation, 0.2);
            let (start, from) = (place(&simulation, inclination_deg), simulation.time_s());
            run(&mut simulation, 1.2);
            let time = simulation.time_s() - from;
            let gone = place(&simulation, inclination_deg) - start;
            let free = 0.5 * GRAVITY * f64::to_radians(inclination_deg).sin() * time * time;
            println!("{inclination_deg}°, {precision}: went {gone:+.6} m of {free:.3} m");
            assert!(gone.abs() < 0.01 * free);
        }
    }
}
