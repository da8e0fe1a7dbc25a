//! Named, seeded point sets and graphs: the same seed gives the same bits on every machine.
//!
//! The random numbers have an algorithm of their own ([`Random`]), and the functions beyond + - * / sqrt come from the
//! pure-Rust `libm`, because those of operating systems differ in the last bit.
//!
//! This crate depends on no other crate of the project, but in its tests: `delone generate`, tests, benchmarks and the random attack
//! all draw from it.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

macro_rules! kinds {
    ($(#[doc = $title:literal])+ $kind:ident, $method:ident -> $parts:ty: $($(#[doc = $doc:literal])+ $variant:ident = $name:literal, $make:expr;)+) => {
        $(#[doc = $title])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $kind { $($(#[doc = $doc])+ $variant,)+ }

        impl $kind {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// The family of that name.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|kind| kind.name() == name)
            }

            /// The name by which programs and reports know it.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)+ }
            }

            /// One sentence about it.
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => concat!($($doc),+).trim_ascii(),)+ }
            }

            /// The member of this family with `n` points, or nearly so many, for a seed.
            pub fn $method(self, n: usize, seed: u64) -> $parts {
                let mut random = Random::new(seed);
                let make: fn(usize, &mut Random) -> $parts = match self { $(Self::$variant => $make,)+ };
                make(n, &mut random)
            }
        }
    };
}

mod graph;
mod planar;
mod plane;
mod random;
mod space;

pub use graph::Graph;
pub use plane::Kind;
pub use random::{Random, in_ball, moved};
pub use space::Kind3;

/// A point of the plane.
pub type Point2 = [f64; 2];

/// A point of space.
pub type Point3 = [f64; 3];

/// Points, and segments between them by index.
pub type Segments = (Vec<Point2>, Vec<[usize; 2]>);

fn repeat<P>(n: usize, mut make: impl FnMut() -> P) -> Vec<P> {
    (0..n).map(|_| make()).collect()
}
