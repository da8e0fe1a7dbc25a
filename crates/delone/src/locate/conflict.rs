//! The search of a conflict region: the simplices whose circles or spheres contain a point, from one of them on.
//!
//! Source: Bowyer, and Watson, The Computer Journal 1981. With the canonical test the region is connected, so the search goes from
//! simplex to simplex, across facets that separate one inside from one outside. It goes depth first: in the plane, with the sides of
//! each triangle told counter-clockwise, the border comes in its cyclic order.
//!
//! The search knows neither kernel nor marks. Its caller looks across one facet at a time: it decides whether the simplex beyond is
//! in conflict, keeps it, and lets fixed edges and marked simplices end the search. Cost: O(k) looks for k simplices.
//!
//! Four searches differ. The cavity in space (`space/layer/cavity.rs`) tests two spheres at once, in the order of a queue. The Delaunay
//! tree (`locate/delaunay_tree/`) numbers its nodes in the order of a queue. Hulls without a triangulation (`hull/space/shell.rs`) also
//! keep which facets were not seen. Parts in space (`space/construct/part.rs`) search for all sites of a region at once.

/// The simplex beyond a facet of the region.
pub(crate) enum Beyond<S, const N: usize> {
    /// It is in conflict. The search goes on across the first facet, then across the others, the last one first.
    Inside(S, [S; N]),
    /// It is not in conflict, or not seen, or known.
    Outside,
    /// The search ends here.
    End,
}

/// Looks across the facets that are pending, the last one first, and across all that this leads to. Returns whether it came to the
/// end of all. The buffer may be left with facets if not.
#[inline]
pub(crate) fn search<S, const N: usize>(
    pending: &mut Vec<S>,
    mut look: impl FnMut(&S) -> Beyond<S, N>,
) -> bool {
    while let Some(mut side) = pending.pop() {
        loop {
            match look(&side) {
                Beyond::Inside(first, others) => {
                    pending.extend(others);
                    side = first;
                }
                Beyond::Outside => break,
                Beyond::End => return false,
            }
        }
    }
    true
}
