//! Pairs among a number of things, and the triples all of whose pairs are among them.

use std::collections::BTreeSet;

/// For each thing those it makes a pair with.
#[derive(Debug)]
pub(super) struct Pairs(Vec<BTreeSet<usize>>);

impl Pairs {
    /// The pairs of `count` things that pass a test.
    pub(super) fn among(count: usize, mut test: impl FnMut(usize, usize) -> bool) -> Self {
        let mut pairs = vec![BTreeSet::new(); count];
        for a in 0..count {
            for b in a + 1..count {
                if test(a, b) {
                    pairs[a].insert(b);
                    pairs[b].insert(a);
                }
            }
        }
        Self(pairs)
    }

    /// All triples of pairs, in ascending order.
    pub(super) fn triples(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.0.iter().enumerate().flat_map(move |(a, of_a)| {
            of_a.range(a + 1..).flat_map(move |&b| {
                let thirds = self.0[b].range(b + 1..).filter(|c| of_a.contains(c));
                thirds.map(move |&c| [a, b, c])
            })
        })
    }

    /// True if the three make three pairs.
    #[cfg(test)]
    pub(super) fn hold(&self, [a, b, c]: [usize; 3]) -> bool {
        [(a, b), (a, c), (b, c)]
            .iter()
            .all(|(one, other)| self.0[*one].contains(other))
    }
}

/// All triples of `count` things, in ascending order.
#[cfg(test)]
pub(super) fn all_triples(count: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..count)
        .flat_map(move |a| (a + 1..count).flat_map(move |b| (b + 1..count).map(move |c| [a, b, c])))
}

#[test]
fn triples_are_those_of_three_pairs() {
    let pairs = Pairs::among(5, |a, b| (a + b) % 2 == 0 || a == 0);
    let found: Vec<[usize; 3]> = pairs.triples().collect();
    assert_eq!(found, [[0, 1, 3], [0, 2, 4]]);
    assert!(all_triples(5).all(|three| pairs.hold(three) == found.contains(&three)));
}
