//! Fingerprint of all records of a run: equal fingerprints mean equal bits.
//!
//! A chain, so that a run can be interrupted anywhere and resumed: each record is hashed
//! together with the fingerprint of those before it (docs/service.md,
//! "Fingerprint").

use blake3::Hasher;
use scree_solver::record::{BodySample, FlowSnapshot, Mode, Record, Sample};

/// Fingerprint of the records so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fingerprint([u8; 32]);

impl Fingerprint {
    /// Fingerprint of earlier records, from its bytes.
    pub fn of_bytes(bytes: [u8; 32]) -> Self {
        Self(bytes)
    }

    /// Its bytes.
    pub fn bytes(self) -> [u8; 32] {
        self.0
    }

    /// The fingerprint as hexadecimal digits.
    pub fn hex(self) -> String {
        blake3::Hash::from_bytes(self.0).to_hex().to_string()
    }

    /// Adds the next record.
    pub fn take_in(&mut self, record: &Record) {
        let mut hasher = Hasher::new();
        hasher.update(&self.0);
        match record {
            Record::Sample(sample) => take_sample(&mut hasher, sample),
            Record::Snapshot(snapshot) => take_snapshot(&mut hasher, snapshot),
        }
        self.0 = *hasher.finalize().as_bytes();
    }
}

fn take_sample(hasher: &mut Hasher, sample: &Sample) {
    hasher.update(b"sample");
    take_f64s(hasher, &[sample.time_s]);
    for body in &sample.bodies {
        take_body(hasher, body);
    }
}

/// Hashes a body's sample in the order of the trajectory's columns.
fn take_body(hasher: &mut Hasher, body: &BodySample) {
    take_f64s(hasher, &body.position_m);
    take_f64s(hasher, &body.orientation);
    for column in [
        &body.velocity_m_s,
        &body.angular_velocity_rad_s,
        &body.flow_force_n,
        &body.flow_torque_nm,
        &body.wall_force_n,
        &body.wall_torque_nm,
        &body.body_force_n,
        &body.body_torque_nm,
    ] {
        take_f64s(hasher, column);
    }
    hasher.update(&body.touching_points.to_le_bytes());
    take_f64s(hasher, &[body.submerged_fraction]);
    let mode: u8 = match body.mode {
        Mode::Resting => 0,
        Mode::Sliding => 1,
        Mode::Rolling => 2,
        Mode::Saltating => 3,
        Mode::Carried => 4,
    };
    hasher.update(&[mode]);
}

fn take_snapshot(hasher: &mut Hasher, snapshot: &FlowSnapshot) {
    hasher.update(b"snapshot");
    take_f64s(hasher, &[snapshot.time_s]);
    hasher.update(&snapshot.points.to_le_bytes());
    hasher.update(&snapshot.thinning.to_le_bytes());
    for id in &snapshot.point_id {
        hasher.update(&id.to_le_bytes());
    }
    for number in snapshot.position_m.iter().flatten() {
        hasher.update(&number.to_le_bytes());
    }
    for number in &snapshot.speed_m_s {
        hasher.update(&number.to_le_bytes());
    }
}

fn take_f64s(hasher: &mut Hasher, numbers: &[f64]) {
    for number in numbers {
        hasher.update(&number.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::super::columns::tests::numbered;
    use super::*;

    fn sample(index: u32) -> Record {
        Record::Sample(Sample {
            time_s: f64::from(index),
            bodies: vec![numbered(index)],
        })
    }

    fn of(records: &[Record]) -> Fingerprint {
        let mut fingerprint = Fingerprint::default();
        records
            .iter()
            .for_each(|record| fingerprint.take_in(record));
        fingerprint
    }

    #[test]
    fn a_run_cut_in_two_has_the_fingerprint_of_the_whole() {
        let mut cut = Fingerprint::of_bytes(of(&[sample(0), sample(1)]).bytes());
        cut.take_in(&sample(2));
        assert_eq!(cut, of(&[sample(0), sample(1), sample(2)]));
        assert_eq!(cut.hex().len(), 64);
    }

    #[test]
    fn one_bit_the_order_and_a_missing_record_change_it() {
        let whole = of(&[sample(0), sample(1)]);
        assert_ne!(whole, of(&[sample(1), sample(0)]));
        assert_ne!(whole, of(&[sample(0)]));
        let Record::Sample(mut changed) = sample(1) else {
            panic!("a sample")
        };
        changed.bodies[0].body_torque_nm[2] = -changed.bodies[0].body_torque_nm[2];
        assert_ne!(whole, of(&[sample(0), Record::Sample(changed)]));
    }

    #[test]
    fn a_snapshot_counts_with_every_number() {
        let snapshot = FlowSnapshot {
            time_s: 0.5,
            points: 2,
            thinning: 1,
            point_id: vec![0, 1],
            position_m: vec![[0.0; 3], [1.0; 3]],
            speed_m_s: vec![0.0, 1.0],
        };
        let mut other = snapshot.clone();
        other.speed_m_s[0] = -0.0;
        assert_ne!(
            of(&[Record::Snapshot(snapshot)]),
            of(&[Record::Snapshot(other)])
        );
    }
}
