//! `delone locate`: for each query the simplex that contains it.

use std::cmp::Ordering;

use delone::{Coordinates, Found, VertexId};

use crate::args::LocateArgs;
use crate::message::Failure;
use crate::queries::answer;
use crate::room::{Room, positive};

pub(crate) fn run<R: Room>(args: &LocateArgs, quiet: bool) -> Result<(), Failure> {
    let names = ["a", "b", "c", "d"].map(str::to_owned);
    answer::<R>(&args.input, &args.query, &names[..=R::Point::COUNT], quiet, |d, q, work| {
        let found = d.find_observed(q, work)?;
        Ok(simplex(d, &found).unwrap_or_default())
    })
}

/// The corners of a simplex that contains a point, the same ones whatever found it: of several that with the lexicographically least.
fn simplex<R: Room>(d: &R, found: &Found<R::Simplex>) -> Option<Vec<usize>> {
    let (face, simplex) = (found.face(), found.simplex?);
    if face.len() > R::Point::COUNT {
        return Some(positive(d.corners(simplex).as_ref()));
    }
    let around = d.simplices_at(*face.first()?).into_iter().map(|s| d.corners(s));
    let with_face = around.filter(|corners| face.iter().all(|v| corners.as_ref().contains(v)));
    let key = |corners: &[VertexId]| {
        let place = |v: &VertexId| d.position(*v).map_or(Vec::new(), |p| p.as_ref().to_vec());
        let mut places: Vec<Vec<f64>> = corners.iter().map(place).collect();
        places.sort_by(order);
        places
    };
    let least = with_face.min_by(|a, b| order(&key(a.as_ref()), &key(b.as_ref())));
    least.map(|corners| positive(corners.as_ref()))
}

/// Of what is finite.
fn order<T: PartialOrd>(a: &T, b: &T) -> Ordering {
    a.partial_cmp(b).unwrap_or(Ordering::Equal)
}
