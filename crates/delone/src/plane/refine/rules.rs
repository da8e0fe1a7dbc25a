//! The criteria of a mesh, as numbers that are fast to compare.

use std::cell::Cell;
use std::ops::Range;

use delone_predicates::lexicographic;

use super::shape::Shape;
use super::{Keep, Placement, Refinement};
use crate::error::Error;
use crate::plane::Domains2;
use crate::plane::constrained::Before;

/// A lens around constraints is at least as wide as for this angle, in degrees.
const NARROWEST: f64 = 20.0;
/// Off-centers are this part of the way: what is made passes with room to spare (Shewchuk's choice).
const SHORT: f64 = 0.95;

/// Edges are in the mean this part of a longest one: so few are longer.
const OF_LONGEST: f64 = 0.75;
/// Triangles are in the mean this part of a largest one.
const OF_LARGEST: f64 = 0.7;

/// The length of edges of triangles with an area that is a bound.
fn of_area(largest: f64) -> f64 {
    (OF_LARGEST * largest * (4.0 / 3.0_f64.sqrt())).sqrt()
}

/// The default limit of new vertices that serve angles, where the caller sets none: a gap as narrow as a rounding error would take
/// more than memory holds. The limit is the larger of this number and a multiple of the number of points, and grows with sizes.
const MAX_VERTICES_FOR_ANGLES: usize = 1 << 21;
const EACH: usize = 64;
const AROUND: usize = 16;

/// See the module.
#[derive(Clone)]
pub(super) struct Rules<'a> {
    /// Of the smallest angle; more than one if there is no bound.
    pub(super) squared_cosine: f64,
    /// A point sees a constraint under an obtuse angle of at least this squared cosine: it is too near.
    pub(super) lens: f64,
    /// Off-centers are at most so many times the length of the shortest edge from its middle.
    pub(super) reach: f64,
    /// Where vertices for the sake of angles are.
    pub(super) placement: Placement,
    pub(super) conforming: bool,
    /// The square of the longest constraint.
    pub(super) longest_constraint: f64,
    /// New vertices that there may be at most.
    most: usize,
    /// And for the sake of angles, before and for each one that was asked for by a size.
    for_angles: usize,
    keep: Keep,
    /// The square of the longest edge.
    squared_longest: f64,
    /// The square of the shortest edge with a new vertex.
    pub(super) squared_least: f64,
    /// The length that edges are to have, if that is the same everywhere; infinite if nothing is said.
    length: f64,
    length_at: Option<Field<'a>>,
    /// By domain, those inside from 1 on; there is nothing at 0.
    areas: Vec<f64>,
    /// The squares of the longest edges, by domain.
    squared_lengths: Vec<f64>,
    /// The lengths that edges are to have, by domain.
    wanted_lengths: Vec<f64>,
    /// Domains of boundary layers.
    layers: Range<usize>,
    /// Whether there is any bound of sizes, and whether one is asked for each place.
    has_sizes: bool,
    has_fields: bool,
    area_at: Option<Field<'a>>,
    size_at: Option<Field<'a>>,
    refine_if: Option<Test<'a>>,
    flaw: Cell<Option<(f64, [f64; 2])>>,
    stop: Option<&'a dyn Fn() -> bool>,
    watch: Option<&'a dyn Fn(usize)>,
}

/// Whether a triangle is to be refined, by its corners and its area.
pub(super) type Test<'a> = &'a dyn Fn([[f64; 2]; 3], f64) -> bool;

/// A number for each place.
pub(super) type Field<'a> = &'a dyn Fn([f64; 2]) -> f64;

impl std::fmt::Debug for Rules<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rules").field("squared_cosine", &self.squared_cosine).finish_non_exhaustive()
    }
}

impl<'a> Rules<'a> {
    /// Of a refinement; regions may have largest areas of their own.
    pub(super) fn new(wanted: &Refinement<'a>, domains: &Domains2, before: &Before) -> Self {
        let angle = wanted.min_angle.to_radians();
        let general = wanted.max_area.unwrap_or(f64::INFINITY);
        let area = |region: Option<usize>| region.and_then(|r| domains.regions[r].max_area);
        let own = |&part: &usize| area(domains.parts()[part].region).map_or(general, |own| own.min(general));
        let areas = before.parts[..before.inside].iter().map(own);
        let lens = libm::cos(2.0 * angle.max(NARROWEST.to_radians()));
        let areas: Vec<f64> = std::iter::once(f64::INFINITY).chain(areas).collect();
        let of_region = |region: Option<usize>| region.and_then(|r| domains.regions[r].max_edge);
        let lengths = before.parts[..before.inside]
            .iter()
            .map(|&part| of_region(domains.parts()[part].region).unwrap_or(f64::INFINITY));
        let lengths: Vec<f64> = std::iter::once(f64::INFINITY).chain(lengths).collect();
        // A wish is no bound.
        let is_wish = wanted.edge.is_some() || wanted.edge_at.is_some();
        let none = vec![f64::INFINITY; lengths.len()];
        let has_lengths = !is_wish && lengths.iter().any(|length| length.is_finite());
        let [wanted_lengths, lengths] = if is_wish { [lengths, none] } else { [none, lengths] };
        let longest = wanted.max_edge.unwrap_or(f64::INFINITY);
        let squared_lengths = lengths.iter().map(|length| longest.min(*length).powi(2)).collect();
        let has_fields = wanted.area_at.is_some() || wanted.size_at.is_some() || wanted.refine_if.is_some();
        let unasked = MAX_VERTICES_FOR_ANGLES.max(EACH * before.given);
        // A function may say yes for ever.
        let room = if wanted.refine_if.is_some() { unasked.min(before.room) } else { before.room };
        Self {
            squared_cosine: if angle > 0.0 { libm::cos(angle) * libm::cos(angle) } else { 2.0 },
            lens: lens * lens,
            reach: SHORT * 0.5 / libm::tan(0.5 * angle.max(NARROWEST.to_radians())),
            placement: wanted.placement,
            conforming: wanted.conforming,
            longest_constraint: wanted.max_edge.map_or(f64::INFINITY, |length| length * length),
            most: wanted.max_vertices.map_or(room, |most| most.min(before.room)),
            for_angles: wanted.max_vertices.map_or(unasked, |_| before.room),
            keep: wanted.keep,
            squared_least: wanted.min_edge * wanted.min_edge,
            squared_longest: wanted.max_edge.map_or(f64::INFINITY, |length| length * length),
            has_sizes: has_fields
                || has_lengths
                || wanted.max_edge.is_some()
                || areas.iter().any(|area| area.is_finite()),
            layers: before.inside + 1..before.with_layers + 1,
            areas,
            squared_lengths,
            wanted_lengths,
            has_fields,
            length: wanted.edge.unwrap_or(f64::INFINITY),
            length_at: wanted.edge_at,
            area_at: wanted.area_at,
            size_at: wanted.size_at,
            refine_if: wanted.refine_if,
            flaw: Cell::new(None),
            stop: wanted.stop,
            watch: wanted.watch,
        }
    }

    /// Whether a triangle is larger than it may be. A bound that is none is remembered.
    #[inline]
    pub(super) fn is_large(&self, shape: &Shape, domain: usize) -> bool {
        self.has_sizes
            && (shape.longest() > self.squared_lengths[domain]
                || shape.area() > self.areas[domain]
                || (self.has_fields && self.is_larger_than_wanted(shape)))
    }

    /// The value of a field at a place. Of values that are none the one at the least place is remembered, whatever the order of the places.
    fn asked(&self, field: Option<Field>, at: [f64; 2]) -> f64 {
        let value = field.map_or(f64::INFINITY, |field| field(at));
        if value > 0.0 {
            return value;
        }
        if self.flaw.get().is_none_or(|flaw| lexicographic(at, flaw.1).is_lt()) {
            self.flaw.set(Some((value, at)));
        }
        f64::INFINITY
    }

    fn is_larger_than_wanted(&self, shape: &Shape) -> bool {
        let at = shape.centroid();
        let asked = |field| self.asked(field, at);
        let size = asked(self.size_at);
        shape.area() > asked(self.area_at)
            || shape.longest() > size * size
            || self.refine_if.is_some_and(|is_to_be_refined| is_to_be_refined(shape.points, shape.area()))
    }

    /// How long edges may be at a place of a domain, about, in coordinate units. What is refused for being too small is far below.
    pub(super) fn size_at(&self, at: [f64; 2], domain: usize) -> f64 {
        if !self.has_sizes {
            return f64::INFINITY;
        }
        let asked = |field: Option<Field>| field.map_or(f64::INFINITY, |field| field(at)).max(0.0);
        let area = self.areas.get(domain).copied().unwrap_or(f64::INFINITY).min(asked(self.area_at));
        let length = self.squared_lengths.get(domain).copied().unwrap_or(self.squared_longest);
        length.min(area).sqrt().min(asked(self.size_at))
    }

    /// The length that edges are to have at a place, by what was asked for or what the bounds there let reach.
    pub(super) fn length_at(&self, at: [f64; 2]) -> f64 {
        let asked = |field| self.asked(field, at);
        let bound = self.squared_longest.sqrt().min(asked(self.size_at));
        let length = self.length.min(asked(self.length_at)).min(OF_LONGEST * bound);
        length.min(of_area(asked(self.area_at)))
    }

    /// The length that edges are to have in a domain, by the bound of areas there.
    pub(super) fn length_in(&self, domain: usize) -> f64 {
        let of = |lengths: &[f64]| lengths.get(domain).copied().unwrap_or(f64::INFINITY);
        of_area(of(&self.areas)).min(of(&self.wanted_lengths))
    }

    /// The square of the longest constraint between domains.
    pub(super) fn longest_between(&self, domains: [usize; 2]) -> f64 {
        let of = |domain: usize| self.squared_lengths.get(domain).copied().unwrap_or(f64::INFINITY);
        self.longest_constraint.min(of(domains[0])).min(of(domains[1]))
    }

    /// The largest length that edges are to have anywhere.
    pub(super) fn longest_length(&self) -> f64 {
        self.length
    }

    /// The largest number of new vertices.
    pub(super) fn most(&self) -> usize {
        self.most
    }

    /// Not if a bound was none, or somebody wants to stop, who is told the number of new vertices.
    pub(super) fn go_on(&self, count: usize) -> Result<(), Error> {
        if let Some(watch) = self.watch {
            watch(count);
        }
        match self.flaw.get() {
            Some((value, at)) => Err(Error::Size { value, at }),
            None if self.stop.is_some_and(|stop| stop()) => Err(Error::Stopped),
            None => Ok(()),
        }
    }

    /// Whether a constraint may not be split, with the mesh on both sides or on one.
    pub(super) fn keeps(&self, is_between: bool) -> bool {
        match self.keep {
            Keep::Nothing => false,
            Keep::Border => !is_between,
            Keep::Constraints => true,
        }
    }

    /// Whether there are enough new vertices, so many of them for the sake of sizes.
    #[inline]
    pub(super) fn is_enough(&self, count: usize, for_sizes: usize, is_for_size: bool) -> bool {
        let for_angles = self.for_angles.saturating_add(AROUND.saturating_mul(for_sizes));
        count >= if is_for_size { self.most } else { self.most.min(for_angles) }
    }

    /// Whether constraints are split because of vertices that are too near, before any is added.
    pub(super) fn clears_constraints(&self) -> bool {
        self.conforming || self.squared_cosine <= 1.0
    }

    /// Whether a domain is inside.
    #[inline]
    pub(super) fn is_inside(&self, domain: usize) -> bool {
        domain > 0 && domain < self.areas.len()
    }

    /// Whether a domain is a boundary layer.
    #[inline]
    pub(super) fn is_layer(&self, domain: usize) -> bool {
        self.layers.contains(&domain)
    }
}
