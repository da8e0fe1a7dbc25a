//! Pictures of at most 256 colors, for motions: a byte a pixel, and files a fraction as long.
//!
//! The colors are those that drawings have, each on its way to white paper, which is what smooth borders of lines are. A pixel of
//! another color, such as of a line on a filled triangle, gets the nearest.

use std::collections::BTreeMap;

use super::color::{CONSTRAINT, DENSITY, DISK, EDGE, FAINT, HULL, INK, LINK, PAPER, POINT, Rgb, mix};
use super::palette::region_colors;
use super::sketch::{Tone, dark};

/// Colors of the ramp of densities, and steps of other colors to the paper.
const RAMP_COLORS: usize = 48;
const STEPS_TO_PAPER: usize = 10;

/// Colors by number.
pub(super) struct Indexed {
    colors: Vec<Rgb>,
    /// The numbers of colors that were asked for.
    known: BTreeMap<Rgb, u8>,
}

impl Indexed {
    pub(super) fn new() -> Self {
        let tones = [Tone::Faint, Tone::Seen, Tone::Old, Tone::New, Tone::Goal].map(Tone::color);
        let lines = [INK, EDGE, FAINT, HULL, POINT, DISK, LINK, CONSTRAINT];
        let mut colors = vec![PAPER];
        for color in lines.into_iter().chain(tones) {
            let way = (0..STEPS_TO_PAPER).map(|k| mix(color, PAPER, k as f64 / STEPS_TO_PAPER as f64));
            colors.extend(way);
        }
        colors.extend((0..RAMP_COLORS).map(|k| DENSITY.at(k as f64 / (RAMP_COLORS - 1) as f64)));
        colors.extend(region_colors().iter().flat_map(|&color| [color, dark(color)]));
        colors.truncate(256);
        Self { colors, known: BTreeMap::new() }
    }

    /// Red, green and blue of all colors, in their order.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.colors.as_flattened().to_vec()
    }

    /// The numbers of the colors nearest to some, given as bytes.
    pub(super) fn numbers(&mut self, colors: &[u8]) -> Vec<u8> {
        let (known, own) = (&mut self.known, &self.colors);
        let number = |color: Rgb| *known.entry(color).or_insert_with(|| nearest(own, color));
        colors.chunks_exact(3).map(|part| [part[0], part[1], part[2]]).map(number).collect()
    }
}

/// The number of the color with the least squares of differences; of several the first.
fn nearest(colors: &[Rgb], wanted: Rgb) -> u8 {
    let distance =
        |color: &Rgb| -> i32 { (0..3).map(|k| (i32::from(color[k]) - i32::from(wanted[k])).pow(2)).sum() };
    (0..colors.len()).min_by_key(|&k| distance(&colors[k])).unwrap_or_default() as u8
}

#[cfg(test)]
mod tests {
    use super::super::color::{EDGE, HULL, PAPER, mix};
    use super::Indexed;

    #[test]
    fn lines_on_paper_keep_their_colors() {
        let mut indexed = Indexed::new();
        assert!(indexed.bytes().len() <= 3 * 256);
        for t in [0.0, 0.17, 0.5, 0.83, 1.0] {
            for color in [EDGE, HULL] {
                let color = mix(color, PAPER, t);
                let [number] = indexed.numbers(&color)[..] else { panic!("one") };
                let found = &indexed.bytes()[3 * usize::from(number)..][..3];
                assert!(color.iter().zip(found).all(|(a, b)| a.abs_diff(*b) <= 12), "{color:?} {found:?}");
            }
        }
    }
}
