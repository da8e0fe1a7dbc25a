//! Sides in strings: each as long as it gets without a fork.
//!
//! A string ends where its line ends or where other than two sides meet. Rings begin at their least node, and are closed by it.
//! O(n log n).

use std::collections::BTreeMap;

/// The strings of sides that are given by their ends, in order, and perhaps a middle after them, which goes between.
pub(crate) fn strings<'a>(sides: impl Iterator<Item = &'a [usize]>) -> Vec<Vec<usize>> {
    let sides: Vec<&[usize]> = sides.collect();
    let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (side, nodes) in sides.iter().enumerate() {
        nodes[..2].iter().for_each(|&end| at.entry(end).or_default().push(side));
    }
    let mut is_done = vec![false; sides.len()];
    let mut found = Vec::new();
    // Ends and forks first; what is left are rings.
    let ends = at.iter().filter(|entry| entry.1.len() != 2);
    for (&start, around) in ends.chain(&at) {
        for &first in around {
            if is_done[first] {
                continue;
            }
            let mut string = vec![start];
            let (mut node, mut side) = (start, first);
            loop {
                is_done[side] = true;
                let nodes = sides[side];
                string.extend(nodes.get(2));
                node = if nodes[0] == node { nodes[1] } else { nodes[0] };
                string.push(node);
                let around = &at[&node];
                let next = around.iter().copied().find(|&next| !is_done[next]);
                match next.filter(|_| around.len() == 2 && node != start) {
                    Some(next) => side = next,
                    None => break,
                }
            }
            found.push(string);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::strings;

    #[test]
    fn sides_are_strung() {
        let of = |sides: &[&[usize]]| strings(sides.iter().copied());
        assert_eq!(of(&[&[3, 2], &[5, 3], &[5, 9]]), [[2, 3, 5, 9]]);
        // A ring with a tail, and a ring alone.
        let sides: [&[usize]; 7] = [&[1, 2], &[2, 3], &[3, 4], &[4, 2], &[8, 7], &[6, 7], &[6, 8]];
        assert_eq!(of(&sides), [vec![1, 2], vec![2, 3, 4, 2], vec![6, 7, 8, 6]]);
        assert_eq!(of(&[&[1, 0, 7], &[1, 2, 8]]), [[0, 7, 1, 8, 2]]);
        assert!(of(&[]).is_empty());
    }
}
