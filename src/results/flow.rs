//! A snapshot of the flow: stored as one block, served as one document.

use super::chunk::{Block, BlockError};
use super::planes::{self, PlaneReader};
use scree_solver::record::FlowSnapshot;
use serde::Serialize;

/// Numbers of four bytes of one point before compression: three coordinates and a speed.
const NUMBERS_PER_POINT: usize = 4;

/// A stored snapshot: its block, and the data that the block does not hold.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredSnapshot {
    /// Simulated time [s].
    pub time_s: f64,
    /// Number of points in the flow at that time.
    pub points: u64,
    /// Thinning factor: one in this many points is kept.
    pub thinning: u32,
    /// Points kept.
    pub kept: usize,
    /// False for a snapshot of an older version, which has no identifiers.
    pub has_identifiers: bool,
    /// Their identifiers, positions and speeds.
    pub block: Block,
}

impl StoredSnapshot {
    /// Packs a snapshot.
    ///
    /// # Errors
    /// Only if the compressor is out of memory.
    pub fn pack(snapshot: &FlowSnapshot) -> Result<Self, BlockError> {
        let kept = snapshot.position_m.len();
        let mut raw = Vec::with_capacity(kept * bytes_per_point(true));
        planes::put_u32(&mut raw, &snapshot.point_id.iter().copied());
        for axis in 0..3 {
            planes::put_f32(
                &mut raw,
                &snapshot.position_m.iter().map(|point| point[axis]),
            );
        }
        planes::put_f32(&mut raw, &snapshot.speed_m_s.iter().copied());
        Ok(Self {
            time_s: snapshot.time_s,
            points: snapshot.points,
            thinning: snapshot.thinning,
            kept,
            has_identifiers: true,
            block: Block::seal(&raw)?,
        })
    }

    /// Unpacks the snapshot.
    ///
    /// # Errors
    /// [`BlockError`], if the block was not made by [`StoredSnapshot::pack`].
    pub fn unpack(&self) -> Result<FlowSnapshot, BlockError> {
        let raw = self
            .block
            .open(self.kept * bytes_per_point(self.has_identifiers))?;
        self.read(&raw)
            .ok_or(BlockError::Contents { rows: self.kept })
    }

    fn read(&self, raw: &[u8]) -> Option<FlowSnapshot> {
        let mut reader = PlaneReader::new(raw, self.kept);
        let point_id = match self.has_identifiers {
            true => reader.u32s()?,
            false => self.identifiers_in_order(),
        };
        let (x, y, z) = (reader.f32s()?, reader.f32s()?, reader.f32s()?);
        let speed_m_s = reader.f32s()?;
        let position_m = (0..self.kept)
            .map(|point| [x[point], y[point], z[point]])
            .collect();
        reader.is_done().then_some(FlowSnapshot {
            time_s: self.time_s,
            points: self.points,
            thinning: self.thinning,
            point_id,
            position_m,
            speed_m_s,
        })
    }

    /// Identifiers of the points of an older version's snapshot, as if none had left the flow.
    fn identifiers_in_order(&self) -> Vec<u32> {
        let identifier = |place| place as u32 * self.thinning;
        (0..self.kept).map(identifier).collect()
    }
}

/// Bytes of one point before compression.
fn bytes_per_point(has_identifiers: bool) -> usize {
    4 * (NUMBERS_PER_POINT + usize::from(has_identifiers))
}

/// The flow document of the service: the job, and the snapshot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FlowDocument {
    /// The job; null for a run without a service.
    pub job_id: Option<String>,
    /// The snapshot.
    #[serde(flatten)]
    pub snapshot: FlowSnapshot,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot(kept: u8) -> FlowSnapshot {
        FlowSnapshot {
            time_s: 0.6,
            points: 1234,
            thinning: 3,
            point_id: (0..kept).map(|i| 3 * u32::from(i) + 900).collect(),
            position_m: (0..kept)
                .map(|i| [f32::from(i), -f32::from(i), 0.1])
                .collect(),
            speed_m_s: (0..kept).map(|i| f32::from(i) * 0.3).collect(),
        }
    }

    #[test]
    fn a_snapshot_comes_back_as_it_was() {
        for kept in [0, 1, 200] {
            let packed = StoredSnapshot::pack(&snapshot(kept)).unwrap();
            assert_eq!(packed.unpack().unwrap(), snapshot(kept));
        }
    }

    #[test]
    fn a_snapshot_of_an_older_version_is_read_with_identifiers_in_order() {
        let mut raw = Vec::new();
        let told = snapshot(5);
        for axis in 0..3 {
            let coordinates = told.position_m.iter().map(|point| point[axis]);
            planes::put_f32(&mut raw, &coordinates);
        }
        planes::put_f32(&mut raw, &told.speed_m_s.iter().copied());
        let mut stored = StoredSnapshot::pack(&told).unwrap();
        stored.block = Block::seal(&raw).unwrap();
        stored.has_identifiers = false;
        let read = stored.unpack().unwrap();
        assert_eq!(read.point_id, [0, 3, 6, 9, 12]);
        assert_eq!(read.position_m, told.position_m);
    }

    #[test]
    fn positions_and_speeds_of_different_length_are_noticed() {
        let mut broken = snapshot(7);
        broken.speed_m_s.pop();
        let packed = StoredSnapshot::pack(&broken).unwrap();
        assert!(matches!(
            packed.unpack(),
            Err(BlockError::Contents { rows: 7 })
        ));
    }
}
