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
