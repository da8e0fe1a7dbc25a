//! Half-spaces of space over integers, and on which side of their planes rounded places are.

use num_bigint::BigInt;

use super::exact::{Vector, dot, integer, minus, scale, sign};

/// A point and its weight.
type Site = ([f64; 3], f64);

/// A power of two that divides all coordinates, and whose square divides all weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unit(i32);

/// Where n x <= c.
#[derive(Clone, Debug)]
pub(crate) struct HalfSpace {
    normal: Vector,
    limit: BigInt,
}

/// A place whose coordinates are rounded.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    at: Vector,
    /// Twice as far as each coordinate may be off: the distance to the next number.
    next: Vector,
}

/// The distance to the next number away from zero; a step of the largest numbers at their end.
fn step(x: f64) -> f64 {
    let x = x.abs().min(f64::MAX.next_down());
    x.next_up() - x
}

impl Unit {
    /// The unit of sites, and of places.
    pub(crate) fn of(sites: &[Site], places: &[[f64; 3]]) -> Self {
        let coordinates = sites.iter().flat_map(|site| site.0).chain(places.iter().flatten().copied());
        let steps = places.iter().flatten().map(|&x| step(x));
        let all: Vec<f64> = coordinates.chain(steps).collect();
        let weights: Vec<f64> = sites.iter().map(|site| site.1).collect();
        Self(scale(&all).min(scale(&weights).div_euclid(2)))
    }

    fn point(self, p: [f64; 3]) -> Vector {
        p.iter().map(|&x| integer(x, self.0)).collect()
    }

    /// A place whose coordinates were rounded to the nearest number.
    pub(crate) fn place(self, p: [f64; 3]) -> Place {
        Place { at: self.point(p), next: p.iter().map(|&x| integer(step(x), self.0)).collect() }
    }

    /// Where the first site has no more power than the second.
    pub(crate) fn nearer(self, a: Site, b: Site) -> HalfSpace {
        let (p, q) = (self.point(a.0), self.point(b.0));
        let weight = |w| integer(w, 2 * self.0);
        let limit = dot(&q, &q) - dot(&p, &p) - (weight(b.1) - weight(a.1));
        HalfSpace { normal: minus(&q, &p).into_iter().map(|x| 2 * x).collect(), limit }
    }

    /// Beside a wall that has these corners, counter-clockwise from outside.
    pub(crate) fn beside(self, [p, q, r]: [[f64; 3]; 3]) -> HalfSpace {
        let [p, q, r] = [p, q, r].map(|p| self.point(p));
        let (u, v) = (minus(&q, &p), minus(&r, &p));
        let minor = |i: usize, j: usize| &u[i] * &v[j] - &u[j] * &v[i];
        let normal = vec![minor(1, 2), minor(2, 0), minor(0, 1)];
        let limit = dot(&normal, &p);
        HalfSpace { normal, limit }
    }
}

impl HalfSpace {
    /// Zero if the plane may go through the exact place; else 1 beyond and -1 inside.
    pub(crate) fn side(&self, place: &Place) -> i8 {
        let twice = 2 * (dot(&self.normal, &place.at) - &self.limit);
        let size = |x: &BigInt| if sign(x) < 0 { -x } else { x.clone() };
        let slack: BigInt = self.normal.iter().zip(&place.next).map(|(n, next)| size(n) * next).sum();
        if size(&twice) <= slack { 0 } else { sign(&twice) }
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[test]
    fn a_place_is_on_a_plane_if_rounding_can_have_moved_it() {
        let sites = [([0.0; 3], 0.0), ([0.3, 0.0, 0.0], 0.0)];
        let side = |x: f64| {
            let unit = Unit::of(&sites, &[[x, 0.0, 0.0]]);
            unit.nearer(sites[0], sites[1]).side(&unit.place([x, 0.0, 0.0]))
        };
        let middle = 0.15_f64;
        assert_eq!(
            [middle.next_down().next_down(), middle, middle.next_up().next_up()].map(side),
            [-1, 0, 1]
        );
    }
}
