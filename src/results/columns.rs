//! The trajectory of one body as columns of equal length.

use scree_solver::record::{BodySample, Mode, Sample};
use serde::Deserialize;
use utoipa::ToSchema;

/// Columns of a trajectory, all of equal length, in the order of the trajectory document; with
/// `fields` only those. Forces and torques are means since the sample before.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, ToSchema)]
pub struct TrajectoryColumns {
    /// Simulated time [s].
    #[schema(required = false, extensions(("x-unit" = json!("s"))))]
    pub time_s: Vec<f64>,
    /// Centre [x, y, z] [m].
    #[schema(required = false, extensions(("x-unit" = json!("m"))))]
    pub position_m: Vec<[f64; 3]>,
    /// Unit quaternion [w, x, y, z].
    #[schema(required = false)]
    pub orientation: Vec<[f64; 4]>,
    /// Velocity of the centre [m/s].
    #[schema(required = false, extensions(("x-unit" = json!("m/s"))))]
    pub velocity_m_s: Vec<[f64; 3]>,
    /// Angular velocity, world axes [rad/s].
    #[schema(required = false, extensions(("x-unit" = json!("rad/s"))))]
    pub angular_velocity_rad_s: Vec<[f64; 3]>,
    /// Force of the flow [N].
    #[schema(required = false, extensions(("x-unit" = json!("N"))))]
    pub flow_force_n: Vec<[f64; 3]>,
    /// Torque of the flow about the centre [N m].
    #[schema(required = false, extensions(("x-unit" = json!("N m"))))]
    pub flow_torque_nm: Vec<[f64; 3]>,
    /// Force of the walls [N].
    #[schema(required = false, extensions(("x-unit" = json!("N"))))]
    pub wall_force_n: Vec<[f64; 3]>,
    /// Torque of the walls about the centre [N m].
    #[schema(required = false, extensions(("x-unit" = json!("N m"))))]
    pub wall_torque_nm: Vec<[f64; 3]>,
    /// Force of other bodies, fixed ones included [N].
    #[schema(required = false, extensions(("x-unit" = json!("N"))))]
    pub body_force_n: Vec<[f64; 3]>,
    /// Torque of other bodies about the centre [N m].
    #[schema(required = false, extensions(("x-unit" = json!("N m"))))]
    pub body_torque_nm: Vec<[f64; 3]>,
    /// Material points in contact.
    #[schema(required = false)]
    pub touching_points: Vec<u32>,
    /// Share of the body's height below the surface of the flow, 0..1.
    #[schema(required = false)]
    pub submerged_fraction: Vec<f64>,
    /// Mode of motion.
    #[schema(required = false)]
    pub mode: Vec<Mode>,
}

impl TrajectoryColumns {
    /// The trajectory of body number `body` in `samples`; empty if the body
    /// does not exist.
    pub fn of_body(samples: &[Sample], body: usize) -> Self {
        let mut columns = Self::default();
        for sample in samples {
            if let Some(state) = sample.bodies.get(body) {
                columns.push(sample.time_s, state);
            }
        }
        columns
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// True if there is no sample.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// Keeps the first `len` samples.
    pub fn truncate(&mut self, len: usize) {
        self.time_s.truncate(len);
        self.position_m.truncate(len);
        self.orientation.truncate(len);
        self.velocity_m_s.truncate(len);
        self.angular_velocity_rad_s.truncate(len);
        self.flow_force_n.truncate(len);
        self.flow_torque_nm.truncate(len);
        self.wall_force_n.truncate(len);
        self.wall_torque_nm.truncate(len);
        self.body_force_n.truncate(len);
        self.body_torque_nm.truncate(len);
        self.touching_points.truncate(len);
        self.submerged_fraction.truncate(len);
        self.mode.truncate(len);
    }

    /// Adds one sample at the end.
    pub fn push(&mut self, time_s: f64, sample: &BodySample) {
        self.time_s.push(time_s);
        self.position_m.push(sample.position_m);
        self.orientation.push(sample.orientation);
        self.velocity_m_s.push(sample.velocity_m_s);
        self.angular_velocity_rad_s
            .push(sample.angular_velocity_rad_s);
        self.flow_force_n.push(sample.flow_force_n);
        self.flow_torque_nm.push(sample.flow_torque_nm);
        self.wall_force_n.push(sample.wall_force_n);
        self.wall_torque_nm.push(sample.wall_torque_nm);
        self.body_force_n.push(sample.body_force_n);
        self.body_torque_nm.push(sample.body_torque_nm);
        self.touching_points.push(sample.touching_points);
        self.submerged_fraction.push(sample.submerged_fraction);
        self.mode.push(sample.mode);
    }

    /// Sample number `index`.
    ///
    /// # Panics
    /// If there are not that many.
    pub fn sample(&self, index: usize) -> (f64, BodySample) {
        let state = BodySample {
            position_m: self.position_m[index],
            orientation: self.orientation[index],
            velocity_m_s: self.velocity_m_s[index],
            angular_velocity_rad_s: self.angular_velocity_rad_s[index],
            flow_force_n: self.flow_force_n[index],
            flow_torque_nm: self.flow_torque_nm[index],
            wall_force_n: self.wall_force_n[index],
            wall_torque_nm: self.wall_torque_nm[index],
            body_force_n: self.body_force_n[index],
            body_torque_nm: self.body_torque_nm[index],
            touching_points: self.touching_points[index],
            submerged_fraction: self.submerged_fraction[index],
            mode: self.mode[index],
        };
        (self.time_s[index], state)
    }
}

/// Selection of samples of a trajectory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection {
    /// First time [s], inclusive; `None`: from the start.
    pub from_s: Option<f64>,
    /// Last time [s], inclusive; `None`: to the end.
    pub to_s: Option<f64>,
    /// Stride, counted from the first sample in the range; at least 1.
    pub stride: usize,
}

impl Default for Selection {
    fn default() -> Self {
        Self {
            from_s: None,
            to_s: None,
            stride: 1,
        }
    }
}

/// Both ends of a range are inclusive: a sample at 7 × 0.01 s, which is not exactly
/// 0.07 in binary, still belongs to `to_s=0.07`. A nanosecond is far above the
/// rounding of any simulated time and far below any sample interval.
const TIME_TOLERANCE_S: f64 = 1e-9;

impl Selection {
    /// Earliest sample time that belongs to the range [s].
    pub fn earliest_s(&self) -> f64 {
        self.from_s
            .map_or(f64::NEG_INFINITY, |from_s| from_s - TIME_TOLERANCE_S)
    }

    /// Latest sample time that belongs to the range [s].
    pub fn latest_s(&self) -> f64 {
        self.to_s
            .map_or(f64::INFINITY, |to_s| to_s + TIME_TOLERANCE_S)
    }
}

/// Selects samples from successive chunks.
#[derive(Debug)]
pub struct Selector {
    selection: Selection,
    in_range: usize,
}

impl Selector {
    /// A selector before the first chunk.
    pub fn new(selection: Selection) -> Self {
        Self {
            selection,
            in_range: 0,
        }
    }

    /// The selected samples of the next chunk of the trajectory.
    pub fn choose(&mut self, chunk: &TrajectoryColumns) -> TrajectoryColumns {
        let mut chosen = TrajectoryColumns::default();
        let (earliest_s, latest_s) = (self.selection.earliest_s(), self.selection.latest_s());
        for index in 0..chunk.len() {
            let time_s = chunk.time_s[index];
            if time_s < earliest_s || time_s > latest_s {
                continue;
            }
            if self.in_range.is_multiple_of(self.selection.stride) {
                let (time_s, sample) = chunk.sample(index);
                chosen.push(time_s, &sample);
            }
            self.in_range += 1;
        }
        chosen
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Distinct numbers in every place, so that swapped columns are detected.
    pub(crate) fn numbered(index: u32) -> BodySample {
        let base = f64::from(index) * 100.0;
        let triple = |offset: f64| [base + offset, base + offset + 0.25, -(base + offset + 0.5)];
        BodySample {
            position_m: triple(1.0),
            orientation: [base + 2.0, base + 2.25, base + 2.5, base + 2.75],
            velocity_m_s: triple(3.0),
            angular_velocity_rad_s: triple(4.0),
            flow_force_n: triple(5.0),
            flow_torque_nm: triple(6.0),
            wall_force_n: triple(7.0),
            wall_torque_nm: triple(8.0),
            body_force_n: triple(10.0),
            body_torque_nm: triple(11.0),
            touching_points: index * 10 + 9,
            submerged_fraction: 1.0 / (1.0 + f64::from(index)),
            mode: [
                Mode::Resting,
                Mode::Sliding,
                Mode::Rolling,
                Mode::Saltating,
                Mode::Carried,
            ][index as usize % 5],
        }
    }

    /// Samples 0..count, a hundredth of a second apart.
    pub(crate) fn numbered_columns(count: u32) -> TrajectoryColumns {
        let mut columns = TrajectoryColumns::default();
        for index in 0..count {
            columns.push(f64::from(index) * 0.01, &numbered(index));
        }
        columns
    }

    fn chosen_times(selection: Selection, chunk_lengths: &[u32]) -> Vec<f64> {
        let whole = numbered_columns(chunk_lengths.iter().sum());
        let mut selector = Selector::new(selection);
        let mut times = Vec::new();
        let mut index = 0;
        for &length in chunk_lengths {
            let mut chunk = TrajectoryColumns::default();
            for _ in 0..length {
                let (time_s, sample) = whole.sample(index);
                chunk.push(time_s, &sample);
                index += 1;
            }
            times.extend(selector.choose(&chunk).time_s);
        }
        times
    }

    #[test]
    fn both_ends_of_a_range_are_inclusive_in_spite_of_rounding() {
        // 7 × 0.01 = 0.07000000000000001 in binary.
        let selection = Selection {
            from_s: Some(0.03),
            to_s: Some(0.07),
            stride: 1,
        };
        let times = chosen_times(selection, &[20]);
        assert_eq!(
            times,
            [3.0 * 0.01, 4.0 * 0.01, 5.0 * 0.01, 6.0 * 0.01, 7.0 * 0.01]
        );
    }

    #[test]
    fn stride_counts_from_the_first_sample_in_range_across_chunks() {
        let selection = Selection {
            from_s: Some(0.02),
            to_s: None,
            stride: 3,
        };
        let expected = [0.02, 0.05, 0.08];
        for chunks in [&[10][..], &[4, 6], &[1, 1, 1, 1, 1, 1, 1, 1, 1, 1]] {
            assert_eq!(chosen_times(selection, chunks), expected);
        }
    }

    #[test]
    fn a_body_that_is_not_there_has_an_empty_trajectory() {
        let samples = [Sample {
            time_s: 0.0,
            bodies: vec![numbered(1)],
        }];
        assert_eq!(TrajectoryColumns::of_body(&samples, 0).len(), 1);
        assert!(TrajectoryColumns::of_body(&samples, 1).is_empty());
    }
}
