// CGAL's constrained Delaunay triangulation behind two C functions: a graph, and polygons one after the other.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
// Whether a face is inside of the polygon: 0 is not known, 1 is inside, 2 is outside.
struct Mark {
    std::uint8_t value = 0;
};
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                         CGAL::Triangulation_face_base_with_info_2<Mark, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
template <class Tag> using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Tag>;

using Clock = std::chrono::steady_clock;

static double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Points in spatial order, then the segments; triangles in the indices of the first of equal points, as that is found
// after the clock has stopped. Returns the number of triangles, or -1.
template <class Tag>
static std::ptrdiff_t graph(const double *xy, std::size_t n, const std::uint32_t *ends, std::size_t m,
                            std::uint32_t *triangles, double *seconds) {
    std::vector<Kernel::Point_2> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
    std::vector<std::pair<std::size_t, std::size_t>> segments;
    segments.reserve(m);
    for (std::size_t i = 0; i < m; ++i) segments.emplace_back(ends[2 * i], ends[2 * i + 1]);
    try {
        const auto start = Clock::now();
        Triangulation<Tag> triangulation;
        triangulation.insert_constraints(points.begin(), points.end(), segments.begin(), segments.end());
        *seconds = since(start);
        if (triangles == nullptr) return triangulation.number_of_faces();
        if (triangulation.number_of_vertices() > n) return -1;
        std::map<Kernel::Point_2, std::uint32_t> first;
        for (std::size_t i = 0; i < n; ++i) first.emplace(points[i], i);
        for (auto v : triangulation.finite_vertex_handles()) v->info() = first.at(v->point());
        for (auto f : triangulation.finite_face_handles())
            for (int k = 0; k < 3; ++k) *triangles++ = f->vertex(k)->info();
        return triangulation.number_of_faces();
    } catch (const std::exception &) {
        return -1;
    }
}

extern "C" std::ptrdiff_t cgal_graph(const double *xy, std::size_t n, const std::uint32_t *ends, std::size_t m,
                                     std::uint32_t *triangles, double *seconds) {
    return graph<CGAL::No_constraint_intersection_requiring_constructions_tag>(xy, n, ends, m, triangles, seconds);
}

extern "C" std::ptrdiff_t cgal_graph_splitting(const double *xy, std::size_t n, const std::uint32_t *ends,
                                               std::size_t m, std::uint32_t *triangles, double *seconds) {
    return graph<CGAL::Exact_predicates_tag>(xy, n, ends, m, triangles, seconds);
}

// Rings one after the other, each a polygon; `corners` is where each ends. Returns the number of triangles inside, or -1.
extern "C" std::ptrdiff_t cgal_polygons(const double *xy, const std::size_t *corners, std::size_t rings,
                                        double *seconds) {
    using Cdt = Triangulation<CGAL::No_constraint_intersection_requiring_constructions_tag>;
    std::vector<Kernel::Point_2> points;
    const std::size_t all = rings == 0 ? 0 : corners[rings - 1];
    points.reserve(all);
    for (std::size_t i = 0; i < all; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
    std::vector<std::pair<std::size_t, std::size_t>> segments;
    std::vector<std::uint32_t> triangles;
    std::deque<Cdt::Face_handle> queue;
    std::size_t count = 0;
    try {
        const auto start = Clock::now();
        for (std::size_t r = 0, from = 0; r < rings; from = corners[r++]) {
            const std::size_t n = corners[r] - from;
            segments.clear();
            for (std::size_t i = 0; i < n; ++i) segments.emplace_back(i, i + 1 < n ? i + 1 : 0);
            Cdt cdt;
            cdt.insert_constraints(points.begin() + from, points.begin() + from + n, segments.begin(), segments.end());
            // From infinity inwards; across a constraint the other side begins.
            std::deque<Cdt::Face_handle> border{cdt.infinite_face()};
            cdt.infinite_face()->info().value = 2;
            triangles.clear();
            while (!border.empty()) {
                queue.assign(1, border.front());
                border.pop_front();
                while (!queue.empty()) {
                    const auto f = queue.front();
                    queue.pop_front();
                    if (f->info().value == 1)
                        for (int k = 0; k < 3; ++k) triangles.push_back(f->vertex(k)->info());
                    for (int k = 0; k < 3; ++k) {
                        const auto g = f->neighbor(k);
                        if (g->info().value != 0) continue;
                        const bool crosses = cdt.is_constrained({f, k});
                        g->info().value = crosses ? 3 - f->info().value : f->info().value;
                        (crosses ? border : queue).push_back(g);
                    }
                }
            }
            count += triangles.size() / 3;
        }
        *seconds = since(start);
        return count;
    } catch (const std::exception &) {
        return -1;
    }
}
