//! Stress update of a sub-step: the velocity gradient of the nodes strains the points, and their
//! stress becomes the force on the nodes (docs/method.md, equations 11, 2–6 and 9).

use super::blocks::Block;
use super::chunk::Chunk;
use super::constitutive::Law;
use super::deformation::{Strained, strain};
use super::lanes::{Matrix, Real, Splat};
use super::rows::{LinearFields, MomentSums, Moments, Tile};
use super::stencil::Stencils;
use fearless_simd::prelude::*;

/// Strains the points of a block for `dt` [s], and scatters their forces.
#[inline(always)]
pub fn update_stress<S: Simd, R: Real>(
    simd: S,
    block: &mut Block<R>,
    law: &Law<R>,
    dt: R,
    motion: &Tile<R>,
    force: &mut Tile<R>,
) {
    *force = Tile::EMPTY;
    let mut sums = MomentSums::EMPTY;
    let mut fields = LinearFields::ZERO;
    for (chunk, count) in block.chunks_mut() {
        let stencils = Stencils::of(simd, &chunk.position);
        let moments = sums.gather(simd, &stencils, count, motion);
        let gradient = velocity_gradient(simd, &moments, law);
        let strained = strain(simd, chunk, &gradient, law, dt);
        set_force(simd, &stencils, &strained, chunk, law, &mut fields);
        fields.scatter(simd, &stencils, count, force);
    }
}

/// A = Σ v_i ⊗ ∇w_i from the moments of mass and velocity.
#[inline(always)]
pub fn velocity_gradient<S: Simd, R: Real>(
    simd: S,
    moments: &Moments<S, R>,
    law: &Law<R>,
) -> Matrix<S, R> {
    let number = Splat::<S, R>::new(simd);
    let mut gradient = [[number.of(0.0); 3]; 3];
    for axis in 0..3 {
        let factor = number.all(law.gradient[axis]);
        let [_, x, y, z] = moments.first[axis];
        gradient[0][axis] = x * factor;
        gradient[1][axis] = y * factor;
        gradient[2][axis] = z * factor;
    }
    gradient
}

/// Sets the force of stress as slopes.
#[inline(always)]
pub fn set_force<S: Simd, R: Real>(
    simd: S,
    stencils: &Stencils<R>,
    strained: &Strained<S, R>,
    chunk: &Chunk<R>,
    law: &Law<R>,
    fields: &mut LinearFields<R>,
) {
    let none = Splat::<S, R>::new(simd).of(0.0);
    let force = strained.force(simd, chunk, law);
    let mut slope = [[none; 4]; 3];
    for axis in 0..3 {
        slope[axis] = [none, force[0][axis], force[1][axis], force[2][axis]];
    }
    fields.set(simd, stencils, &[none; 4], &slope);
}
