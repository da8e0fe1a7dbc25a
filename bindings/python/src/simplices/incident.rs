//! Which simplices share a facet, and which points an edge.

/// The edges or triangles across from each corner of each, -1 where there is none. Facets are sorted by their corners, O(n log n).
pub fn neighbors<const W: usize>(simplices: &[[i32; W]]) -> Vec<[i32; W]> {
    const { assert!(W < 4, "two corners of a facet are one number") };
    // The corners of each facet, and the place across from it.
    let mut facets: Vec<(u64, u32)> = Vec::with_capacity(W * simplices.len());
    for (row, simplex) in (0..).zip(simplices) {
        for k in 0..W {
            let [a, b] = [simplex[(k + 1) % W], simplex[(k + W - 1) % W]].map(|corner| corner as u32);
            facets.push((u64::from(a.min(b)) << 32 | u64::from(a.max(b)), W as u32 * row + k as u32));
        }
    }
    facets.sort_unstable();
    let mut found = vec![[-1; W]; simplices.len()];
    for pair in facets.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        let places = [pair[0].1, pair[1].1];
        for [here, there] in [places, [places[1], places[0]]] {
            found.as_flattened_mut()[here as usize] = (there / W as u32) as i32;
        }
    }
    found
}

/// The neighbors of so many points that edges join: where those of each start, and which they are, increasing.
pub fn around(points: usize, edges: &[[i32; 2]]) -> (Vec<i32>, Vec<i32>) {
    let mut starts = vec![0; points + 1];
    for &point in edges.as_flattened() {
        starts[point as usize + 1] += 1;
    }
    for point in 0..points {
        starts[point + 1] += starts[point];
    }
    let (mut ends, mut others) = (starts.clone(), vec![0; 2 * edges.len()]);
    for &[a, b] in edges {
        for [here, there] in [[a, b], [b, a]] {
            let end = &mut ends[here as usize];
            others[*end as usize] = there;
            *end += 1;
        }
    }
    for row in starts.windows(2) {
        others[row[0] as usize..row[1] as usize].sort_unstable();
    }
    (starts, others)
}
