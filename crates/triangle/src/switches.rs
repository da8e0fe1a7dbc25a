//! The switches, in the grammar of Triangle's library.
//!
//! Clients send switches as Python prints them, `Qz{pq}`: what is no letter of ours does not count. Numbers are digits with a point, whatever
//! the locale, and without an exponent: `q1e3` is `q1`, `e`, and a 3 that does not count.

use delone::Keep;

use crate::fault::{Fault, Status};

/// The bound of switch q without a number, in degrees.
const DEFAULT_ANGLE: f64 = 20.0;

/// See the module.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(clippy::struct_excessive_bools)]
pub(crate) struct Switches {
    /// p: segments are read.
    pub(crate) poly: bool,
    /// r: triangles are read.
    pub(crate) refine: bool,
    /// Whether vertices may be added: q, a, u, D.
    pub(crate) quality: bool,
    pub(crate) min_angle: f64,
    /// a with a number.
    pub(crate) max_area: Option<f64>,
    /// a without: areas of regions, or of the triangles that are read.
    pub(crate) areas: bool,
    /// A
    pub(crate) attributes: bool,
    /// c
    pub(crate) convex: bool,
    /// D
    pub(crate) conforming: bool,
    /// Y, YY
    pub(crate) keep: Keep,
    /// S
    pub(crate) max_vertices: Option<usize>,
    /// O
    pub(crate) no_holes: bool,
    /// j
    pub(crate) jettison: bool,
    /// o2
    pub(crate) second_order: bool,
    /// e
    pub(crate) edges: bool,
    /// n
    pub(crate) neighbors: bool,
    /// v
    pub(crate) voronoi: bool,
    /// B
    pub(crate) no_markers: bool,
    /// N
    pub(crate) no_vertices: bool,
    /// E
    pub(crate) no_triangles: bool,
    /// P
    pub(crate) no_segments: bool,
    /// u
    pub(crate) user: bool,
    /// The number of the first row: 0 by z.
    pub(crate) base: i32,
}

/// A place in the text.
struct Reader<'a> {
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn next(&mut self) -> Option<u8> {
        let letter = self.text.get(self.at).copied();
        self.at += 1;
        letter
    }

    /// The digits that follow.
    fn digits(&mut self) -> &str {
        let rest = &self.text[self.at..];
        let count = rest.iter().take_while(|c| c.is_ascii_digit()).count();
        self.at += count;
        std::str::from_utf8(&rest[..count]).unwrap_or_default()
    }

    /// The number that follows, if there is one: digits, or a point, or both.
    fn number(&mut self) -> Option<f64> {
        let start = self.at;
        self.digits();
        if self.text.get(self.at) == Some(&b'.') {
            self.at += 1;
            self.digits();
        }
        let word = std::str::from_utf8(&self.text[start..self.at]).unwrap_or_default();
        // A point alone is a zero.
        (!word.is_empty()).then(|| word.parse().unwrap_or(0.0))
    }
}

impl Switches {
    /// Whether switches ask for a Voronoi diagram, right or wrong as they are.
    pub(crate) fn name_voronoi(text: &[u8]) -> bool {
        text.contains(&b'v')
    }

    pub(crate) fn parse(text: &[u8]) -> Result<Self, Fault> {
        let mut s = Self { base: 1, ..Self::default() };
        let mut reader = Reader { text, at: 0 };
        while let Some(letter) = reader.next() {
            match letter {
                b'p' => s.poly = true,
                b'r' => s.refine = true,
                b'q' => s.min_angle = angle(reader.number().unwrap_or(DEFAULT_ANGLE))?,
                b'a' => match reader.number() {
                    Some(area) => s.max_area = Some(positive(area)?),
                    None => s.areas = true,
                },
                b'A' => s.attributes = true,
                b'c' => s.convex = true,
                b'D' => s.conforming = true,
                b'Y' => s.keep = if s.keep == Keep::Nothing { Keep::Border } else { Keep::Constraints },
                b'S' => s.max_vertices = Some(reader.digits().parse().unwrap_or_else(|error| most(&error))),
                b'O' => s.no_holes = true,
                b'j' => s.jettison = true,
                b'o' if reader.text.get(reader.at) == Some(&b'2') => s.second_order = true,
                b'e' => s.edges = true,
                b'n' => s.neighbors = true,
                b'v' => s.voronoi = true,
                b'B' => s.no_markers = true,
                b'N' => s.no_vertices = true,
                b'E' => s.no_triangles = true,
                b'P' => s.no_segments = true,
                b'u' => s.user = true,
                b'z' => s.base = 0,
                _ => {}
            }
            s.quality |= matches!(letter, b'q' | b'a' | b'u' | b'D');
        }
        Ok(s)
    }

    /// Whether it is a triangulation of points alone.
    pub(crate) fn is_plain(&self) -> bool {
        !self.poly && !self.refine && !self.quality
    }
}

/// The number of digits that are none, or too many.
fn most(error: &std::num::ParseIntError) -> usize {
    if *error.kind() == std::num::IntErrorKind::Empty { 0 } else { usize::MAX }
}

fn angle(degrees: f64) -> Result<f64, Fault> {
    if (0.0..60.0).contains(&degrees) {
        return Ok(degrees);
    }
    let words = format!("switch q: {degrees} degrees must be less than 60; up to 34 are reached as a rule");
    Err(Fault::new(Status::Argument, words))
}

fn positive(area: f64) -> Result<f64, Fault> {
    if area > 0.0 {
        return Ok(area);
    }
    Err(Fault::new(Status::Argument, format!("switch a: the largest area must be positive, not {area}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Switches {
        Switches::parse(text.as_bytes()).expect(text)
    }

    #[test]
    fn letters_without_a_meaning_do_not_count() {
        assert_eq!(parsed("Qz{pq}"), parsed("pqz"));
        assert_eq!(parsed("VVpFilsCgIXT"), parsed("p"));
        assert_eq!(parsed("\u{e9}p"), parsed("p"));
        assert_eq!(parsed("o"), parsed(""));
        assert!(parsed("o2").second_order && !parsed("o3").second_order);
    }

    #[test]
    fn numbers_have_no_exponent_and_one_point() {
        let angle = |text: &str| parsed(text).min_angle;
        assert_eq!(
            [angle("q"), angle("q0"), angle("q25"), angle("q.5"), angle("q28.6a")],
            [20.0, 0.0, 25.0, 0.5, 28.6]
        );
        assert!(parsed("q1e3").edges && angle("q1e3") == 1.0);
        assert_eq!(angle("q1.5.9"), 1.5);
        assert_eq!(angle("q20,5"), 20.0);
        let area = |text: &str| parsed(text).max_area;
        assert_eq!(
            [area("a"), area("a.1"), area("a10.25q"), area("a1e-8")],
            [None, Some(0.1), Some(10.25), Some(1.0)]
        );
        assert!(parsed("a").areas && parsed("a0.5a").areas && !parsed("a0.5").areas);
        assert_eq!(area("a0.0000000000000000000001"), Some(1e-22));
        let most = |text: &str| parsed(text).max_vertices;
        assert_eq!([most("S"), most("S12"), most("S1.5"), most("")], [Some(0), Some(12), Some(1), None]);
        assert_eq!(most("S99999999999999999999999"), Some(usize::MAX));
    }

    #[test]
    fn letters_add_up() {
        assert_eq!(
            [parsed("").keep, parsed("Y").keep, parsed("YY").keep, parsed("YYY").keep],
            [Keep::Nothing, Keep::Border, Keep::Constraints, Keep::Constraints]
        );
        for text in ["q", "a", "a1", "u", "D"] {
            assert!(parsed(text).quality && !parsed(text).is_plain(), "{text}");
        }
        for text in ["", "cznevj", "AYSO"] {
            assert!(parsed(text).is_plain(), "{text}");
        }
        assert_eq!((parsed("z").base, parsed("").base), (0, 1));
    }

    #[test]
    fn numbers_out_of_range_are_errors() {
        for text in ["q60", "q1000", "a0", "a.", "a0.000", "pqza0"] {
            let fault = Switches::parse(text.as_bytes()).expect_err(text);
            assert_eq!(fault.status, Status::Argument);
        }
    }
}
