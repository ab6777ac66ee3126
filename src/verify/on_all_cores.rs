//! Independent runs on all cores.

use crate::machine::cores;
use std::sync::Mutex;
use std::thread;

/// Applies a function to all elements, on all cores, in any order.
pub(super) fn side_by_side<T: Sync, R: Send>(all: &[T], each: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let to_do = Mutex::new(all.iter().enumerate());
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..cores() {
            scope.spawn(|| {
                while let Some((place, one)) = to_do.lock().ok().and_then(|mut all| all.next()) {
                    let result = each(one);
                    if let Ok(mut done) = done.lock() {
                        done.push((place, result));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_is_done_and_stays_in_order() {
        let numbers: Vec<u64> = (0..100).collect();
        let squares = side_by_side(&numbers, |number| number * number);
        assert!(
            squares
                .iter()
                .zip(&numbers)
                .all(|(square, number)| *square == number * number)
        );
        assert_eq!(squares.len(), 100);
    }
}
