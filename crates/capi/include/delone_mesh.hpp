// Meshes for delone.hpp, which includes this file.
#ifndef DELONE_MESH_HPP
#define DELONE_MESH_HPP

#include "delone.hpp"

namespace delone {

/// A mesh to be made: wishes, then `run()`. The points are read by `run()`, and must be there until then.
class mesh {
public:
    mesh(const points2 &points, const pairs &segments) : points_(points), segments_(segments) {
        options_.size = sizeof options_;
    }
    /// Degrees, below 60; up to 30 is usually reached.
    mesh &min_angle(double degrees) noexcept { return options_.min_angle = degrees, *this; }
    mesh &max_area(double area) noexcept { return options_.max_area = area, *this; }
    mesh &max_edge(double length) noexcept { return options_.max_edge = length, *this; }
    /// No edge with a new vertex is shorter.
    mesh &min_edge(double length) noexcept { return options_.min_edge = length, *this; }
    /// New vertices, at most: with so many the mesh is done, whatever is still wished.
    mesh &max_vertices(std::size_t count) noexcept { return options_.max_vertices = count, *this; }
    mesh &inside(fill rule) noexcept { return options_.fill = static_cast<std::int32_t>(rule), *this; }
    mesh &keep_whole(keep what) noexcept { return options_.keep = static_cast<std::int32_t>(what), *this; }
    mesh &split_crossings() noexcept { return options_.flags |= DELONE_SPLIT_CROSSINGS, *this; }
    /// A hole by a point in it; the inside is then that of seeds.
    mesh &hole(double x, double y) {
        holes_.push_back({x, y});
        return inside(fill::seeds);
    }
    /// A region by a point in it; the inside is then that of seeds.
    mesh &region(double x, double y, double attribute = 0, double max_area = 0) {
        regions_.push_back({{x, y}, attribute, max_area});
        return inside(fill::seeds);
    }
    /// The largest area of a triangle at a place: f(x, y).
    mesh &area_at(std::function<double(double, double)> f) {
        callbacks_.area_at = std::move(f);
        return *this;
    }
    /// The length of edges at a place: f(x, y). Triangles there are at most as large as the equilateral one.
    mesh &size(std::function<double(double, double)> f) {
        return area_at([f = std::move(f)](double x, double y) {
            double length = f(x, y);
            return std::sqrt(3.0) / 4 * length * length;
        });
    }
    /// Whether a triangle must get smaller: f(corners, area).
    mesh &unsuitable(std::function<bool(const std::array<point, 3> &, double)> f) {
        callbacks_.unsuitable = std::move(f);
        return *this;
    }
    /// Called now and then with the number of new vertices; true stops, and `run` throws DELONE_STOPPED. A function without a result
    /// never stops.
    template <class F> mesh &progress(F f) {
        if constexpr (std::is_void_v<decltype(f(std::uint64_t{}))>) {
            callbacks_.progress = [f = std::move(f)](std::uint64_t count) mutable { return f(count), false; };
        } else {
            callbacks_.progress = std::move(f);
        }
        return *this;
    }

    /// Makes the mesh. Exceptions of callbacks stop the work, and are thrown here.
    triangulation run() const {
        callbacks calls = callbacks_;
        delone_mesh_options options = options_;
        options.holes = holes_.empty() ? nullptr : holes_[0].data();
        options.hole_count = holes_.size();
        options.regions = regions_.data();
        options.region_count = regions_.size();
        options.user = &calls;
        if (calls.area_at) options.area_at = [](void *user, double x, double y) { return ask(user, &callbacks::area_at, DBL_MAX, x, y); };
        if (calls.unsuitable) {
            options.unsuitable = [](void *user, const double *c, double area) -> std::int32_t {
                std::array<point, 3> corners{{{c[0], c[1]}, {c[2], c[3]}, {c[4], c[5]}}};
                return ask(user, &callbacks::unsuitable, false, corners, area);
            };
        }
        options.progress = [](void *user, std::uint64_t count) -> std::int32_t {
            auto &all = *static_cast<callbacks *>(user);
            bool stops = all.progress && ask(user, &callbacks::progress, true, count);
            return stops || all.thrown != nullptr;
        };
        fault f;
        delone_tri2 *handle = nullptr;
        std::int32_t status = delone_mesh2_new(points_.raw(), segments_.data(), segments_.size(), &options, &handle, &f);
        triangulation made(handle);
        if (calls.thrown) std::rethrow_exception(calls.thrown);
        raise(status, f);
        return made;
    }

private:
    struct callbacks {
        std::function<double(double, double)> area_at;
        std::function<bool(const std::array<point, 3> &, double)> unsuitable;
        std::function<bool(std::uint64_t)> progress;
        std::exception_ptr thrown;
    };
    /// Calls one of them; after an exception none is called, and the answer is one that asks for nothing more.
    template <class F, class A, class... B> static A ask(void *user, F callbacks::*which, A otherwise, const B &...of) noexcept {
        auto &all = *static_cast<callbacks *>(user);
        if (all.thrown) return otherwise;
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
        try {
            return (all.*which)(of...);
        } catch (...) {
            all.thrown = std::current_exception();
            return otherwise;
        }
#else
        return (all.*which)(of...);
#endif
    }

    points2 points_;
    pairs segments_;
    delone_mesh_options options_ = {};
    std::vector<point> holes_;
    std::vector<delone_region> regions_;
    callbacks callbacks_;
};

} // namespace delone

#endif
