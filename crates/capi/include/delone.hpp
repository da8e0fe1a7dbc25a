// delone.hpp: exact Delaunay triangulation for C++17. Header only; link with libdelone.
//
// Points are any contiguous range whose elements begin with two numbers (three in space): std::array, std::pair, structs, std::complex,
// points of Eigen, glm or CGAL; or a matrix of Eigen. They are read where they are. Errors are exceptions of type delone::error; `try_triangulate` and its
// like throw none. Any number of threads may ask one triangulation; while one changes it, no other may.
#ifndef DELONE_HPP
#define DELONE_HPP

#include "delone.h"
#include "delone_points.hpp"

#include <array>
#include <atomic>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone {

enum class method : std::int32_t {
    linear = DELONE_LINEAR,
    nearest = DELONE_NEAREST,
    laplace = DELONE_LAPLACE,
    sibson = DELONE_SIBSON,
};

enum class crossings : std::uint32_t { refuse = 0, split = DELONE_SPLIT_CROSSINGS };

enum class fill : std::int32_t {
    all = DELONE_FILL_ALL,
    even_odd = DELONE_FILL_EVEN_ODD,
    nonzero = DELONE_FILL_NONZERO,
    seeds = DELONE_FILL_SEEDS,
};

enum class keep : std::int32_t {
    nothing = DELONE_KEEP_NOTHING,
    border = DELONE_KEEP_BORDER,
    constraints = DELONE_KEEP_CONSTRAINTS,
};

using triangle = std::array<std::uint32_t, 3>;
using tetrahedron = std::array<std::uint32_t, 4>;
using edge = std::array<std::uint32_t, 2>;
using point = std::array<double, 2>;
using point3 = std::array<double, 3>;

/// Whether the library is one that this header is for.
inline bool is_compatible() noexcept { return delone_abi_version() >> 16 == DELONE_ABI_VERSION >> 16; }

inline std::string version() { return delone_version(); }

/// The threads of the library; 0 is as many as there are cores.
inline void set_threads(std::uint32_t count) {
    fault f;
    raise(delone_set_threads(count, &f), f);
}

/// The Voronoi cells of all points of a triangulation, in a box.
class voronoi_cells {
public:
    std::size_t size() const noexcept { return areas_.size(); }
    const std::vector<point> &vertices() const noexcept { return vertices_; }
    /// One a point; 0 for duplicates.
    const std::vector<double> &areas() const noexcept { return areas_; }
    /// The corners of a cell in `vertices()`, counter-clockwise.
    view<std::uint32_t> ring(std::size_t i) const {
        check_index(i, areas_.size());
        return {corners_.data() + starts_[i], starts_[i + 1] - starts_[i]};
    }
    std::vector<point> polygon(std::size_t i) const {
        std::vector<point> corners;
        for (auto v : ring(i)) corners.push_back(vertices_[v]);
        return corners;
    }

private:
    friend class triangulation;
    explicit voronoi_cells(const delone_cells *cells) {
        std::size_t count = 0, corners = 0, vertices = 0;
        raise(delone_cells_counts(cells, &count, &corners, &vertices));
        starts_.resize(count + 1);
        corners_.resize(corners);
        vertices_.resize(vertices);
        areas_.resize(count);
        raise(delone_cells_rings(cells, starts_.data(), corners_.data()));
        raise(delone_cells_vertices(cells, numbers(vertices_)));
        raise(delone_cells_areas(cells, areas_.data()));
    }
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> corners_;
    std::vector<point> vertices_;
    std::vector<double> areas_;
};

/// A triangulation of the plane: Delaunay, constrained, regular, or a mesh.
class triangulation {
public:
    /// The Delaunay triangulation. Points at one place are one vertex: the first.
    explicit triangulation(const points2 &points) {
        fault f;
        raise(delone_tri2_new(points.raw(), receive(), &f), f);
    }
    /// The first x, the first y, how many, and from one to the next so many bytes.
    triangulation(const double *x, const double *y, std::size_t count, std::size_t stride = sizeof(double))
        : triangulation(points2(x, y, count, stride)) {}
    /// Takes what a function of delone.h gave.
    explicit triangulation(delone_tri2 *handle) noexcept : handle_(handle) {}

    triangulation(triangulation &&other) noexcept
        : handle_(std::move(other.handle_)), stars_(other.stars_.exchange(nullptr)) {}
    triangulation &operator=(triangulation &&other) noexcept {
        handle_ = std::move(other.handle_);
        delete stars_.exchange(other.stars_.exchange(nullptr));
        return *this;
    }
    ~triangulation() { delete stars_.load(); }

    /// For functions of delone.h.
    delone_tri2 *raw() const noexcept { return handle_.get(); }

    delone_counts counts() const {
        delone_counts counts = {};
        counts.size = sizeof counts;
        raise(delone_tri2_counts(raw(), &counts));
        return counts;
    }
    /// How many triangles there are.
    std::size_t size() const { return counts().simplices; }
    /// How many triangles of a mesh are not as wanted.
    std::size_t left() const {
        std::size_t count = 0;
        raise(delone_tri2_left(raw(), &count));
        return count;
    }

    /// All points, those given and then new ones; valid until the triangulation is changed.
    view<point> points() const {
        std::size_t count = 0;
        const double *xy = delone_tri2_points(raw(), &count);
        return {reinterpret_cast<const point *>(xy), count};
    }
    /// Counter-clockwise.
    std::vector<triangle> triangles() const {
        std::vector<triangle> corners(size());
        raise(delone_tri2_triangles(raw(), numbers(corners), nullptr));
        return corners;
    }
    /// The rows of the triangles across from each corner, -1 for none.
    std::vector<std::array<std::int32_t, 3>> neighbors() const {
        std::vector<std::array<std::int32_t, 3>> across(size());
        raise(delone_tri2_triangles(raw(), nullptr, numbers(across)));
        return across;
    }

    /// In the layout of delaunator: half-edge 3 t + k starts at `triangles[3 t + k]`, clockwise with y up; `halfedges` has the twin of
    /// each, or `npos`.
    struct half_edge_arrays {
        static constexpr std::size_t npos = static_cast<std::size_t>(-1);
        std::vector<std::size_t> triangles, halfedges;
    };
    half_edge_arrays half_edges() const {
        // Corners 0, 2, 1 are clockwise; the half-edge that starts there is across from corner 1, 0, 2.
        static constexpr std::size_t start[3] = {0, 2, 1}, across[3] = {1, 0, 2};
        std::vector<triangle> corners(size());
        std::vector<std::array<std::int32_t, 3>> next(corners.size());
        raise(delone_tri2_triangles(raw(), numbers(corners), numbers(next)));
        half_edge_arrays all;
        all.triangles.resize(3 * corners.size());
        all.halfedges.assign(3 * corners.size(), half_edge_arrays::npos);
        for (std::size_t t = 0; t < corners.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                all.triangles[3 * t + k] = corners[t][start[k]];
                if (next[t][across[k]] < 0) continue;
                auto other = static_cast<std::size_t>(next[t][across[k]]);
                // The twin starts where this half-edge ends.
                auto end = corners[t][start[(k + 1) % 3]];
                for (std::size_t j = 0; j < 3; ++j) {
                    if (corners[other][start[j]] == end) all.halfedges[3 * t + k] = 3 * other + j;
                }
            }
        }
        return all;
    }

    std::vector<edge> edges() const {
        std::vector<edge> ends(counts().edges);
        raise(delone_tri2_edges(raw(), numbers(ends), nullptr));
        return ends;
    }
    /// The edges that are constraints.
    std::vector<edge> constraints() const {
        std::vector<edge> ends(counts().edges), kept;
        std::vector<std::uint8_t> is_constraint(ends.size());
        raise(delone_tri2_edges(raw(), numbers(ends), is_constraint.data()));
        for (std::size_t e = 0; e < ends.size(); ++e) {
            if (is_constraint[e] != 0) kept.push_back(ends[e]);
        }
        return kept;
    }
    /// The edges of the hull, of a mesh those of its border, with the inside on their left.
    std::vector<edge> hull() const {
        std::vector<edge> ends(counts().hull);
        raise(delone_tri2_hull(raw(), numbers(ends)));
        return ends;
    }
    /// The neighbors of a point, counter-clockwise; valid until the triangulation is changed.
    view<std::uint32_t> star(std::size_t v) const {
        const csr &all = stars();
        check_index(v, all.starts.size() - 1);
        return {all.neighbors.data() + all.starts[v], all.starts[v + 1] - all.starts[v]};
    }
    /// For each triangle of a mesh the row of its region, -1 for none.
    std::vector<std::int32_t> regions() const {
        std::vector<std::int32_t> rows(size());
        raise(delone_tri2_regions(raw(), rows.data()));
        return rows;
    }
    /// For each point the vertex at its place: itself, but for duplicates.
    std::vector<std::uint32_t> vertices() const {
        std::vector<std::uint32_t> all(points().size());
        raise(delone_tri2_vertices(raw(), all.data()));
        return all;
    }

    /// The rows of the triangles that places are in, -1 outside.
    std::vector<std::int64_t> locate(const points2 &places) const {
        fault f;
        std::vector<std::int64_t> rows(places.size());
        raise(delone_tri2_locate(raw(), places.raw(), rows.data(), &f), f);
        return rows;
    }
    std::int64_t locate(const point &place) const { return locate(points2(&place[0], &place[1], 1))[0]; }

    /// The `k` nearest vertices of each place, by increasing distance; -1 where there are fewer.
    std::vector<std::int64_t> nearest(const points2 &places, std::uint32_t k = 1) const {
        fault f;
        std::vector<std::int64_t> rows(places.size() * k);
        raise(delone_tri2_nearest(raw(), places.raw(), k, rows.data(), &f), f);
        return rows;
    }
    std::int64_t nearest(const point &place) const { return nearest(points2(&place[0], &place[1], 1))[0]; }

    /// The value at each place, of one value a point; NaN outside of the hull.
    std::vector<double> interpolate(view<double> values, const points2 &places, method how = method::linear) const {
        fault f;
        std::vector<double> out(places.size());
        raise(delone_tri2_interpolate(raw(), values.data(), values.size(), places.raw(), static_cast<std::int32_t>(how),
                                      out.data(), &f),
              f);
        return out;
    }

    /// Proves that it is Delaunay, constrained Delaunay or regular, or throws.
    void check() const {
        fault f;
        raise(delone_tri2_check(raw(), &f), f);
    }

    /// Inserts points, and tells their indices.
    std::vector<std::uint32_t> insert(const points2 &points) {
        fault f;
        std::vector<std::uint32_t> ids(points.size());
        forget();
        raise(delone_tri2_insert(raw(), points.raw(), ids.data(), &f), f);
        return ids;
    }
    std::uint32_t insert(const point &p) { return insert(points2(&p[0], &p[1], 1))[0]; }

    /// Removes vertices.
    void remove(view<std::uint32_t> vertices) {
        fault f;
        forget();
        raise(delone_tri2_remove(raw(), vertices.data(), vertices.size(), &f), f);
    }
    void remove(std::initializer_list<std::uint32_t> vertices) {
        remove(view<std::uint32_t>(vertices.begin(), vertices.size()));
    }
    void remove(std::uint32_t vertex) { remove(view<std::uint32_t>(&vertex, 1)); }

    /// The cells in the box around all points, and a tenth of its larger side more on each side.
    voronoi_cells voronoi() const { return cells(nullptr); }
    /// The box: x and y of the lower left corner, then of the upper right one.
    voronoi_cells voronoi(const std::array<double, 4> &box) const { return cells(box.data()); }

private:
    struct deleter {
        void operator()(delone_tri2 *t) const noexcept { delone_tri2_free(t); }
        void operator()(delone_cells *cells) const noexcept { delone_cells_free(cells); }
    };
    struct csr {
        std::vector<std::size_t> starts;
        std::vector<std::uint32_t> neighbors;
    };
    /// A handle that is on its way into a unique_ptr: at the end of the full expression it is there, whatever is thrown.
    template <class H> struct receiver {
        std::unique_ptr<H, deleter> &to;
        H *handle = nullptr;
        operator H **() noexcept { return &handle; }
        ~receiver() { to.reset(handle); }
    };
    receiver<delone_tri2> receive() noexcept { return {handle_}; }

    void forget() noexcept { delete stars_.exchange(nullptr); }
    /// Made by the first who asks; of two at the same time one throws its own away.
    const csr &stars() const {
        if (const csr *known = stars_.load(std::memory_order_acquire)) return *known;
        auto made = std::make_unique<csr>();
        made->starts.resize(points().size() + 1);
        made->neighbors.resize(2 * counts().edges);
        raise(delone_tri2_stars(raw(), made->starts.data(), made->neighbors.data()));
        csr *known = nullptr;
        if (stars_.compare_exchange_strong(known, made.get(), std::memory_order_acq_rel)) return *made.release();
        return *known;
    }
    voronoi_cells cells(const double *box) const {
        fault f;
        std::unique_ptr<delone_cells, deleter> handle;
        raise(delone_tri2_voronoi(raw(), box, receiver<delone_cells>{handle}, &f), f);
        return voronoi_cells(handle.get());
    }

    std::unique_ptr<delone_tri2, deleter> handle_;
    mutable std::atomic<csr *> stars_{nullptr};
};

/// The constrained Delaunay triangulation; segments are pairs of indices of points.
inline triangulation constrained(const points2 &points, const pairs &segments, crossings how = crossings::refuse) {
    fault f;
    delone_tri2 *handle = nullptr;
    raise(delone_constrained2_new(points.raw(), segments.data(), segments.size(), static_cast<std::uint32_t>(how), &handle, &f), f);
    return triangulation(handle);
}

/// The regular triangulation, of weights in units of squared length.
inline triangulation regular(const points2 &points, view<double> weights) {
    fault f;
    if (weights.size() != points.size()) fail(DELONE_ARGUMENT, -1, "as many weights as points are needed");
    delone_tri2 *handle = nullptr;
    raise(delone_regular2_new(points.raw(), weights.data(), &handle, &f), f);
    return triangulation(handle);
}

/// A triangulation, or the fault.
template <class T> class expected {
public:
    expected(T &&value) noexcept : value_(std::make_unique<T>(std::move(value))) {}
    expected(const fault &f) noexcept : fault_(f) {}
    bool has_value() const noexcept { return value_ != nullptr; }
    explicit operator bool() const noexcept { return has_value(); }
    T &operator*() noexcept { return *value_; }
    const T &operator*() const noexcept { return *value_; }
    T *operator->() noexcept { return value_.get(); }
    const T *operator->() const noexcept { return value_.get(); }
    T &value() {
        raise(fault_.status, fault_);
        return *value_;
    }
    /// Its status is 0 if there is a value.
    const fault &error() const noexcept { return fault_; }

private:
    std::unique_ptr<T> value_;
    fault fault_;
};

inline expected<triangulation> try_triangulate(const points2 &points) noexcept {
    fault f;
    delone_tri2 *handle = nullptr;
    if (delone_tri2_new(points.raw(), &handle, &f) != DELONE_GOOD) return f;
    return triangulation(handle);
}

inline expected<triangulation> try_constrained(const points2 &points, const pairs &segments,
                                               crossings how = crossings::refuse) noexcept {
    fault f;
    delone_tri2 *handle = nullptr;
    auto flags = static_cast<std::uint32_t>(how);
    if (delone_constrained2_new(points.raw(), segments.data(), segments.size(), flags, &handle, &f) != DELONE_GOOD) return f;
    return triangulation(handle);
}

/// A triangulation of space.
class triangulation3 {
public:
    explicit triangulation3(const points3 &points) {
        fault f;
        delone_tri3 *handle = nullptr;
        raise(delone_tri3_new(points.raw(), &handle, &f), f);
        handle_.reset(handle);
    }
    delone_tri3 *raw() const noexcept { return handle_.get(); }
    delone_counts counts() const {
        delone_counts counts = {};
        counts.size = sizeof counts;
        raise(delone_tri3_counts(raw(), &counts));
        return counts;
    }
    /// How many tetrahedra there are.
    std::size_t size() const { return counts().simplices; }
    /// The first three corners are seen counter-clockwise from the fourth.
    std::vector<tetrahedron> tetrahedra() const {
        std::vector<tetrahedron> corners(size());
        raise(delone_tri3_tetrahedra(raw(), numbers(corners), nullptr));
        return corners;
    }
    std::vector<std::array<std::int32_t, 4>> neighbors() const {
        std::vector<std::array<std::int32_t, 4>> across(size());
        raise(delone_tri3_tetrahedra(raw(), nullptr, numbers(across)));
        return across;
    }
    /// The triangles of the hull, counter-clockwise from outside.
    std::vector<triangle> hull() const {
        std::vector<triangle> corners(counts().hull);
        raise(delone_tri3_hull(raw(), numbers(corners)));
        return corners;
    }
    std::vector<std::int64_t> locate(const points3 &places) const {
        fault f;
        std::vector<std::int64_t> rows(places.size());
        raise(delone_tri3_locate(raw(), places.raw(), rows.data(), &f), f);
        return rows;
    }
    std::int64_t locate(const point3 &place) const { return locate(points3(&place[0], &place[1], &place[2], 1))[0]; }
    std::vector<std::int64_t> nearest(const points3 &places, std::uint32_t k = 1) const {
        fault f;
        std::vector<std::int64_t> rows(places.size() * k);
        raise(delone_tri3_nearest(raw(), places.raw(), k, rows.data(), &f), f);
        return rows;
    }
    std::int64_t nearest(const point3 &place) const { return nearest(points3(&place[0], &place[1], &place[2], 1))[0]; }
    std::vector<double> interpolate(view<double> values, const points3 &places, method how = method::linear) const {
        fault f;
        std::vector<double> out(places.size());
        raise(delone_tri3_interpolate(raw(), values.data(), values.size(), places.raw(), static_cast<std::int32_t>(how),
                                      out.data(), &f),
              f);
        return out;
    }
    void check() const {
        fault f;
        raise(delone_tri3_check(raw(), &f), f);
    }

private:
    struct deleter {
        void operator()(delone_tri3 *t) const noexcept { delone_tri3_free(t); }
    };
    std::unique_ptr<delone_tri3, deleter> handle_;
};

} // namespace delone

#include "delone_mesh.hpp"

#endif
