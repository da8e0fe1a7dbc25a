//! Names of regions and boundaries, by their numbers, and what formats make of them.
//!
//! A number has one name, and a name is that of one number of a kind: programs that know groups by their names would join two.

use std::cmp::Ordering;

use crate::error::listed;
use crate::features::numbered;
use crate::{Error, Remark};

/// Names of regions and of boundaries.
///
/// ```
/// use delone_io::Names;
///
/// let mut names = Names::default();
/// names.name_boundary(2, "inlet")?;
/// names.name_region(1.0, "steel")?;
/// assert_eq!((names.boundary(2), names.region(7.0)), (Some("inlet"), None));
/// assert!(names.name_boundary(3, "inlet").is_err(), "it is that of boundary 2");
/// # Ok::<(), delone_io::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    boundaries: List<i64>,
    regions: List<f64>,
}

impl Names {
    /// Names the boundary of a marker. White space around a name is none of it, and an empty name is none.
    ///
    /// # Errors
    /// [`Error::TwoNames`] if it has another name, [`Error::SharedName`] if another boundary has that name.
    pub fn name_boundary(&mut self, marker: i64, name: &str) -> Result<(), Error> {
        self.boundaries.add("boundary", marker, name)
    }

    /// Names the region of a number.
    ///
    /// # Errors
    /// As [`Names::name_boundary`].
    pub fn name_region(&mut self, number: f64, name: &str) -> Result<(), Error> {
        self.regions.add("region", number, name)
    }

    /// The name of a boundary.
    pub fn boundary(&self, marker: i64) -> Option<&str> {
        self.boundaries.get(marker)
    }

    /// The name of a region.
    pub fn region(&self, number: f64) -> Option<&str> {
        self.regions.get(number)
    }

    /// The boundaries that have names, by increasing marker.
    pub fn boundaries(&self) -> &[(i64, String)] {
        &self.boundaries.0
    }

    /// The regions that have names, by increasing number.
    pub fn regions(&self) -> &[(f64, String)] {
        &self.regions.0
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.boundaries.0.is_empty() && self.regions.0.is_empty()
    }

    /// Takes the names of another file.
    ///
    /// # Errors
    /// As [`Names::name_boundary`].
    pub fn join(&mut self, other: &Self) -> Result<(), Error> {
        self.boundaries.join("boundary", &other.boundaries, false)?;
        self.regions.join("region", &other.regions, false)
    }

    /// Takes the names of numbers that have none here.
    ///
    /// # Errors
    /// [`Error::SharedName`] if another number has such a name.
    pub fn complete(&mut self, other: &Self) -> Result<(), Error> {
        self.boundaries.join("boundary", &other.boundaries, true)?;
        self.regions.join("region", &other.regions, true)
    }
}

/// Names by increasing number.
#[derive(Clone, Debug, PartialEq)]
struct List<N>(Vec<(N, String)>);

impl<N> Default for List<N> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<N: Number> List<N> {
    fn place(&self, number: N) -> Result<usize, usize> {
        self.0.binary_search_by(|entry| entry.0.order(&number))
    }

    fn get(&self, number: N) -> Option<&str> {
        self.place(number).ok().map(|at| &self.0[at].1[..])
    }

    fn add(&mut self, what: &'static str, number: N, name: &str) -> Result<(), Error> {
        let name = name.trim();
        if name.is_empty() {
            return Ok(());
        }
        match self.place(number) {
            Ok(at) if self.0[at].1 == name => Ok(()),
            Ok(at) => {
                let names = Box::new([self.0[at].1.clone(), name.to_owned()]);
                Err(Error::TwoNames { what, number: number.text(), names })
            }
            Err(at) => {
                if let Some(same) = self.0.iter().find(|entry| entry.1 == name) {
                    let mut numbers = [same.0, number];
                    numbers.sort_by(N::order);
                    let numbers = Box::new(numbers.map(N::text));
                    return Err(Error::SharedName { what, name: name.to_owned(), numbers });
                }
                self.0.insert(at, (number, name.to_owned()));
                Ok(())
            }
        }
    }

    fn join(&mut self, what: &'static str, other: &Self, yields: bool) -> Result<(), Error> {
        let missing = |(number, _): &&(N, String)| !yields || self.get(*number).is_none();
        let more: Vec<&(N, String)> = other.0.iter().filter(missing).collect();
        more.into_iter().try_for_each(|(number, name)| self.add(what, *number, name))
    }
}

/// The numbers that elements share.
pub(crate) trait Number: Copy {
    fn order(&self, other: &Self) -> Ordering;
    fn text(self) -> String;
    /// The number in a name: digits, letters and hyphens alone, because other characters mean something in some formats.
    fn label(self) -> String {
        self.text().replace('.', "p")
    }
    /// The number as a double, which rounds those of many digits.
    fn value(self) -> f64;
    /// The number as a whole one of 32 bits with sign.
    fn whole(self) -> Option<i32>;
    /// The number as a tag, which is positive.
    fn tag(self) -> Option<u32> {
        self.whole().filter(|&whole| whole > 0).map(i32::unsigned_abs)
    }
}

impl Number for i64 {
    fn order(&self, other: &Self) -> Ordering {
        self.cmp(other)
    }

    fn text(self) -> String {
        self.to_string()
    }

    fn value(self) -> f64 {
        self as f64
    }

    fn whole(self) -> Option<i32> {
        i32::try_from(self).ok()
    }
}

impl Number for f64 {
    /// There is one zero, and one number that is none.
    fn order(&self, other: &Self) -> Ordering {
        self.partial_cmp(other).unwrap_or_else(|| self.is_nan().cmp(&other.is_nan()))
    }

    fn text(self) -> String {
        // Zero has no sign here.
        let digits = format!("{:?}", self + 0.0);
        digits.strip_suffix(".0").unwrap_or(&digits).to_owned()
    }

    fn value(self) -> f64 {
        self
    }

    fn whole(self) -> Option<i32> {
        let is_whole = self.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&self);
        is_whole.then_some(self as i32)
    }
}

/// Names that a format permits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule {
    /// The bytes of the longest.
    pub(crate) longest: usize,
    /// Whether a character may be in a name.
    pub(crate) permits: fn(char) -> bool,
    /// Whether a name may begin with it; another one has a letter before.
    pub(crate) begins: fn(char) -> bool,
    /// Whether capitals make no difference.
    pub(crate) ignores_case: bool,
}

impl Rule {
    /// Words of letters, digits, underscores and hyphens, which begin with a letter.
    pub(crate) const WORD: Self = Self {
        longest: 80,
        permits: |c| c.is_ascii_alphanumeric() || c == '_' || c == '-',
        begins: |c| c.is_ascii_alphabetic(),
        ignores_case: true,
    };

    /// Texts in quotes, or up to the end of a line.
    pub(crate) const TEXT: Self = Self {
        longest: 120,
        permits: |c| c != '"' && !c.is_control(),
        begins: |_| true,
        ignores_case: false,
    };

    /// Makes names permitted and distinct: other characters become underscores, and of equal names all but the first end in a
    /// number. Tells each change.
    pub(crate) fn of<'a>(
        &self,
        names: impl Iterator<Item = &'a str>,
        changed: &mut Vec<String>,
    ) -> Vec<String> {
        let folded = |name: &str| if self.ignores_case { name.to_ascii_lowercase() } else { name.to_owned() };
        let mut taken: Vec<String> = Vec::new();
        let mut found = Vec::new();
        for name in names {
            let mut own: String = name.chars().map(|c| if (self.permits)(c) { c } else { '_' }).collect();
            if !own.starts_with(self.begins) {
                own.insert_str(0, "n_");
            }
            cut(&mut own, self.longest);
            let is_taken = |own: &str| taken.contains(&folded(own));
            if is_taken(&own) {
                // Room for the number.
                cut(&mut own, self.longest.saturating_sub(NUMBER_BYTES));
                own = numbered(&own, is_taken);
            }
            taken.push(folded(&own));
            if own != name {
                changed.push(format!("{name:?} is {own}"));
            }
            found.push(own);
        }
        found
    }
}

/// The bytes of an underscore and the longest number after a name.
const NUMBER_BYTES: usize = 11;

/// Cuts a text down to so many bytes.
fn cut(text: &mut String, longest: usize) {
    let end = (0..=longest.min(text.len())).rev().find(|&end| text.is_char_boundary(end));
    text.truncate(end.unwrap_or_default());
}

/// A remark on names that are changed.
pub(crate) fn told(changed: &[String]) -> Remark {
    (!changed.is_empty()).then(|| {
        format!("names that it does not permit are changed: {}", listed(changed.iter().map(String::as_str)))
    })
}

/// One remark of several.
pub(crate) fn together(remarks: impl IntoIterator<Item = Remark>) -> Remark {
    let all: Vec<String> = remarks.into_iter().flatten().collect();
    (!all.is_empty()).then(|| all.join("; "))
}

#[cfg(test)]
mod tests {
    use super::{Names, Rule, cut};

    #[test]
    fn one_name_a_number_and_one_number_a_name() {
        let mut names = Names::default();
        names.name_boundary(7, " wall ").expect("new");
        names.name_boundary(7, "wall").expect("equal");
        names.name_boundary(-1, "").expect("none");
        names.name_region(-0.0, "wall").expect("of another kind");
        assert_eq!(
            (names.boundary(7), names.boundary(-1), names.region(0.0)),
            (Some("wall"), None, Some("wall"))
        );
        let error = |outcome: Result<(), crate::Error>| outcome.expect_err("refused").to_string();
        assert_eq!(error(names.name_boundary(7, "inlet")), "boundary 7 is named \"wall\" and \"inlet\"");
        assert_eq!(
            error(names.name_boundary(3, "wall")),
            "the name \"wall\" is that of boundary 3 and of boundary 7"
        );
        let mut others = Names::default();
        others.name_boundary(7, "other").expect("new");
        others.name_region(2.5, "soft").expect("new");
        assert!(names.clone().join(&others).is_err());
        names.complete(&others).expect("the name that is there stays");
        assert_eq!((names.boundary(7), names.region(2.5)), (Some("wall"), Some("soft")));
    }

    #[test]
    fn names_become_permitted_and_stay_distinct() {
        let long = "x".repeat(90);
        let mut changed = Vec::new();
        let names = ["in let", "In_Let", "7up", "ä", &long, &long, "fine"];
        let found = Rule::WORD.of(names.into_iter(), &mut changed);
        assert_eq!(found[..4], ["in_let", "In_Let_2", "n_7up", "n__"]);
        assert_eq!((found[4].len(), &found[5][69..], &found[6][..]), (80, "_2", "fine"));
        assert_eq!((changed.len(), &changed[0][..]), (6, "\"in let\" is in_let"));
        let mut changed = Vec::new();
        assert_eq!(
            Rule::TEXT.of(["a \"b\"", "ä ö", "A", "a"].into_iter(), &mut changed),
            ["a _b_", "ä ö", "A", "a"]
        );
        let mut text = "aä".to_owned();
        cut(&mut text, 2);
        assert_eq!(text, "a");
    }
}
