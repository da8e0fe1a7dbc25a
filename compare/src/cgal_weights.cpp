// CGAL's regular triangulations of the plane and of space behind two C functions: range insertion, with the index of each site.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <chrono>
#include <cstdint>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex2 = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Structure2 = CGAL::Triangulation_data_structure_2<Vertex2, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Regular2 = CGAL::Regular_triangulation_2<Kernel, Structure2>;
using Vertex3 = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Structure3 = CGAL::Triangulation_data_structure_3<Vertex3, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Regular3 = CGAL::Regular_triangulation_3<Kernel, Structure3>;

using Clock = std::chrono::steady_clock;

static double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// `triangles` has room for 6n indices. Returns the number of triangles.
extern "C" std::size_t cgal_regular_2(const double *xy, const double *weights, std::size_t n, std::uint32_t *triangles,
                                      double *seconds) {
    std::vector<std::pair<Kernel::Weighted_point_2, std::uint32_t>> sites;
    sites.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
        sites.emplace_back(Kernel::Weighted_point_2(Kernel::Point_2(xy[2 * i], xy[2 * i + 1]), weights[i]), i);
    const auto start = Clock::now();
    Regular2 triangulation;
    triangulation.insert(sites.begin(), sites.end());
    *seconds = since(start);
    std::uint32_t *out = triangles;
    for (auto f : triangulation.finite_face_handles())
        for (int k = 0; k < 3; ++k) *out++ = f->vertex(k)->info();
    return (out - triangles) / 3;
}

// `tetrahedra` has room for as many as there are, which a first call with none tells.
extern "C" std::size_t cgal_regular_3(const double *xyz, const double *weights, std::size_t n, std::uint32_t *tetrahedra,
                                      std::size_t room, double *seconds) {
    std::vector<std::pair<Kernel::Weighted_point_3, std::uint32_t>> sites;
    sites.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
        sites.emplace_back(
            Kernel::Weighted_point_3(Kernel::Point_3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]), weights[i]), i);
    const auto start = Clock::now();
    Regular3 triangulation;
    triangulation.insert(sites.begin(), sites.end());
    *seconds = since(start);
    std::size_t count = 0;
    for (auto c : triangulation.finite_cell_handles()) {
        if (count < room)
            for (int k = 0; k < 4; ++k) tetrahedra[4 * count + k] = c->vertex(k)->info();
        ++count;
    }
    return count;
}
