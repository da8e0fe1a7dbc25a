// CGAL's periodic triangulations of space behind C functions: range insertion into the unit cube, then one sheet where it can.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_3.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_traits_3.h>
#include <CGAL/Periodic_3_regular_triangulation_3.h>
#include <CGAL/Periodic_3_regular_triangulation_traits_3.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Periodic_3_Delaunay_triangulation_3<CGAL::Periodic_3_Delaunay_triangulation_traits_3<Kernel>>;
using Regular = CGAL::Periodic_3_regular_triangulation_3<CGAL::Periodic_3_regular_triangulation_traits_3<Kernel>>;
using Clock = std::chrono::steady_clock;

// Of each corner the index and three offsets; as many tetrahedra as there is room for. Returns their number.
template <class Triangulation, class Points>
static std::size_t corners(const Triangulation &t, const Points &points, std::int32_t *out, std::size_t room) {
    std::map<typename Points::value_type, std::int32_t> index;
    for (std::size_t i = 0; i < points.size(); ++i) index[points[i]] = static_cast<std::int32_t>(i);
    std::size_t count = 0;
    for (auto i = t.periodic_tetrahedra_begin(Triangulation::UNIQUE); i != t.periodic_tetrahedra_end(Triangulation::UNIQUE); ++i) {
        if (count++ >= room) continue;
        for (int k = 0; k < 4; ++k) {
            auto corner = (*i)[k];
            *out++ = index[corner.first];
            *out++ = corner.second.x();
            *out++ = corner.second.y();
            *out++ = corner.second.z();
        }
    }
    return count;
}

template <class Triangulation, class Points>
static std::size_t triangulate(const Points &points, std::int32_t *out, std::size_t room, double *seconds) {
    auto start = Clock::now();
    Triangulation t(points.begin(), points.end(), typename Triangulation::Iso_cuboid(0, 0, 0, 1, 1, 1));
    *seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return corners(t, points, out, room);
}

extern "C" std::size_t cgal_periodic(const double *xyz, const double *weights, std::size_t n, std::int32_t *out,
                                     std::size_t room, double *seconds) {
    if (!weights) {
        std::vector<Delaunay::Point> points;
        for (std::size_t i = 0; i < n; ++i) points.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        return triangulate<Delaunay>(points, out, room, seconds);
    }
    std::vector<Regular::Weighted_point> sites;
    for (std::size_t i = 0; i < n; ++i)
        sites.emplace_back(Kernel::Point_3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]), weights[i]);
    return triangulate<Regular>(sites, out, room, seconds);
}
