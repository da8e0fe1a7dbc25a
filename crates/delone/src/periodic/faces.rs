//! The faces of a periodic triangulation, up to translation.
//!
//! Cost: O(n log n) for a sort.

use super::copies::Moved;
use super::kinds::PeriodicKind;
use super::quotient::{Quotient, minus};

impl<T: PeriodicKind<D, N>, const D: usize, const N: usize> Quotient<T, D, N> {
    /// The faces with so many corners, each once: seen from the first corner, whose offset is zero. Corners are in order, of
    /// all translations that have a corner at a site the first.
    pub(super) fn faces(&self, size: usize) -> Vec<Vec<Moved<D>>> {
        if size == 1 {
            let sites = (0..self.sites).map(|i| vec![(i as u32, [0; D])]);
            return sites.filter(|site| self.vertices[site[0].0 as usize]).collect();
        }
        let mut faces = Vec::new();
        for number in 0..self.simplices.len() {
            let corners = self.corners(number);
            for subset in (0..1_u32 << N).filter(|subset| subset.count_ones() as usize == size) {
                let face: Vec<Moved<D>> =
                    (0..N).filter(|k| subset >> k & 1 == 1).map(|k| corners[k]).collect();
                faces.push(up_to_translation(&face));
            }
        }
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Whether faces with so many corners have that many sites, and no two the same ones.
    pub(super) fn is_known_by_sites(&self, size: usize) -> bool {
        let mut sites: Vec<Vec<u32>> =
            self.faces(size).iter().map(|f| f.iter().map(|corner| corner.0).collect()).collect();
        sites.sort_unstable();
        let has_twice = |face: &Vec<u32>| face.windows(2).any(|pair| pair[0] == pair[1]);
        !sites.iter().any(has_twice) && sites.windows(2).all(|pair| pair[0] != pair[1])
    }
}

/// Corners in order, seen from one of the least site.
fn up_to_translation<const D: usize>(face: &[Moved<D>]) -> Vec<Moved<D>> {
    let from = |origin: &Moved<D>| {
        let mut seen: Vec<Moved<D>> =
            face.iter().map(|(site, offset)| (*site, minus(*offset, origin.1))).collect();
        seen.sort_unstable();
        seen
    };
    // Of several copies of the least site each is tried, and the first result in order taken.
    let least = face.iter().map(|corner| corner.0).min().unwrap_or_default();
    face.iter().filter(|corner| corner.0 == least).map(from).min().unwrap_or_default()
}
