//! Octrees of points: nodes have keys, and each is a cube in space.

use std::fmt;
use std::str::FromStr;

/// Deeper trees have cubes smaller than coordinates tell apart.
const DEEPEST: u32 = 31;

/// A node: how deep it is, and its place among the cubes of its depth along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Key {
    depth: u32,
    at: [u32; 3],
}

impl Key {
    /// The whole tree.
    pub(crate) const ROOT: Self = Self { depth: 0, at: [0; 3] };

    /// A node, if there can be one.
    pub(super) fn of(depth: i32, at: [i32; 3]) -> Option<Self> {
        let depth = u32::try_from(depth).ok().filter(|&depth| depth <= DEEPEST)?;
        let is_inside = |k: i32| u32::try_from(k).is_ok_and(|k| u64::from(k) < 1 << depth);
        at.into_iter().all(is_inside).then(|| Self { depth, at: at.map(|k| k as u32) })
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.at;
        write!(f, "{}-{x}-{y}-{z}", self.depth)
    }
}

impl FromStr for Key {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        // What is written in another way is another name.
        let numbers: Vec<i32> = text.split('-').filter_map(|part| part.parse().ok()).collect();
        let [depth, x, y, z] = numbers[..] else { return Err(()) };
        Self::of(depth, [x, y, z]).filter(|key| key.to_string() == text).ok_or(())
    }
}

/// Where the cubes of a tree are in the plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cubes {
    pub(crate) low: [f64; 2],
    pub(crate) width: [f64; 2],
    /// A step of the coordinates.
    pub(crate) step: [f64; 2],
}

impl Cubes {
    /// Whether points of a node may be in a box in the plane, if there is one. A cube counts as larger by some steps: writers round its
    /// points, and its bounds.
    pub(crate) fn meet(&self, key: Key, within: Option<[f64; 4]>) -> bool {
        const ROUNDING: f64 = 1.0 / (1_u64 << 40) as f64;
        let along = |axis: usize, low: f64, high: f64| {
            let width = self.width[axis] / (1_u64 << key.depth) as f64;
            let begin = self.low[axis] + f64::from(key.at[axis]) * width;
            let slack =
                2.0 * self.step[axis].abs() + ROUNDING * (self.low[axis].abs() + self.width[axis].abs());
            // What is no number keeps the cube.
            let is_beyond = begin - slack > high || begin + width + slack < low;
            !is_beyond
        };
        within.is_none_or(|[x0, y0, x1, y1]| along(0, x0, x1) && along(1, y0, y1))
    }
}

#[cfg(test)]
mod tests {
    use super::{Cubes, Key};

    #[test]
    fn keys_are_read_as_they_are_written() {
        for text in ["0-0-0-0", "3-7-0-5", "31-0-0-0"] {
            assert_eq!(text.parse::<Key>().map(|key| key.to_string()), Ok(text.to_owned()));
        }
        for text in
            ["", "0-0-0", "0-0-0-0-0", "0-1-0-0", "32-0-0-0", "1-+1-0-0", "1-01-0-0", "a-0-0-0", "-1-0-0-0"]
        {
            assert_eq!(text.parse::<Key>(), Err(()), "{text}");
        }
    }

    #[test]
    fn cubes_that_touch_meet() {
        let cubes = Cubes { low: [0.0; 2], width: [8.0; 2], step: [0.01; 2] };
        let meets = |key: &str, within| cubes.meet(key.parse().expect("a key"), Some(within));
        assert!(meets("1-0-0-0", [4.0, 4.0, 5.0, 5.0]));
        assert!(meets("1-0-0-0", [4.02, 0.0, 5.0, 5.0]));
        assert!(!meets("1-0-0-0", [4.1, 4.0, 5.0, 5.0]));
        assert!(!meets("1-0-0-0", [4.0, 4.1, 5.0, 5.0]));
        assert!(meets("2-3-3-3", [0.0, 0.0, 9.0, 9.0]));
        assert!(!meets("2-3-3-3", [0.0, 0.0, 5.9, 9.0]));
        assert!(!meets("2-3-0-3", [0.0, 2.5, 9.0, 9.0]));
        assert!(cubes.meet(Key::ROOT, None));
    }
}
