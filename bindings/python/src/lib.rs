//! The Rust half of the Python package: arrays in, arrays out. What Python users see is in `python/delone/`, which checks
//! and names things as they know them from SciPy.
//!
//! Everything long runs without Python's lock, on all cores (`pool.rs`). A simplex is known to Python by its row; rows count the
//! finite simplices by increasing id, and are made anew after a change.

mod alpha;
mod arrays;
mod constrained;
mod diagram;
mod dtm;
mod errors;
mod facets;
mod graphs;
mod hints;
mod hull;
mod interrupt;
mod memory;
mod mesh;
mod near;
mod neighbors;
mod orders;
mod periodic;
mod polygons;
mod pool;
mod powers;
mod regular;
mod shared;
mod simplices;
mod sizes;
mod state;
mod store;
mod surface;
mod terrain;
mod tiles;
mod triangulation;
mod voronoi;
mod weld;

use pyo3::prelude::*;

#[pymodule]
#[pyo3(name = "_delone")]
fn package(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<triangulation::Triangulation>()?;
    m.add_class::<alpha::Alpha>()?;
    m.add_class::<hints::Hints>()?;
    m.add_class::<constrained::Constrained>()?;
    m.add_class::<mesh::Mesh>()?;
    m.add_class::<regular::Regular>()?;
    m.add_class::<orders::Orders>()?;
    m.add_class::<periodic::PyPeriodic>()?;
    m.add_class::<neighbors::Neighbors>()?;
    m.add_class::<tiles::PyCuts>()?;
    m.add_class::<store::PyStore>()?;
    m.add_class::<tiles::PyBorder>()?;
    m.add_class::<tiles::PyFingerprint>()?;
    m.add_function(wrap_pyfunction!(tiles::triangulate_tile, m)?)?;
    m.add_function(wrap_pyfunction!(tiles::join_borders, m)?)?;
    m.add_function(wrap_pyfunction!(polygons::triangulate_polygons, m)?)?;
    m.add_function(wrap_pyfunction!(weld::weld, m)?)?;
    m.add_function(wrap_pyfunction!(mesh::arcs::divide_arcs, m)?)?;
    m.add_function(wrap_pyfunction!(graphs::proximity_graph, m)?)?;
    m.add_function(wrap_pyfunction!(surface::interpolate, m)?)?;
    m.add_function(wrap_pyfunction!(surface::interpolation_weights, m)?)?;
    m.add_function(wrap_pyfunction!(surface::vertex_gradients, m)?)?;
    m.add_function(wrap_pyfunction!(terrain::paint, m)?)?;
    m.add_function(wrap_pyfunction!(terrain::contour_lines, m)?)?;
    m.add_function(wrap_pyfunction!(terrain::contour_bands, m)?)?;
    m.add_function(wrap_pyfunction!(terrain::settled, m)?)?;
    m.add_function(wrap_pyfunction!(terrain::thin, m)?)?;
    m.add_function(wrap_pyfunction!(dtm::dtm, m)?)?;
    m.add_function(wrap_pyfunction!(pool::after_fork, m)?)?;
    m.add_function(wrap_pyfunction!(hull::convex_hull, m)?)?;
    m.add_function(wrap_pyfunction!(hull::sides, m)?)?;
    m.add_function(wrap_pyfunction!(voronoi::clipped_cells, m)?)?;
    m.add_function(wrap_pyfunction!(voronoi::furthest, m)?)?;
    m.add_function(wrap_pyfunction!(voronoi::merged_vertices, m)?)?;
    m.add("MERGE_AUTO", delone::MERGE_AUTO)?;
    m.add_function(wrap_pyfunction!(arrays::is_finite, m)?)?;
    m.add_function(wrap_pyfunction!(arrays::lists, m)?)?;
    m.add_function(wrap_pyfunction!(facets::facet_equations, m)?)?;
    m.add_function(wrap_pyfunction!(facets::facet_sizes, m)?)?;
    m.add_function(wrap_pyfunction!(diagram::voronoi_ridges, m)?)?;
    m.add_function(wrap_pyfunction!(diagram::voronoi_regions, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::corners_of, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::neighbors_of, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::vertex_to_simplex, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::vertex_neighbors, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::transforms, m)?)?;
    m.add_function(wrap_pyfunction!(simplices::lifted_equations, m)?)
}
