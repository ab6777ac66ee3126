//! Random numbers from a seed.

/// SplitMix64 (Steele, Lea & Flood 2014).
#[derive(Debug)]
pub(super) struct Dice(u64);

impl Dice {
    /// A generator with this seed.
    pub(super) fn of(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x2545_f491_4f6c_dd1d))
    }

    /// The next number.
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Uniform from 0 to 1.
    pub(super) fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform from low to high, rounded to three digits as people write them.
    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        let value = low + self.share() * (high - low);
        (value * 1000.0).round() / 1000.0
    }

    /// Log-uniform from low to high.
    pub(super) fn decades(&mut self, low: f64, high: f64) -> f64 {
        let value = low * (high / low).powf(self.share());
        // Four digits, for readability.
        let scale = 10f64.powf(3.0 - value.log10().floor());
        ((value * scale).round() / scale).clamp(low, high)
    }

    /// One of the elements, with equal probability.
    pub(super) fn one_of<T: Clone>(&mut self, all: &[T]) -> T {
        all[(self.next() % all.len() as u64) as usize].clone()
    }

    /// True with probability 1/`throws`.
    pub(super) fn once_in(&mut self, throws: u64) -> bool {
        self.next().is_multiple_of(throws)
    }
}
