// CGAL's Mesh_2 behind C functions: a constrained Delaunay triangulation refined until its angles are large enough. The result
// stays with CGAL until it is asked for, so that neither time nor memory of the copy count.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_criteria_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

// Only this file's: other files have triangulations of other vertices and faces.
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Structure = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                       CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Criteria = CGAL::Delaunay_mesh_criteria_2<Cdt>;
using Clock = std::chrono::steady_clock;

std::vector<Kernel::Point_2> points_of(const double *xy, std::size_t n) {
    std::vector<Kernel::Point_2> points;
    points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
    return points;
}

} // namespace

// From points and segments to the refined mesh; `bound` is the square of the sine of the smallest angle. Null on an exception.
extern "C" void *cgal_mesh(const double *xy, std::size_t n, const std::uint32_t *ends, std::size_t m, const double *holes,
                           std::size_t h, double bound, double *seconds) {
    const auto points = points_of(xy, n);
    const auto seeds = points_of(holes, h);
    std::vector<std::pair<std::size_t, std::size_t>> segments;
    segments.reserve(m);
    for (std::size_t i = 0; i < m; ++i) segments.emplace_back(ends[2 * i], ends[2 * i + 1]);
    try {
        const auto start = Clock::now();
        auto cdt = std::make_unique<Cdt>();
        cdt->insert_constraints(points.begin(), points.end(), segments.begin(), segments.end());
        CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(*cdt, Criteria(bound));
        mesher.set_seeds(seeds.begin(), seeds.end());
        mesher.refine_mesh();
        *seconds = std::chrono::duration<double>(Clock::now() - start).count();
        return cdt.release();
    } catch (const std::exception &) {
        return nullptr;
    }
}

// How many vertices and how many triangles inside there are.
extern "C" void cgal_mesh_sizes(const void *mesh, std::size_t *vertices, std::size_t *triangles) {
    const auto &cdt = *static_cast<const Cdt *>(mesh);
    *vertices = cdt.number_of_vertices();
    *triangles = 0;
    for (auto f : cdt.finite_face_handles()) *triangles += f->is_in_domain();
}

// Writes as many as `cgal_mesh_sizes` says.
extern "C" void cgal_mesh_copy(const void *mesh, double *xy, std::uint32_t *triangles) {
    const auto &cdt = *static_cast<const Cdt *>(mesh);
    CGAL::Unique_hash_map<Cdt::Vertex_handle, std::uint32_t> index;
    std::uint32_t next = 0;
    for (auto v : cdt.finite_vertex_handles()) {
        index[v] = next++;
        *xy++ = v->point().x();
        *xy++ = v->point().y();
    }
    for (auto f : cdt.finite_face_handles()) {
        if (!f->is_in_domain()) continue;
        for (int k = 0; k < 3; ++k) *triangles++ = index[f->vertex(k)];
    }
}

extern "C" void cgal_mesh_free(void *mesh) { delete static_cast<Cdt *>(mesh); }
