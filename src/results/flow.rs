//! A snapshot of the flow: stored as one block, served as one document.

use super::chunk::{Block, BlockError};
use super::planes::{self, PlaneReader};
use scree_solver::record::FlowSnapshot;
use serde::Serialize;

/// Bytes of one point before compression: three coordinates and a speed, f32.
const BYTES_PER_POINT: usize = 4 * 4;

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
    /// Their positions and speeds.
    pub block: Block,
}

impl StoredSnapshot {
    /// Packs a snapshot.
    ///
    /// # Errors
    /// Only if the compressor is out of memory.
    pub fn pack(snapshot: &FlowSnapshot) -> Result<Self, BlockError> {
        let kept = snapshot.position_m.len();
        let mut raw = Vec::with_capacity(kept * BYTES_PER_POINT);
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
            block: Block::seal(&raw)?,
        })
    }

    /// Unpacks the snapshot.
    ///
    /// # Errors
    /// [`BlockError`], if the block was not made by [`StoredSnapshot::pack`].
    pub fn unpack(&self) -> Result<FlowSnapshot, BlockError> {
        let raw = self.block.open(self.kept * BYTES_PER_POINT)?;
        self.read(&raw)
            .ok_or(BlockError::Contents { rows: self.kept })
    }

    fn read(&self, raw: &[u8]) -> Option<FlowSnapshot> {
        let mut reader = PlaneReader::new(raw, self.kept);
        let (x, y, z) = (reader.f32s()?, reader.f32s()?, reader.f32s()?);
        let speed_m_s = reader.f32s()?;
        let position_m = (0..self.kept)
            .map(|point| [x[point], y[point], z[point]])
            .collect();
        reader.is_done().then_some(FlowSnapshot {
            time_s: self.time_s,
            points: self.points,
            thinning: self.thinning,
            position_m,
            speed_m_s,
        })
    }
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
