//! Surfaces: what a cell of a raster takes beyond the triangulation, by each method, on one thread and with as many cells as points and more.
//! Whole runs from file to raster beside other software are in `with_surfaces.py`.

use std::time::Instant;

use delone::surface::{Grid, Interpolator, gradients, rasterize};
use delone::{Bounds, Delaunay2};
use delone_generators::Kind;

/// Prints minima over the runs; whether planes are reproduced.
pub fn run(kind: Kind, size: usize, runs: usize) -> bool {
    let points = kind.points(size, 1);
    let Ok((d, order)) = Delaunay2::along_curve(&points) else { return false };
    let bounds = Bounds::of(points.iter().copied());
    let extent = [0, 1].map(|k| bounds.high[k] - bounds.low[k]);
    let plane = |[x, y]: [f64; 2]| 3.0 * x - 2.0 * y + 1.0;
    let heights: Vec<f64> = order.iter().map(|&i| plane(points[i as usize])).collect();
    let scale = heights.iter().fold(0.0f64, |most, z| most.max(z.abs()));
    let mut is_right = true;
    let mut line = format!("  {:12} {size:>10}", kind.name());
    let is_plane = |values: &[f64], grid: &Grid| {
        values.iter().enumerate().filter(|cell| !cell.1.is_nan()).all(|(k, z)| {
            let expected = plane(grid.center(k % grid.columns(), k / grid.columns()));
            (z - expected).abs() <= 1e-9 * scale
        })
    };
    for cells in [1.0, 16.0] {
        let size_of_cell = (extent[0] * extent[1] / size as f64 / cells).sqrt();
        let Ok(grid) = Grid::aligned(&bounds, size_of_cell) else { return false };
        let mut best = f64::INFINITY;
        for _ in 0..runs {
            let start = Instant::now();
            let Ok(values) = rasterize(&d, &heights, &grid, |_| true) else { return false };
            best = best.min(start.elapsed().as_secs_f64());
            is_right &= is_plane(&values, &grid);
        }
        line += &format!(", linear with {cells} cells a point {:.1} ns a cell", best * 1e9 / grid.cells());
    }
    let Ok(grid) = Grid::aligned(&bounds, (extent[0] * extent[1] / size as f64).sqrt()) else { return false };
    let Ok(mask) = rasterize(&d, &heights, &grid, |_| true) else { return false };
    let Ok(slopes) = gradients(&d, &heights) else { return false };
    let laplace = Interpolator::laplace(&d);
    let sibson = Interpolator::sibson(&d);
    for name in ["laplace", "sibson", "smooth"] {
        let mut best = f64::INFINITY;
        for _ in 0..runs {
            let mut values = mask.clone();
            let start = Instant::now();
            let done = match name {
                "laplace" => laplace.fill(&grid, &heights, &mut values),
                "sibson" => sibson.fill(&grid, &heights, &mut values),
                _ => sibson.fill_with(&grid, &mut values, |own, q| own.smooth(q, &heights, &slopes)),
            };
            best = best.min(start.elapsed().as_secs_f64());
            is_right &= done.is_ok();
            is_right &= is_plane(&values, &grid);
        }
        line += &format!(", {name} {:.0}", best * 1e9 / grid.cells());
    }
    println!("{line}{}", if is_right { "" } else { ", WRONG: no plane" });
    is_right
}
