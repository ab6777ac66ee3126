//! Memory asked for before it is needed.
#![allow(
    unsafe_code,
    reason = "the instruction takes a pointer, which it never follows"
)]

/// Size of what processors load at once [bytes].
const LINE: usize = 64;

/// Asks for a value that is going to be used, so that it is there by then.
#[inline(always)]
pub(in crate::mpm) fn prefetch<T>(value: &T) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let start = std::ptr::from_ref(value).cast::<i8>();
        for line in (0..size_of::<T>()).step_by(LINE) {
            // SAFETY: the address lies within the value; besides, a prefetch of any address is
            // without effect on the program.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.add(line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}
