// CGAL's planar Delaunay triangulation behind one C function: range insertion (which sorts in space) of points
// that carry their input index, as Delone's do, and the triangles in those indices.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Plain = CGAL::Delaunay_triangulation_2<Kernel>;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Indexed = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

using Clock = std::chrono::steady_clock;

static double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Without indices: the fastest that CGAL does. Returns the number of finite triangles.
extern "C" std::size_t cgal_plain_time(const double *xy, std::size_t n, double *seconds) {
    std::vector<Kernel::Point_2> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
    const auto start = Clock::now();
    Plain triangulation;
    triangulation.insert(points.begin(), points.end());
    *seconds = since(start);
    return triangulation.number_of_faces();
}

// With indices. `triangles` has room for 6n indices; returns the number of triangles. The clock runs for the
// triangulation only.
extern "C" std::size_t cgal_indexed_time(const double *xy, std::size_t n, std::uint32_t *triangles, double *seconds) {
    std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(Kernel::Point_2(xy[2 * i], xy[2 * i + 1]), i);
    const auto start = Clock::now();
    Indexed triangulation;
    triangulation.insert(points.begin(), points.end());
    *seconds = since(start);
    std::uint32_t *out = triangles;
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f)
        for (int k = 0; k < 3; ++k) *out++ = f->vertex(k)->info();
    return (out - triangles) / 3;
}

#include <CGAL/Triangulation_hierarchy_2.h>
#include <CGAL/Triangulation_hierarchy_vertex_base_2.h>

using Level_vertex = CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<Kernel>>;
using Level = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Level_vertex>>;
using Hierarchy = CGAL::Triangulation_hierarchy_2<Level>;

// Insertion one by one, m queries for location and as many for the nearest vertex, removal of the first half of the
// points. `inside` has room for m flags, `nearest` for 2m coordinates, `seconds` for four times.
extern "C" void cgal_changes(const double *xy, std::size_t n, const double *queries, std::size_t m,
                             std::uint8_t *inside, double *nearest, double *seconds) {
    Hierarchy triangulation;
    std::vector<Hierarchy::Vertex_handle> handles;
    handles.reserve(n);
    auto start = Clock::now();
    for (std::size_t i = 0; i < n; ++i)
        handles.push_back(triangulation.insert(Kernel::Point_2(xy[2 * i], xy[2 * i + 1])));
    seconds[0] = since(start);
    start = Clock::now();
    for (std::size_t i = 0; i < m; ++i)
        inside[i] = !triangulation.is_infinite(
            triangulation.locate(Kernel::Point_2(queries[2 * i], queries[2 * i + 1])));
    seconds[1] = since(start);
    start = Clock::now();
    for (std::size_t i = 0; i < m; ++i) {
        const auto v = triangulation.nearest_vertex(Kernel::Point_2(queries[2 * i], queries[2 * i + 1]));
        nearest[2 * i] = v->point().x();
        nearest[2 * i + 1] = v->point().y();
    }
    seconds[2] = since(start);
    start = Clock::now();
    for (std::size_t i = 0; i < n / 2; ++i) triangulation.remove(handles[i]);
    seconds[3] = since(start);
}

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

using Plain3 = CGAL::Delaunay_triangulation_3<Kernel>;
using Vertex3 = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Indexed3 = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex3>>;

// In space, with indices: range insertion, which sorts in space; then the removal of the first m points. Returns the
// number of finite tetrahedra before; two times.
extern "C" std::size_t cgal_space(const double *xyz, std::size_t n, std::size_t m, double *seconds) {
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
        points.emplace_back(Kernel::Point_3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]), i);
    auto start = Clock::now();
    Indexed3 triangulation;
    triangulation.insert(points.begin(), points.end());
    seconds[0] = since(start);
    const std::size_t cells = triangulation.number_of_finite_cells();
    std::vector<Indexed3::Vertex_handle> handles;
    for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v)
        if (v->info() < m) handles.push_back(v);
    start = Clock::now();
    for (auto v : handles) triangulation.remove(v);
    seconds[1] = since(start);
    return cells;
}

// Without indices: the fastest that CGAL does.
extern "C" double cgal_space_plain(const double *xyz, std::size_t n) {
    std::vector<Kernel::Point_3> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    const auto start = Clock::now();
    Plain3 triangulation(points.begin(), points.end());
    return since(start);
}
