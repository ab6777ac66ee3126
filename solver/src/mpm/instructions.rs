//! Instruction sets of the kernels.

use fearless_simd::Level;
use std::fmt;

/// Instruction sets that the kernels have code for. AVX-512 and AVX2 give the same
/// bits; the baseline rounds multiply and add one after the other, so its bits
/// differ in the last place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Instructions {
    /// Instructions that every processor of this kind has.
    Baseline,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512 as of Ice Lake.
    Avx512,
}

impl Instructions {
    /// The best this processor has.
    pub fn detected() -> Self {
        Self::of(Level::new())
    }

    #[cfg(target_arch = "x86_64")]
    fn of(level: Level) -> Self {
        if level.as_avx512().is_some() {
            Self::Avx512
        } else if level.as_avx2().is_some() {
            Self::Avx2
        } else {
            Self::Baseline
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn of(_: Level) -> Self {
        Self::Baseline
    }

    /// True if a multiply-add is rounded once, false if twice: a run continues with the same bits
    /// under instruction sets that do alike.
    pub fn fuse(self) -> bool {
        self > Self::Baseline
    }

    /// These instructions, or the best below them that this processor has.
    #[cfg(target_arch = "x86_64")]
    pub fn level(self) -> Level {
        let best = Level::new();
        let avx512 = best.as_avx512().filter(|_| self >= Self::Avx512);
        let avx2 = best.as_avx2().filter(|_| self >= Self::Avx2);
        let baseline = best.as_sse2().map(Level::Sse2).unwrap_or(best);
        avx512
            .map(Level::Avx512)
            .or(avx2.map(Level::Avx2))
            .unwrap_or(baseline)
    }

    /// These instructions, or the best below them that this processor has.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn level(self) -> Level {
        Level::new()
    }
}

impl fmt::Display for Instructions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        })
    }
}
