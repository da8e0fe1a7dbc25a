//! The switches of Shewchuk's Triangle, in its grammar: letters in any order, numbers glued to some of them.

/// The effect of a letter here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    /// The effect that it has there.
    Same,
    /// Nothing: it chooses what does not matter here.
    Ignored,
}

/// All letters, with the numbers that they take and what they mean.
const LETTERS: &[(char, &str, Effect, &str)] = &[
    ('p', "p", Effect::Same, "read segments, holes and regions of the .poly file"),
    ('r', "r", Effect::Same, "refine the mesh of the .node and .ele files again"),
    ('q', "q[ANGLE]", Effect::Same, "no smaller angles than this, 20 without a number (--min-angle)"),
    (
        'a',
        "a[AREA]",
        Effect::Same,
        "no larger triangles (--max-area); alone: as regions say, or with r the .area file",
    ),
    ('u', "u", Effect::Same, "a size of one's own: say it with --size"),
    ('A', "A", Effect::Same, "write the region of each triangle"),
    ('c', "c", Effect::Same, "keep the bays of the convex hull (--convex)"),
    ('D', "D", Effect::Same, "make it conforming Delaunay (--conforming)"),
    (
        'Y',
        "Y[Y]",
        Effect::Same,
        "do not split the border (--keep border); YY: nor any segment (--keep constraints)",
    ),
    ('S', "S[COUNT]", Effect::Same, "so many new vertices at most, 0 without a number (--max-vertices)"),
    ('O', "O", Effect::Same, "ignore holes (--ignore-holes)"),
    ('o', "o2", Effect::Same, "triangles of six nodes (--second-order)"),
    ('j', "j", Effect::Same, "drop vertices of no triangle (--drop-unused)"),
    ('z', "z", Effect::Same, "count from 0"),
    ('e', "e", Effect::Same, "write the .edge file"),
    ('n', "n", Effect::Same, "write the .neigh file"),
    ('v', "v", Effect::Same, "write the .v.node and .v.edge files"),
    ('g', "g", Effect::Same, "write the .off file"),
    ('B', "B", Effect::Same, "write no markers of points and segments"),
    ('P', "P", Effect::Same, "write no .poly file"),
    ('N', "N", Effect::Same, "write no .node file"),
    ('E', "E", Effect::Same, "write no .ele file"),
    ('I', "I", Effect::Same, "no number in names of files; no .poly is written, and no .node that was read"),
    ('C', "C", Effect::Same, "prove the result (--check)"),
    ('Q', "Q", Effect::Same, "quiet"),
    ('V', "V[VV]", Effect::Same, "print a histogram of angles (--histogram)"),
    ('h', "h", Effect::Same, "print this table"),
    ('X', "X", Effect::Ignored, "inexact arithmetic: every decision is exact"),
    ('i', "i", Effect::Ignored, "algorithm: the result is the same"),
    ('F', "F", Effect::Ignored, "algorithm: the result is the same"),
    ('l', "l", Effect::Ignored, "algorithm: the result is the same"),
    ('s', "s", Effect::Ignored, "force segments in by splitting them: they are edges anyway"),
];

/// The switches given.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Switches {
    letters: String,
    /// The number of `q`.
    pub(crate) min_angle: Option<f64>,
    /// The number of `a`.
    pub(crate) max_area: Option<f64>,
    /// Whether there is an `a` without a number.
    pub(crate) has_areas: bool,
    /// The number of `S`.
    pub(crate) max_vertices: Option<usize>,
}

impl Switches {
    /// Reads switches, perhaps after a hyphen.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut switches = Self::default();
        let mut rest: Vec<(usize, char)> = text.chars().enumerate().map(|(i, c)| (i + 1, c)).collect();
        rest.reverse();
        if text.starts_with('-') {
            rest.pop();
        }
        while let Some((at, letter)) = rest.pop() {
            if !LETTERS.iter().any(|known| known.0 == letter) {
                let hint = if letter.is_ascii_digit() || letter == '.' {
                    "numbers follow q, a, S and o"
                } else {
                    "see the table in delone mesh --help"
                };
                return Err(format!("there is no switch {letter:?}, which is at position {at}: {hint}"));
            }
            switches.letters.push(letter);
            let is_part = |c: char| c.is_ascii_digit() || (c == '.' && "qa".contains(letter));
            let mut digits = String::new();
            while "qaSo".contains(letter)
                && let Some((_, digit)) = rest.pop_if(|next| is_part(next.1))
            {
                digits.push(digit);
            }
            let wrong = |what: &str| format!("the switch {letter} at position {at} {what}");
            let number = match &digits[..] {
                "" => None,
                _ => Some(
                    digits.parse::<f64>().map_err(|_| wrong(&format!("has {digits}, which is no number")))?,
                ),
            };
            match letter {
                'q' => switches.min_angle = Some(number.unwrap_or(20.0)),
                'a' if number.is_none() => switches.has_areas = true,
                'a' => switches.max_area = number,
                'S' if digits.is_empty() => switches.max_vertices = Some(0),
                'S' => {
                    let count =
                        digits.parse().map_err(|_| wrong(&format!("has {digits}, which is too many")))?;
                    switches.max_vertices = Some(count);
                }
                'o' if digits != "2" => return Err(wrong("wants the number 2, as in o2")),
                _ => {}
            }
        }
        Ok(switches)
    }

    /// Whether a letter is among them.
    pub(crate) fn has(&self, letter: char) -> bool {
        self.letters.contains(letter)
    }

    /// How often.
    pub(crate) fn count(&self, letter: char) -> usize {
        self.letters.matches(letter).count()
    }

    /// The switches that change nothing, each once, with the reason.
    pub(crate) fn ignored(&self) -> impl Iterator<Item = (char, &'static str)> + '_ {
        let ignored = LETTERS.iter().filter(|known| known.2 == Effect::Ignored && self.has(known.0));
        ignored.map(|&(letter, _, _, text)| (letter, text))
    }
}

/// The table of letters.
pub(crate) fn table() -> String {
    let line = |&(_, usage, effect, text): &(char, &str, Effect, &str)| {
        let ignored = if effect == Effect::Ignored { "ignored; " } else { "" };
        format!("  {usage:<9} {ignored}{text}\n")
    };
    LETTERS.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::{LETTERS, Switches, table};

    #[test]
    fn numbers_are_glued_to_letters() {
        // Text, letters, q, a, a alone, S.
        type Row = (&'static str, &'static str, Option<f64>, Option<f64>, bool, Option<usize>);
        let rows: &[Row] = &[
            ("", "", None, None, false, None),
            ("p", "p", None, None, false, None),
            ("-p", "p", None, None, false, None),
            ("pq", "pq", Some(20.0), None, false, None),
            ("pq30a.1", "pqa", Some(30.0), Some(0.1), false, None),
            ("q33.5a0.1", "qa", Some(33.5), Some(0.1), false, None),
            ("q33.5a", "qa", Some(33.5), None, true, None),
            ("aa5", "aa", None, Some(5.0), true, None),
            ("a5a", "aa", None, Some(5.0), true, None),
            ("a5q", "aq", Some(20.0), Some(5.0), false, None),
            ("a1a2", "aa", None, Some(2.0), false, None),
            ("q20.q0", "qq", Some(0.0), None, false, None),
            ("S", "S", None, None, false, Some(0)),
            ("S100Y", "SY", None, None, false, Some(100)),
            ("S007", "S", None, None, false, Some(7)),
            ("YY", "YY", None, None, false, None),
            ("o2", "o", None, None, false, None),
            ("VVV", "VVV", None, None, false, None),
            (
                "praq31.25AcDjevngBPNEIOXzo2YSiFlsCQVh",
                "praqAcDjevngBPNEIOXzoYSiFlsCQVh",
                Some(31.25),
                None,
                true,
                Some(0),
            ),
        ];
        for &(text, letters, min_angle, max_area, has_areas, max_vertices) in rows {
            let expected =
                Switches { letters: letters.to_owned(), min_angle, max_area, has_areas, max_vertices };
            assert_eq!(Switches::parse(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn wrong_letters_are_named_with_their_position() {
        for (text, named) in [
            ("pw", "no switch 'w', which is at position 2"),
            ("-pw", "no switch 'w', which is at position 3"),
            ("p3", "no switch '3', which is at position 2"),
            ("S1.5", "no switch '.', which is at position 3"),
            ("o", "switch o at position 1 wants the number 2"),
            ("po3", "switch o at position 2 wants the number 2"),
            ("pq1.2.3", "switch q at position 2 has 1.2.3"),
            ("a.", "switch a at position 1 has ."),
            ("S99999999999999999999999", "switch S at position 1 has 99999"),
            ("q-5", "no switch '-', which is at position 2"),
            ("q1e3S1e3", "no switch '3', which is at position 4"),
            ("--p", "no switch '-', which is at position 2"),
            ("p q", "no switch ' ', which is at position 2"),
            ("pä", "no switch 'ä', which is at position 2"),
        ] {
            let error = Switches::parse(text).expect_err(text);
            assert!(error.contains(named), "{text}: {error}");
        }
    }

    #[test]
    fn every_letter_of_triangle_is_known() {
        let known: Vec<char> = LETTERS.iter().map(|known| known.0).collect();
        let mut sorted = known.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), known.len());
        assert!("prqauAcDjevngBPNEIOXzoYSiFlsCQVh".chars().all(|letter| known.contains(&letter)));
        assert_eq!(table().lines().count(), known.len());
        let ignored: String = Switches::parse("piXFpi").expect("known").ignored().map(|one| one.0).collect();
        assert_eq!(ignored, "XiF");
    }
}
