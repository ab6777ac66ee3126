//! Frames of the flow for looking: snapshots in a compact binary form, each point in ten bytes.
//! Little-endian throughout; docs/service.md describes the form for those who read it.

use super::FlowSnapshot;

/// Media type of a stream of frames.
pub const MEDIA_TYPE: &str = "application/vnd.scree.flow";

/// First bytes of a stream, before its version.
const MAGIC: [u8; 8] = *b"SCREEFLO";

const VERSION: u32 = 1;

/// Bytes of a frame before its columns.
const HEAD_BYTES: usize = 56;

/// Columns of a frame: rank, x, y, z, speed.
const COLUMNS: usize = 5;

/// Largest number of a column, which stands for the upper end of its range.
const TOP: f32 = 65_535.0;

/// Beginning of a stream of this many frames.
pub fn stream_head(frames: usize) -> Vec<u8> {
    let mut out = MAGIC.to_vec();
    out.extend(VERSION.to_le_bytes());
    out.extend((frames as u32).to_le_bytes());
    out
}

/// A snapshot as a frame: positions are multiples of 1/65535 of the extent of the flow, speeds of
/// the largest speed. Its length is a multiple of eight bytes.
pub fn frame(snapshot: &FlowSnapshot) -> Vec<u8> {
    let ranges = [0, 1, 2].map(|axis| {
        let coordinates = snapshot.position_m.iter().map(|point| point[axis]);
        Range::covering(coordinates)
    });
    let speeds = Range {
        start: 0.0,
        extent: snapshot.speed_m_s.iter().copied().fold(0.0, f32::max),
    };
    let kept = snapshot.position_m.len();
    let mut out = Vec::with_capacity(HEAD_BYTES + COLUMNS * 2 * kept + 8);
    out.extend(snapshot.time_s.to_le_bytes());
    out.extend(snapshot.points.to_le_bytes());
    out.extend((kept as u32).to_le_bytes());
    out.extend(snapshot.thinning.to_le_bytes());
    out.extend(ranges.iter().flat_map(|range| range.start.to_le_bytes()));
    out.extend(ranges.iter().flat_map(|range| range.extent.to_le_bytes()));
    out.extend(speeds.extent.to_le_bytes());
    out.extend([0; 4]);
    let rank = |id: &u32| (id / snapshot.thinning) as u16;
    out.extend(
        snapshot
            .point_id
            .iter()
            .flat_map(|id| rank(id).to_le_bytes()),
    );
    for (axis, range) in ranges.iter().enumerate() {
        let coordinates = snapshot.position_m.iter().map(|point| point[axis]);
        out.extend(coordinates.flat_map(|number| range.step_of(number).to_le_bytes()));
    }
    let steps = snapshot
        .speed_m_s
        .iter()
        .map(|speed| speeds.step_of(*speed));
    out.extend(steps.flat_map(u16::to_le_bytes));
    out.resize(out.len().next_multiple_of(8), 0);
    out
}

/// Range of the numbers of a column.
struct Range {
    start: f32,
    extent: f32,
}

impl Range {
    fn covering(numbers: impl Iterator<Item = f32> + Clone) -> Self {
        let low = numbers.clone().fold(f32::INFINITY, f32::min);
        let high = numbers.fold(f32::NEG_INFINITY, f32::max);
        if low > high {
            return Self {
                start: 0.0,
                extent: 0.0,
            };
        }
        Self {
            start: low,
            extent: high - low,
        }
    }

    /// Nearest step to a number.
    fn step_of(&self, number: f32) -> u16 {
        if self.extent > 0.0 {
            ((number - self.start) / self.extent * TOP).round() as u16
        } else {
            0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot(points: u16) -> FlowSnapshot {
        let number = |k: u16| f32::from(k) / 7.0;
        FlowSnapshot {
            time_s: 0.25,
            points: 5 * u64::from(points),
            thinning: 5,
            point_id: (0..points).map(|k| 5 * u32::from(k)).collect(),
            position_m: (0..points)
                .map(|k| [number(k) - 1.0, -number(k), 0.5])
                .collect(),
            speed_m_s: (0..points).map(|k| 2.0 * number(k)).collect(),
        }
    }

    fn f32_at(frame: &[u8], at: usize) -> f32 {
        f32::from_le_bytes(frame[at..at + 4].try_into().unwrap())
    }

    /// Column of a frame of this many points, as read by the description.
    fn column(frame: &[u8], points: usize, index: usize) -> Vec<f32> {
        let start = 56 + 2 * points * index;
        let bytes = &frame[start..start + 2 * points];
        let steps = bytes
            .chunks(2)
            .map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
        steps.map(f32::from).collect()
    }

    #[test]
    fn a_frame_is_read_back_to_within_half_a_step() {
        let told = snapshot(301);
        let frame = frame(&told);
        assert_eq!(frame.len() % 8, 0);
        assert_eq!(f64::from_le_bytes(frame[..8].try_into().unwrap()), 0.25);
        assert_eq!(frame[8..16], 1505_u64.to_le_bytes());
        assert_eq!(frame[16..20], 301_u32.to_le_bytes());
        assert_eq!(frame[20..24], 5_u32.to_le_bytes());
        let ranks = column(&frame, 301, 0);
        assert!(
            ranks
                .iter()
                .enumerate()
                .all(|(place, rank)| *rank == place as f32)
        );
        for axis in 0..3 {
            let (origin, extent) = (f32_at(&frame, 24 + 4 * axis), f32_at(&frame, 36 + 4 * axis));
            let half_step = 0.5 * extent / 65_535.0 + 1e-5;
            for (step, point) in column(&frame, 301, 1 + axis).iter().zip(&told.position_m) {
                let read = origin + extent * step / 65_535.0;
                assert!(
                    (read - point[axis]).abs() <= half_step,
                    "{read} {}",
                    point[axis]
                );
            }
        }
        let largest = f32_at(&frame, 48);
        assert_eq!(largest, 2.0 * 300.0 / 7.0);
        for (step, speed) in column(&frame, 301, 4).iter().zip(&told.speed_m_s) {
            assert!((largest * step / 65_535.0 - speed).abs() < 0.001);
        }
    }

    #[test]
    fn a_frame_without_points_has_its_head_alone() {
        assert_eq!(frame(&snapshot(0)).len(), HEAD_BYTES);
        assert_eq!(stream_head(3)[..12], *b"SCREEFLO\x01\0\0\0");
    }
}
