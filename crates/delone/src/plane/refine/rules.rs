//! What is wanted of a mesh, as numbers that are quick to ask.

use super::shape::Shape;
use super::{Keep, Refinement};
use crate::error::Error;
use crate::plane::Domains2;
use crate::plane::constrained::Before;

/// A lens around constraints is at least as wide as for this angle, in degrees.
const NARROWEST: f64 = 20.0;
/// Off-centres are this part of the way: what is made passes with room to spare (Shewchuk's choice).
const SHORT: f64 = 0.95;

/// See the module.
#[derive(Clone)]
pub(super) struct Rules<'a> {
    /// Of the smallest angle; more than one if there is no bound.
    pub(super) squared_cosine: f64,
    /// A point sees a constraint under an obtuse angle of at least this squared cosine: it is too near.
    pub(super) lens: f64,
    /// Off-centres are at most so many times the length of the shortest edge from its middle.
    pub(super) reach: f64,
    pub(super) conforming: bool,
    /// The square of the longest constraint.
    pub(super) longest_constraint: f64,
    pub(super) budget: usize,
    keep: Keep,
    longest: f64,
    /// By domain, those inside from 1 on; there is nothing at 0.
    areas: Vec<f64>,
    area_at: Option<Field<'a>>,
    size_at: Option<Field<'a>>,
}

/// A number for each place.
pub(super) type Field<'a> = &'a dyn Fn([f64; 2]) -> f64;

impl std::fmt::Debug for Rules<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rules").field("squared_cosine", &self.squared_cosine).finish_non_exhaustive()
    }
}

impl<'a> Rules<'a> {
    /// Of a refinement; regions may have largest areas of their own.
    pub(super) fn new(
        wanted: &Refinement<'a>,
        domains: &Domains2,
        regions: &[Option<f64>],
        before: &Before,
    ) -> Self {
        let angle = wanted.min_angle.to_radians();
        let general = wanted.max_area.unwrap_or(f64::INFINITY);
        let area = |region: Option<usize>| region.and_then(|r| regions.get(r).copied().flatten());
        let own = |&part: &usize| area(domains.parts()[part].region).map_or(general, |own| own.min(general));
        let areas = before.parts[..before.inside].iter().map(own);
        let lens = (2.0 * angle.max(NARROWEST.to_radians())).cos();
        Self {
            squared_cosine: if angle > 0.0 { angle.cos() * angle.cos() } else { 2.0 },
            lens: lens * lens,
            reach: SHORT * 0.5 / (0.5 * angle.max(NARROWEST.to_radians())).tan(),
            conforming: wanted.conforming,
            longest_constraint: wanted.max_edge.map_or(f64::INFINITY, |length| length * length),
            budget: wanted.max_vertices.map_or(before.room, |most| most.min(before.room)),
            keep: wanted.keep,
            longest: wanted.max_edge.map_or(f64::INFINITY, |length| length * length),
            areas: std::iter::once(f64::INFINITY).chain(areas).collect(),
            area_at: wanted.area_at,
            size_at: wanted.size_at,
        }
    }

    /// Whether a triangle is larger than it may be.
    #[inline]
    pub(super) fn is_large(&self, shape: &Shape, domain: usize) -> Result<bool, Error> {
        if shape.longest() > self.longest || shape.area() > self.areas[domain] {
            return Ok(true);
        }
        if self.area_at.is_none() && self.size_at.is_none() {
            return Ok(false);
        }
        let at = shape.centroid();
        let asked = |field: Option<Field>| field.map_or(Ok(f64::INFINITY), |field| Self::size(field(at), at));
        let (area, size) = (asked(self.area_at)?, asked(self.size_at)?);
        Ok(shape.area() > area || shape.longest() > size * size)
    }

    fn size(value: f64, at: [f64; 2]) -> Result<f64, Error> {
        if value > 0.0 { Ok(value) } else { Err(Error::Size { value, at }) }
    }

    /// Whether a constraint may not be split, with the mesh on both sides or on one.
    pub(super) fn keeps(&self, is_between: bool) -> bool {
        match self.keep {
            Keep::Nothing => false,
            Keep::Border => !is_between,
            Keep::Constraints => true,
        }
    }

    /// Whether a domain is inside.
    #[inline]
    pub(super) fn is_inside(&self, domain: usize) -> bool {
        domain > 0 && domain < self.areas.len()
    }
}
