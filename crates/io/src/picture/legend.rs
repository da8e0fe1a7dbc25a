//! The strip below a drawing: what its colors mean, and how long things are.
//!
//! It is laid out once, and drawn by vectors or by pixels.

use delone::Triangulation;

use super::Options;
use super::color::{ANGLE, DENSITY, HEIGHT, INK, Ramp, Rgb};
use super::palette::DISTINCT_REGIONS;
use super::png::text_width;
use super::relief::Paint;
use super::ruler::{Short, height_unit, length_label};
use super::view::{Frame, LEGEND_ROW, STRIP, View};
use crate::{Crs, Mesh};

/// Pixels at the sides of the strip, above it, and between its entries.
const SIDE: f64 = 24.0;
const ABOVE: f64 = 14.0;
const GAP: f64 = 18.0;
/// Pixels of the square of a region, and between it and its text.
const SQUARE: f64 = 18.0;
const BESIDE: f64 = 6.0;
/// The most characters of a name.
const NAME_LENGTH: usize = 40;

/// The meaning of colors.
pub(super) enum Legend {
    None,
    /// An order of colors, with texts for its beginning, its middle and its end.
    Ramp(&'static Ramp, [String; 3]),
    /// Regions by number.
    Regions(Vec<String>),
}

/// Where a text is anchored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Something in the strip: its place is its upper left corner, but that of a text the middle of its upper side, or the right end.
pub(super) enum Piece {
    Rectangle { at: [f64; 2], size: [f64; 2], color: Rgb },
    Ramp { at: [f64; 2], size: [f64; 2], ramp: &'static Ramp },
    Region { at: [f64; 2], size: [f64; 2], number: usize },
    Text { at: [f64; 2], anchor: Anchor, text: String },
}

impl Legend {
    /// That of a picture of triangles with these colors.
    pub(super) fn of(
        mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>,
        paint: &Paint,
        options: &Options,
    ) -> Self {
        match paint {
            Paint::Regions { .. } if !options.legend || options.fill == Some(false) => Self::None,
            Paint::Regions { known, .. } => {
                let label = |&value: &f64| match mesh.names.and_then(|names| names.region(value)) {
                    Some(name) => name.chars().take(NAME_LENGTH).collect(),
                    None if value.fract() == 0.0 && value.abs() < 1e15 => format!("{value}"),
                    None => format!("{value:?}"),
                };
                let mut labels: Vec<String> = known.iter().map(label).collect();
                let named = |value| mesh.names.is_some_and(|names| names.region(value).is_some());
                if let (Some(label), Some(false)) = (labels.first_mut(), known.first().copied().map(named)) {
                    label.insert_str(0, "region ");
                }
                Self::Regions(labels)
            }
            Paint::Relief(relief) => {
                Self::heights(&HEIGHT, [relief.low, relief.high], mesh.crs.or(options.crs.as_ref()))
            }
            Paint::Angles(_) => Self::words(&ANGLE, ["0", "30", "60 degrees"]),
            Paint::Density(_) => Self::words(&DENSITY, ["sparse", "", "dense"]),
        }
    }

    pub(super) fn words(ramp: &'static Ramp, words: [&str; 3]) -> Self {
        Self::Ramp(ramp, words.map(str::to_owned))
    }

    /// A ramp of heights between two of them.
    pub(super) fn heights(ramp: &'static Ramp, [low, high]: [f64; 2], crs: Option<&Crs>) -> Self {
        let unit = height_unit(crs);
        let middle = if high > low { Short(low / 2.0 + high / 2.0).to_string() } else { String::new() };
        Self::Ramp(ramp, [Short(low).to_string(), middle, format!("{}{unit}", Short(high))])
    }

    /// The rows that it takes above the scale, in a picture of some width.
    fn rows(&self, frame: &Frame, width: u32) -> usize {
        let Self::Regions(labels) = self else { return 0 };
        let (_, places) = flow(labels, f64::from(width), frame.most_rows());
        places.last().map_or(0, |&(_, row)| row + 1)
    }

    /// A view with room for it.
    pub(super) fn fit<'a>(&self, mut frame: Frame<'a>, view: impl Fn(&Frame<'a>) -> View) -> View {
        // A higher legend may make the picture narrower, which may make the legend higher.
        loop {
            let seen = view(&frame);
            let rows = self.rows(&frame, seen.width).min(frame.most_rows());
            if rows <= frame.rows {
                return seen;
            }
            frame.rows = rows;
        }
    }

    /// The strip of a view.
    pub(super) fn pieces(&self, view: &View) -> Vec<Piece> {
        let Some(top) = view.strip() else { return Vec::new() };
        let base = f64::from(view.height) - STRIP;
        let width = f64::from(view.width);
        let mut pieces = Vec::new();
        match self {
            Self::None => {}
            Self::Ramp(ramp, labels) => ramp_pieces(ramp, labels, [width, base + ABOVE], &mut pieces),
            Self::Regions(labels) => {
                let rows = ((base - top) / LEGEND_ROW).round() as usize;
                let (shown, places) = flow(labels, width, rows);
                for (number, &(x, row)) in places.iter().enumerate() {
                    let at = [x, top + BESIDE + LEGEND_ROW * row as f64];
                    let (text, beside) = if number < shown {
                        pieces.push(Piece::Region { at, size: [SQUARE; 2], number });
                        (labels[number].clone(), SQUARE + BESIDE)
                    } else {
                        (more(labels.len() - shown), 0.0)
                    };
                    pieces.push(Piece::Text { at: [x + beside, at[1] - 1.0], anchor: Anchor::Start, text });
                }
            }
        }
        scale_pieces(view, [width, base + ABOVE], &mut pieces);
        pieces
    }
}

/// The text for regions that are not listed.
fn more(count: usize) -> String {
    format!("and {count} more")
}

/// How many labels fit into some rows, and the places of these and of the rest, which is counted.
fn flow(labels: &[String], width: f64, rows: usize) -> (usize, Vec<(f64, usize)>) {
    let right = width - SIDE;
    let place = |shown: usize| {
        let (mut x, mut row, mut places) = (SIDE, 0, Vec::new());
        let widths = labels.iter().take(shown).map(|label| SQUARE + BESIDE + text_width(label));
        let rest = (shown < labels.len()).then(|| text_width(&more(labels.len() - shown)));
        for wide in widths.chain(rest) {
            if x > SIDE && x + wide > right {
                (x, row) = (SIDE, row + 1);
            }
            places.push((x, row));
            x += wide + GAP;
        }
        places
    };
    let fits = |places: &Vec<(f64, usize)>| places.last().is_none_or(|&(_, row)| row < rows);
    let most = labels.len().min(DISTINCT_REGIONS);
    let found = (1..=most).rev().map(|shown| (shown, place(shown))).find(|(_, places)| fits(places));
    found.unwrap_or_default()
}

fn ramp_pieces(ramp: &'static Ramp, labels: &[String; 3], [width, y]: [f64; 2], pieces: &mut Vec<Piece>) {
    let bar = (width / 2.0 - SIDE).min(480.0);
    pieces.push(Piece::Ramp { at: [SIDE, y], size: [bar, 12.0], ramp });
    let [low, middle, high] = labels;
    let wide: f64 = labels.iter().map(|label| text_width(label)).sum();
    let mut put = |x: f64, anchor: Anchor, text: &String| {
        let mark = [x - if anchor == Anchor::End { 2.0 } else { 0.0 }, y + 12.0];
        pieces.push(Piece::Rectangle { at: mark, size: [2.0, 3.0], color: INK });
        pieces.push(Piece::Text { at: [x, y + 16.0], anchor, text: text.clone() });
    };
    put(SIDE, Anchor::Start, low);
    if !middle.is_empty() && wide + 2.0 * GAP < bar {
        put(SIDE + bar / 2.0, Anchor::Middle, middle);
    }
    put(SIDE + bar, Anchor::End, high);
}

fn scale_pieces(view: &View, [width, y]: [f64; 2], pieces: &mut Vec<Piece>) {
    let Some((length, pixels, is_metres)) = view.scale_bar() else { return };
    let label = length_label(length, is_metres);
    // A long text under a short bar stays in the picture.
    let half = (text_width(&label).max(pixels)) / 2.0;
    let middle = width - SIDE - half;
    let left = middle - pixels / 2.0;
    pieces.push(Piece::Rectangle { at: [left, y + 4.0], size: [pixels, 3.0], color: INK });
    for x in [left, left + pixels - 2.0] {
        pieces.push(Piece::Rectangle { at: [x, y], size: [2.0, 11.0], color: INK });
    }
    pieces.push(Piece::Text { at: [middle, y + 16.0], anchor: Anchor::Middle, text: label });
}
