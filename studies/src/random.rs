//! Random numbers by counter, the same on every machine: SplitMix64 (Steele, Lea & Flood 2014).

/// Increment of the state: 2^64 over the golden ratio, made odd.
const INCREMENT: u64 = 0x9e37_79b9_7f4a_7c15;
/// Rounds of the Feistel network; four already make it a pseudo-random permutation
/// (Luby & Rackoff 1988), two more mix the few bits of small counts.
const ROUNDS: u64 = 6;

/// Purpose of a sequence of random numbers; no two purposes share one.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Purpose {
    SobolBlock = 1,
    LatinStratum,
    LatinJitter,
    Trajectory,
    Bootstrap,
    Residual,
}

/// Sequence of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    /// Sequence for a purpose, told apart from others of it by the seed and the place.
    pub(crate) fn new(purpose: Purpose, seed: u64, place: [u64; 2]) -> Self {
        Self {
            state: key(purpose, seed, place),
        }
    }

    /// Next 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(INCREMENT);
        mixed(self.state)
    }

    /// Next number of the uniform distribution over (0, 1), a multiple of 2⁻⁵³ and a half.
    pub(crate) fn unit(&mut self) -> f64 {
        ((self.bits() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// Next whole number of 0..count, all equally likely to within count / 2⁶⁴.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// The numbers 0..count in random order (Fisher & Yates 1938).
    pub(crate) fn order(&mut self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            order.swap(last, self.below(last + 1));
        }
        order
    }
}

/// Key of a sequence.
pub(crate) fn key(purpose: Purpose, seed: u64, place: [u64; 2]) -> u64 {
    let chained = |key: u64, word: u64| mixed((key ^ word).wrapping_add(INCREMENT));
    [seed, place[0], place[1]]
        .into_iter()
        .fold(purpose as u64, chained)
}

/// Image of an index under a random permutation of 0..count: a Feistel network over the next
/// power of four, walked until it comes back into the range (Black & Rogaway 2002).
pub(crate) fn permuted(index: u64, count: u64, key: u64) -> u64 {
    let bits = 64 - count.saturating_sub(1).leading_zeros();
    let half = bits.div_ceil(2).max(1);
    let mut image = feistel(index, half, key);
    while image >= count {
        image = feistel(image, half, key);
    }
    image
}

/// Permutation of the numbers of twice `half` bits.
fn feistel(number: u64, half: u32, key: u64) -> u64 {
    let mask = (1 << half) - 1;
    let (mut left, mut right) = (number >> half, number & mask);
    for round in 0..ROUNDS {
        let hash = mixed(key ^ mixed((round << 32) | right).wrapping_add(INCREMENT));
        (left, right) = (right, left ^ (hash & mask));
    }
    (left << half) | right
}

/// Finaliser of SplitMix64: every bit of the input sways every bit of the output.
fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_permutation_takes_every_place_once() {
        for count in [1, 2, 3, 7, 64, 100, 257] {
            let mut images: Vec<u64> = (0..count).map(|index| permuted(index, count, 9)).collect();
            assert!(count < 7 || images.windows(2).any(|pair| pair[0] > pair[1]));
            images.sort_unstable();
            assert_eq!(images, (0..count).collect::<Vec<u64>>());
        }
    }

    #[test]
    fn permutations_of_three_are_all_reached_about_equally_often() {
        let mut counts = std::collections::BTreeMap::new();
        for key in 0..6000 {
            let image = [0, 1, 2].map(|index| permuted(index, 3, mixed(key)));
            *counts.entry(image).or_insert(0) += 1;
        }
        assert_eq!(counts.len(), 6);
        assert!(
            counts.values().all(|count| (850..1150).contains(count)),
            "{counts:?}"
        );
    }

    #[test]
    fn the_sequence_is_that_of_splitmix64() {
        // The first outputs that other implementations of SplitMix64 have for this state.
        let mut random = Random { state: 1_234_567 };
        let drawn = [random.bits(), random.bits()];
        assert_eq!(
            drawn,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]
        );
    }

    #[test]
    fn whole_numbers_are_uniform() {
        let mut random = Random::new(Purpose::Bootstrap, 7, [0, 0]);
        let mut counts = [0_u32; 10];
        for _ in 0..10_000 {
            counts[random.below(10)] += 1;
        }
        assert!(
            counts.iter().all(|count| (900..1100).contains(count)),
            "{counts:?}"
        );
    }
}
