//! Artificial runs for the tests of the pictures.

use scree_solver::record::{
    BodyOutcome, BodySample, Conservation, Cost, FlowOutcome, FlowSnapshot, MassProperties, Mode,
    Outcome, Sample,
};
use scree_solver::scenario::{
    Accuracy, Approach, Body, BuiltSolid, Channel, Coupling, Ending, Flow, Ground, Material,
    Numerics, Place, Position, Precision, Release, Scenario, Shape, Source, Symmetry,
};

pub(super) fn cube(side_m: f64, sphero_radius_m: f64) -> Body {
    Body {
        shape: Shape::Cube { side_m },
        sphero_radius_m,
        density_kg_m3: 2000.0,
        position: Position {
            place: Place::InChannel {
                downstream_m: 0.04,
                lateral_m: 0.0,
            },
            elevation_m: None,
        },
        yaw_deg: 0.0,
        orientation: None,
        velocity_m_s: [0.0; 3],
        angular_velocity_rad_s: [0.0; 3],
        friction: 0.4,
        restitution: 0.3,
        rolling_friction: 0.0,
        flow_friction: 0.4,
        flow_restitution: 0.0,
        contact_modulus_pa: None,
        fixed: false,
        motion: None,
        solid: BuiltSolid::default(),
    }
}

pub(super) fn resting_at(position_m: [f64; 3]) -> BodySample {
    BodySample {
        position_m,
        orientation: [1.0, 0.0, 0.0, 0.0],
        velocity_m_s: [0.0; 3],
        angular_velocity_rad_s: [0.0; 3],
        flow_force_n: [0.0; 3],
        flow_torque_nm: [0.0; 3],
        wall_force_n: [0.0; 3],
        wall_torque_nm: [0.0; 3],
        body_force_n: [0.0; 3],
        body_torque_nm: [0.0; 3],
        touching_points: 0,
        submerged_fraction: 0.0,
        mode: Mode::Resting,
    }
}

/// One body that slides 0.4 m within `moving_s` [s] of `duration_s` [s]; a
/// hundred samples.
pub(super) fn sliding_samples(moving_s: f64, duration_s: f64) -> Vec<Sample> {
    let at = |k: u32| {
        let time_s = duration_s * f64::from(k) / 100.0;
        let share = if moving_s > 0.0 {
            (time_s / moving_s).min(1.0)
        } else {
            0.0
        };
        // Smooth start and end: 3s² − 2s³, whose slope peaks in the middle.
        let way = 0.4 * share * share * (3.0 - 2.0 * share);
        let mut body = resting_at([0.04 + way, 0.05 * way, 0.02]);
        if moving_s > 0.0 {
            body.velocity_m_s[0] = 0.4 * 6.0 * share * (1.0 - share) / moving_s;
        }
        Sample {
            time_s,
            bodies: vec![body],
        }
    };
    (0..=100).map(at).collect()
}

/// Bodies in rows that start one after another, overtake each other and stop; a hundred samples of
/// 3 s.
pub(super) fn tangled_samples(bodies: usize) -> Vec<Sample> {
    let at = |time_s: f64, body: usize| {
        let index = body as f64;
        let since = (time_s - 0.03 * index).clamp(0.0, 1.5);
        let share = since / 1.5;
        let length_m = 0.3 + 0.05 * (index * 2.4).sin();
        let way = length_m * share * share * (3.0 - 2.0 * share);
        let row = [0.05 * (body / 5) as f64, 0.036 * (body % 5) as f64 - 0.072];
        let mut state = resting_at([0.05 + row[0] + way, row[1] + 0.02 * way, 0.01]);
        state.velocity_m_s[0] = length_m * 4.0 * share * (1.0 - share)
            + 0.05 * (1.0 - share) * (40.0 * since + index).sin().abs();
        state.submerged_fraction = share * (0.6 + 0.4 * (9.0 * since + index).sin());
        state
    };
    let sample = |k: u32| {
        let time_s = 0.03 * f64::from(k);
        Sample {
            time_s,
            bodies: (0..bodies).map(|body| at(time_s, body)).collect(),
        }
    };
    (0..=100).map(sample).collect()
}

pub(super) fn empty_snapshot(time_s: f64) -> FlowSnapshot {
    FlowSnapshot {
        time_s,
        points: 0,
        thinning: 1,
        point_id: Vec::new(),
        position_m: Vec::new(),
        speed_m_s: Vec::new(),
    }
}

/// A slab of 2,000 points whose front is at `front_m`.
pub(super) fn slab(time_s: f64, front_m: f32, speed_m_s: f32) -> FlowSnapshot {
    let point = |k: u16| {
        let (column, row) = (f32::from(k / 20), f32::from(k % 20));
        [front_m - 0.005 * column, 0.01 * (row - 9.5), 0.001 * column]
    };
    FlowSnapshot {
        points: 20_000,
        thinning: 10,
        position_m: (0..2_000).map(point).collect(),
        speed_m_s: (0..2_000)
            .map(|k: u16| speed_m_s * f32::from(k) / 2_000.0)
            .collect(),
        ..empty_snapshot(time_s)
    }
}

pub(super) fn scenario(bodies: Vec<Body>) -> Scenario {
    Scenario {
        title: "Cube <hit> by \"sand\" & gravel\u{7}".to_owned(),
        ground: Ground::Channel(Channel {
            inclination_deg: 40.0,
            incline_length_m: 1.0,
            runout_length_m: 2.0,
            width_m: 0.2,
            base_friction: 0.4,
            side_friction: 0.0,
        }),
        flow: Some(Flow {
            source: Source::Channel {
                volume_m3: 0.01,
                release: Release {
                    height_m: 0.15,
                    toe_distance_m: 0.05,
                },
            },
            material: Material {
                bulk_density_kg_m3: 1500.0,
                grain_density_kg_m3: 2600.0,
                grain_diameter_m: 0.001,
                static_friction: 0.6,
                limiting_friction: 0.86,
                reference_inertial_number: 0.279,
                poissons_ratio: 0.3,
                youngs_modulus_pa: None,
            },
        }),
        bodies,
        gravity_m_s2: 9.81,
        duration_s: 3.0,
        sample_interval_s: 0.01,
        flow_snapshots: 6,
        flow_snapshot_points: 5_000,
        numerics: Numerics {
            cell_size_m: None,
            points_per_cell: 8,
            sound_speed_m_s: None,
            courant: None,
            flow_courant: None,
            precision: Precision::Single,
            symmetry: Symmetry::Auto,
            approach: Approach::Auto,
            coupling: Coupling::default(),
            ending: Ending::Auto,
            threads: None,
        },
        accuracy: Accuracy {
            error_bars: false,
            target: None,
            quantity: None,
            body: 0,
            budget_point_steps: 2e10,
        },
    }
}

/// The outcome that belongs to [`sliding_samples`]`(1.0, 3.0)`.
pub(super) fn slid() -> BodyOutcome {
    BodyOutcome {
        first_contact_time_s: Some(0.02),
        onset_time_s: Some(0.0289),
        peak_speed_m_s: 0.6,
        peak_speed_time_s: Some(0.51),
        stop_time_s: Some(1.02),
        displacement_m: 0.4005,
        path_length_m: 0.4005,
        final_position_m: [0.44, 0.02, 0.02],
        burial_depth_m: 0.0,
        final_orientation: [1.0, 0.0, 0.0, 0.0],
        error_bars: None,
        mass_properties: MassProperties {
            mass_kg: 0.127,
            volume_m3: 6.34e-5,
            principal_moments_kg_m2: [3.36e-5; 3],
            principal_axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        },
        energy: None,
    }
}

pub(super) fn never_moved() -> BodyOutcome {
    BodyOutcome {
        onset_time_s: None,
        peak_speed_m_s: 0.0,
        peak_speed_time_s: None,
        stop_time_s: None,
        displacement_m: 0.0,
        path_length_m: 0.0,
        ..slid()
    }
}

pub(super) fn outcome(bodies: Vec<BodyOutcome>) -> Outcome {
    Outcome {
        bodies,
        flow: FlowOutcome {
            front_m: None,
            runout_m: None,
            outflow_mass_kg: 0.0,
            excluded_volume_m3: 0.0,
            error_bars: None,
        },
        conservation: Conservation {
            mass_error: 0.0,
            momentum_residual: 0.0,
            angular_momentum_residual: 0.0,
            angular_momentum_from_shifting: 0.0,
            energy_residual: 0.0,
            max_overlap_ratio: 0.0,
            max_body_overlap_ratio: 0.0,
            penetration_corrections: 0,
            points_outflow: 0,
            points_lost: 0,
        },
        cost: Cost {
            points: 0,
            steps: 0,
            substeps: 0,
            point_steps: 0,
            wall_s: 0.0,
            point_steps_per_s: 0.0,
            threads: 1,
            cell_size_m: 0.01,
            sound_speed_m_s: None,
        },
        remarks: Vec::new(),
        ended_early: None,
        plan: None,
        accuracy: None,
    }
}
