//! Cost of a sub-step of one point, counted from the formulas, to compare the kernels with
//! the limits of the machine.

/// Floating point operations of one point in one sub-step; a fused multiply-add
/// counts two, the fourth node of a row (weight zero) does not count.
///
/// | part | operations |
/// |---|---|
/// | weights (`stencil.rs`) | 3 × 13 + 9 |
/// | gradient gathered from nine rows, about the middle node, then the point (`rows/gather.rs`) | 348 + 64 + 24 |
/// | velocity gradient, F̂ and its cofactors, before and after (`deformation.rs`) | 9 + 2 × 53 + 56 + 18 |
/// | strain rate shared (`strain_rate_smoothing.rs`) | 9 |
/// | volumetric strain, pressure, trial and return of the deviator | 8 + 60 + 36 |
/// | force | 63 |
/// | force scattered to nine rows (`rows/scatter.rs`) | 24 + 156 + 216 |
pub const OPERATIONS: f64 = 48.0 + 436.0 + 189.0 + 9.0 + 104.0 + 63.0 + 396.0;

/// Memory traffic of one point in one sub-step [bytes], once caches are too small for the whole
/// flow: 26 numbers read and 15 written of a point; of a block full of points (512, tiles of
/// 216 nodes, on average 1.15 blocks of nodes to a block of points) a tile read, another
/// written and added up, and three times four numbers per node read and written.
pub const BYTES: f64 = 104.0 + 60.0 + 3.0 * 216.0 * 16.0 / 512.0 + 6.0 * 1.15 * 64.0 * 16.0 / 512.0;
