//! Which simplices share a side.

use super::buckets::Buckets;
use crate::ids::{Place, VertexId};

/// No simplex.
pub(super) const NONE: u32 = u32::MAX;

/// For each simplex, corners by increasing id, the one across the side opposite to each corner. Of the vertices with ids below `ids`. O(n)
/// where degrees are bounded.
pub(super) fn across<const N: usize>(ids: usize, simplices: &[[VertexId; N]]) -> Vec<[u32; N]> {
    // A side without its first corner has one corner in the plane and two in space.
    let buckets = Buckets::new(ids, simplices.len(), |i| {
        let corners = &simplices[i];
        std::array::from_fn::<_, N, _>(|k| {
            let at = |m: usize| corners[m + usize::from(m >= k)].index();
            let rest = (1..N - 1).fold(0, |rest, m| rest << 32 | at(m) as u64);
            (Place::new(at(0)), (rest, i as u32, k as u8))
        })
    });
    let pairs = buckets.in_parts(|_, bucket, pairs: &mut Vec<[(u32, u8); 2]>| {
        for same in bucket.windows(2).filter(|same| same[0].0 == same[1].0) {
            pairs.push([(same[0].1, same[0].2), (same[1].1, same[1].2)]);
        }
    });
    let mut across = vec![[NONE; N]; simplices.len()];
    for [(i, k), (j, l)] in pairs.into_iter().flatten() {
        across[i as usize][usize::from(k)] = j;
        across[j as usize][usize::from(l)] = i;
    }
    across
}
