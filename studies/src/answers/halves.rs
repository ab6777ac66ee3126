//! Halves of the members, whose difference tells the noise of a design.

/// Signs of the four quarters of the members, for the three ways to set one half against the
/// other.
pub(super) const SIGNS: [[f64; 4]; 3] = [
    [1.0, 1.0, -1.0, -1.0],
    [1.0, -1.0, 1.0, -1.0],
    [1.0, -1.0, -1.0, 1.0],
];

/// Sign of a member at a place among so many, in the order of the design.
pub(super) fn sign(signs: [f64; 4], place: usize, count: usize) -> f64 {
    signs[4 * place / count]
}
