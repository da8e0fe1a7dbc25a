//! Ridges and regions of the plane, from triangles and their neighbors.

use super::{Ragged, Ridges};

/// The ridges across edges, each from the smaller of its two triangles. The one that belongs to cocircular points has a single vertex
/// at both ends, and is none.
pub fn ridges(corners: &[[i32; 3]], across: &[[i32; 3]], which: &[i32]) -> Ridges {
    let most = corners.len() * 3 / 2 + 3;
    let mut pairs = Vec::with_capacity(most);
    let mut vertices = Ragged { starts: Vec::with_capacity(most + 1), items: Vec::with_capacity(2 * most) };
    vertices.starts.push(0);
    for (t, (triangle, beyond)) in corners.iter().zip(across).enumerate() {
        for (k, &next) in beyond.iter().enumerate() {
            let there = usize::try_from(next).map_or(-1, |next| which[next]);
            if (next < 0 || t < next as usize) && there != which[t] {
                pairs.push([triangle[(k + 1) % 3], triangle[(k + 2) % 3]]);
                vertices.items.extend([i64::from(there), i64::from(which[t])]);
                vertices.end_row();
            }
        }
    }
    Ridges { pairs, vertices }
}

/// The vertices of the triangles around each of so many points, counter-clockwise; infinity first where the star is open.
///
/// Neighbors alone say who follows whom, for vertices are rounded, so that different ones may be equal: runs of them are one.
pub fn regions(
    points: usize,
    corners: &[[i32; 3]],
    across: &[[i32; 3]],
    which: &[i32],
    regions: &mut Ragged,
) {
    // Corner k of triangle t is 3 t + k. An open star begins where nothing is clockwise, others at their first corner.
    let is_first = |corner: usize| across[corner / 3][(corner + 2) % 3] < 0;
    let mut starts = vec![usize::MAX; points];
    for (corner, &point) in corners.as_flattened().iter().enumerate() {
        let start = &mut starts[point as usize];
        if *start == usize::MAX || (is_first(corner) && !is_first(*start)) {
            *start = corner;
        }
    }
    // One star after the other along the triangles, of which neighbors are near each other in memory, and only then by points.
    let mut found = Ragged {
        starts: Vec::with_capacity(points + 1),
        items: Vec::with_capacity(3 * corners.len() + points),
    };
    found.starts.push(0);
    let mut star_of = vec![None; points];
    for (first, &point) in corners.as_flattened().iter().enumerate() {
        if starts[point as usize] != first {
            continue;
        }
        if is_first(first) {
            found.items.push(-1);
        }
        let mut corner = first;
        // No star has more triangles than there are.
        for _ in 0..corners.len() {
            found.push_new(i64::from(which[corner / 3]));
            // Across from the corner after this one.
            let Ok(next) = usize::try_from(across[corner / 3][(corner + 1) % 3]) else { break };
            let same = corners[next].iter().position(|&other| other == point);
            corner = 3 * next + same.unwrap_or(0);
            if corner == first {
                break;
            }
        }
        found.close();
        star_of[point as usize] = Some(found.starts.len());
        found.end_row();
    }
    regions.starts.reserve(points);
    regions.items.reserve(found.items.len());
    for star in star_of {
        if let Some(end) = star {
            regions.items.extend(&found.items[found.starts[end - 1] as usize..found.starts[end] as usize]);
        }
        regions.end_row();
    }
}
