// Tests of delone.hpp: returns how many assertions failed.
#include "delone.hpp"

#include <algorithm>
#include <cstdio>
#include <random>
#include <set>
#include <thread>

static int failures = 0;

#define CHECK(...)                                                                                   \
    do {                                                                                             \
        if (!(__VA_ARGS__)) {                                                                        \
            ++failures;                                                                              \
            std::fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, #__VA_ARGS__);         \
        }                                                                                            \
    } while (false)

/// Checks the status, and the index, of the error that a function throws.
template <class F> static void throws(int line, std::int32_t status, std::int64_t index, F f) {
    try {
        f();
        std::fprintf(stderr, "line %d: nothing was thrown\n", line);
    } catch (const delone::error &e) {
        if (e.status() == status && (index < -1 || e.index() == index) && e.what()[0] != '\0') return;
        std::fprintf(stderr, "line %d: status %d, index %lld: %s\n", line, static_cast<int>(e.status()),
                     static_cast<long long>(e.index()), e.what());
    }
    ++failures;
}
#define THROWS(status, index, ...) throws(__LINE__, status, index, [&] { __VA_ARGS__; })
/// For faults of which no item is told.
static constexpr std::int64_t ANY_INDEX = -2;

struct named_point {
    double x, y;
    int name;
};
struct point_inside {
    named_point at;
    int weight;
};
struct number_first {
    int name;
    double x, y;
};
struct mixed {
    float x;
    double y;
};
struct float_point {
    float x, y;
};
class with_methods {
public:
    with_methods(double x, double y) : at_{x, y} {}
    double x() const { return at_[0]; }
    double y() const { return at_[1]; }

private:
    double at_[2];
};

/// As matrices of Eigen are: of two columns, one after the other.
struct matrix {
    const std::vector<double> &numbers;
    std::ptrdiff_t columns = 2;
    const double *data() const { return numbers.data(); }
    std::ptrdiff_t rows() const { return static_cast<std::ptrdiff_t>(numbers.size()) / columns; }
    std::ptrdiff_t cols() const { return columns; }
    std::ptrdiff_t rowStride() const { return 1; }
    std::ptrdiff_t colStride() const { return rows(); }
};

template <class T> constexpr bool is_plane = std::is_constructible_v<delone::points2, std::vector<T>>;
static_assert(is_plane<named_point> && is_plane<point_inside> && is_plane<float_point> && is_plane<with_methods>);
static_assert(is_plane<std::pair<double, double>> && is_plane<std::complex<double>> && is_plane<std::array<double, 3>>);
static_assert(!is_plane<number_first> && !is_plane<mixed> && !is_plane<std::pair<int, double>> && !is_plane<double>);
static_assert(std::is_constructible_v<delone::points2, double[4][2]>);
static_assert(std::is_constructible_v<delone::points3, std::vector<std::array<float, 3>>>);
static_assert(!std::is_constructible_v<delone::points3, std::vector<delone::point>>);
static_assert(std::is_nothrow_move_constructible_v<delone::triangulation> && !std::is_copy_constructible_v<delone::triangulation>);

static std::vector<delone::point> random_points(std::size_t count) {
    std::mt19937_64 source(7);
    std::uniform_real_distribution<double> number(0, 1);
    std::vector<delone::point> points(count);
    for (auto &p : points) p = {number(source), number(source)};
    return points;
}

static double area(const delone::triangulation &t) {
    double sum = 0;
    auto p = t.points();
    for (auto [a, b, c] : t.triangles()) {
        sum += ((p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[b][1] - p[a][1]) * (p[c][0] - p[a][0])) / 2;
    }
    return sum;
}

static bool is_close(double a, double b) { return std::abs(a - b) < 1e-9; }

/// The triangles as a set, each from its least corner.
static std::set<delone::triangle> set_of(const delone::triangulation &t) {
    std::set<delone::triangle> all;
    for (auto corners : t.triangles()) {
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        all.insert(corners);
    }
    return all;
}

static void library() {
    CHECK(delone::is_compatible());
    CHECK(!delone::version().empty());
    CHECK(std::string(delone_status_name(DELONE_GOOD)) != std::string(delone_status_name(DELONE_BUG)));
    delone::set_threads(2);
    delone::set_threads(0);
}

static void ranges() {
    auto points = random_points(50);
    delone::triangulation t(points);
    auto expected = set_of(t);
    CHECK(expected.size() == t.size());
    std::vector<named_point> named;
    std::vector<point_inside> inside;
    std::vector<with_methods> methods;
    std::vector<std::complex<double>> complex;
    std::vector<double> flat, x, y;
    double rows[50][2];
    for (std::size_t i = 0; i < points.size(); ++i) {
        auto [px, py] = points[i];
        named.push_back({px, py, 1});
        inside.push_back({{px, py, 1}, 2});
        methods.emplace_back(px, py);
        complex.emplace_back(px, py);
        flat.insert(flat.end(), {px, py});
        x.push_back(px);
        y.push_back(py);
        rows[i][0] = px;
        rows[i][1] = py;
    }
    CHECK(set_of(delone::triangulation(named)) == expected);
    CHECK(set_of(delone::triangulation(inside)) == expected);
    CHECK(set_of(delone::triangulation(methods)) == expected);
    CHECK(set_of(delone::triangulation(complex)) == expected);
    CHECK(set_of(delone::triangulation(rows)) == expected);
    CHECK(set_of(delone::triangulation(delone::xy(flat))) == expected);
    CHECK(set_of(delone::triangulation(x.data(), y.data(), x.size())) == expected);
    CHECK(set_of(delone::triangulation(&named[0].x, &named[0].y, named.size(), sizeof named[0])) == expected);
    CHECK(set_of(delone::triangulation(t.points())) == expected);
    auto columns = x;
    columns.insert(columns.end(), y.begin(), y.end());
    CHECK(set_of(delone::triangulation(matrix{columns})) == expected);
    THROWS(DELONE_ARGUMENT, -1, delone::triangulation(matrix{columns, 4}));
    std::vector<float_point> floats{{0, 0}, {1, 0}, {0, 1}};
    CHECK(delone::triangulation(floats).size() == 1);
    THROWS(DELONE_ARGUMENT, -1, delone::xy(std::vector<double>{1, 2, 3}));
}

static void rows() {
    auto points = random_points(300);
    points.push_back(points[5]);
    delone::triangulation t(points);
    auto counts = t.counts();
    CHECK(counts.dimension == 2 && counts.vertices == 300 && counts.duplicates == 1);
    CHECK(t.points().size() == 301 && t.points()[3] == points[3]);
    CHECK(t.vertices()[300] == 5 && t.vertices()[7] == 7);
    CHECK(t.edges().size() == counts.vertices + counts.simplices - 1);
    CHECK(t.constraints().empty());
    auto corners = t.triangles();
    auto across = t.neighbors();
    std::size_t open = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (across[i][k] < 0) {
                ++open;
                continue;
            }
            auto other = corners[static_cast<std::size_t>(across[i][k])];
            CHECK(std::count(other.begin(), other.end(), corners[i][(k + 1) % 3]) == 1);
            CHECK(std::count(other.begin(), other.end(), corners[i][(k + 2) % 3]) == 1);
            CHECK(std::count(other.begin(), other.end(), corners[i][k]) == 0);
        }
    }
    CHECK(open == counts.hull && t.hull().size() == open);
    auto [flat, twins] = t.half_edges();
    CHECK(flat.size() == 3 * corners.size() && twins.size() == flat.size());
    auto next = [](std::size_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    for (std::size_t e = 0; e < flat.size(); ++e) {
        if (twins[e] == delone::triangulation::half_edge_arrays::npos) continue;
        CHECK(twins[twins[e]] == e && flat[next(e)] == flat[twins[e]] && flat[next(twins[e])] == flat[e]);
    }
    auto p = t.points();
    auto a = p[flat[0]], b = p[flat[1]], c = p[flat[2]];
    CHECK((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0);
    std::size_t ends = 0;
    for (std::size_t v = 0; v < points.size(); ++v) ends += t.star(v).size();
    CHECK(ends == 2 * counts.edges && t.star(300).empty() && t.star(5).size() > 2);
    THROWS(DELONE_INDEX, 301, t.star(301));
    t.check();
}

static void queries() {
    auto points = random_points(200);
    delone::triangulation t(points);
    CHECK(t.locate({-1, 0}) == -1);
    auto corners = t.triangles()[9];
    delone::point middle{};
    for (auto v : corners) {
        middle[0] += points[v][0] / 3;
        middle[1] += points[v][1] / 3;
    }
    CHECK(t.locate(middle) == 9);
    CHECK(t.locate(std::vector<delone::point>{middle, {5, 5}}) == std::vector<std::int64_t>{9, -1});
    CHECK(t.nearest(points[17]) == 17);
    auto near = t.nearest(points, 3);
    CHECK(near.size() == 600 && near[0] == 0 && near[597] == 199);
    CHECK(delone::triangulation(std::vector<delone::point>{{0, 0}}).nearest(points, 2)[1] == -1);
    std::vector<double> values;
    for (auto [x, y] : points) values.push_back(2 * x - 3 * y + 1);
    std::vector<delone::point> places{middle, {9, 9}};
    for (auto how : {delone::method::linear, delone::method::laplace, delone::method::sibson}) {
        auto found = t.interpolate(values, places, how);
        CHECK(is_close(found[0], 2 * middle[0] - 3 * middle[1] + 1) && std::isnan(found[1]));
    }
    auto nearest = t.interpolate(values, places, delone::method::nearest)[0];
    CHECK(is_close(nearest, values[static_cast<std::size_t>(t.nearest(middle))]));
    THROWS(DELONE_ARGUMENT, ANY_INDEX, t.interpolate(std::vector<double>{1}, places));
    THROWS(DELONE_NOT_FINITE, 1, t.locate(std::vector<delone::point>{{0, 0}, {NAN, 0}}));
    // Many threads ask one handle, also the first time.
    std::vector<std::thread> threads;
    std::atomic<std::size_t> ends{0};
    for (int i = 0; i < 8; ++i) threads.emplace_back([&] { ends += t.star(3).size() + (t.locate(middle) == 9 ? 0 : 100); });
    for (auto &thread : threads) thread.join();
    CHECK(ends == 8 * t.star(3).size());
}

static void changes() {
    auto points = random_points(100);
    std::vector<delone::point> begin(points.begin(), points.begin() + 50), rest(points.begin() + 50, points.end());
    delone::triangulation t(begin), all(points);
    CHECK(t.star(0).size() > 1);
    auto ids = t.insert(rest);
    CHECK(ids.size() == 50 && ids[0] == 50 && ids[49] == 99);
    CHECK(set_of(t) == set_of(all));
    CHECK(t.star(99).size() == all.star(99).size());
    auto id = t.insert({.5, .5});
    CHECK(t.nearest(delone::point{.5, .5}) == id);
    t.remove(id);
    CHECK(set_of(t) == set_of(all));
    t.remove({3u, 8u});
    CHECK(t.counts().vertices == 98);
    t.remove(std::vector<std::uint32_t>{9});
    CHECK(t.star(0).size() > 1);
    t.check();
    THROWS(DELONE_INDEX, ANY_INDEX, t.remove(5000));
    delone::triangulation moved(std::move(t));
    all = std::move(moved);
    CHECK(all.counts().vertices == 97 && all.star(0).size() > 1);
    THROWS(DELONE_ARGUMENT, -1, moved.counts());
}

static const std::vector<delone::point> SQUARE{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {1, 3}};
static const std::vector<std::pair<int, int>> RINGS{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};

static void segments() {
    auto t = delone::constrained(SQUARE, RINGS);
    CHECK(t.constraints().size() == 8 && is_close(area(t), 16));
    t.check();
    std::vector<std::array<std::uint32_t, 2>> diagonals{{0, 2}, {1, 3}};
    std::vector<delone::point> corners(SQUARE.begin(), SQUARE.begin() + 4);
    THROWS(DELONE_CROSSING, ANY_INDEX, delone::constrained(corners, diagonals));
    auto split = delone::constrained(corners, diagonals, delone::crossings::split);
    CHECK(split.points().size() == 5 && split.points()[4] == delone::point{2, 2} && split.size() == 4);
    THROWS(DELONE_INDEX, 0, delone::constrained(corners, {{0, 9}}));
    THROWS(DELONE_INDEX, 1, delone::constrained(corners, std::vector<std::array<int, 2>>{{0, 1}, {0, -1}}));
    auto r = delone::try_constrained(corners, diagonals);
    CHECK(!r && r.error().status == DELONE_CROSSING);
}

static void meshes() {
    auto inside = delone::mesh(SQUARE, RINGS).inside(delone::fill::even_odd).run();
    CHECK(is_close(area(inside), 12) && inside.points().size() == 8);
    auto fine = delone::mesh(SQUARE, RINGS).hole(2, 2).min_angle(30).max_area(.1).run();
    CHECK(is_close(area(fine), 12) && fine.size() >= 120);
    auto bounded = delone::mesh(SQUARE, RINGS).max_edge(.5).keep_whole(delone::keep::nothing).run();
    CHECK(bounded.size() > 100);
    auto regions = delone::mesh(SQUARE, RINGS).region(2, 2, 7, .1).region(.5, .5, 8).run();
    CHECK(is_close(area(regions), 16));
    auto rows = regions.regions();
    CHECK(regions.left() == 0 && std::count(rows.begin(), rows.end(), 0) >= 40 && std::count(rows.begin(), rows.end(), 1) >= 8);
    auto graded = delone::mesh(SQUARE, RINGS).size([](double x, double) { return .1 + x / 4; }).run();
    CHECK(graded.size() > bounded.size());
    auto by_area = delone::mesh(SQUARE, RINGS).area_at([](double, double) { return .05; }).run();
    CHECK(by_area.size() >= 320);
    auto left = delone::mesh(SQUARE, RINGS)
                    .unsuitable([](const std::array<delone::point, 3> &c, double a) { return c[0][0] < 1 && a > .01; })
                    .run();
    CHECK(left.size() > 100);
    std::uint64_t told = 0;
    delone::mesh(SQUARE, RINGS).max_area(1e-4).progress([&](std::uint64_t count) { told = count; }).run();
    CHECK(told > 0);
    THROWS(DELONE_STOPPED, ANY_INDEX, delone::mesh(SQUARE, RINGS).max_area(1e-4).progress([](auto) { return true; }).run());
    auto cut_short = delone::mesh(SQUARE, RINGS).max_area(1e-4).max_vertices(100).run();
    CHECK(cut_short.points().size() <= 108 && cut_short.size() < 400);
    THROWS(DELONE_ARGUMENT, ANY_INDEX, delone::mesh(SQUARE, RINGS).min_angle(75).run());
}

struct own_exception {
    int number;
};

/// What a callback throws comes out of `run`, and nothing is called after it.
template <class F> static void comes_out(F make) {
    int calls = 0;
    try {
        make(calls).run();
        CHECK(!"nothing was thrown");
    } catch (const own_exception &e) {
        CHECK(e.number == 42 && calls == 1);
    }
}

static void exceptions() {
    auto base = [] { return delone::mesh(SQUARE, RINGS).max_area(1e-4); };
    comes_out([&](int &calls) {
        return base().unsuitable([&](const auto &, double) -> bool { throw own_exception{42 + 0 * ++calls}; });
    });
    comes_out([&](int &calls) { return base().size([&](double, double) -> double { throw own_exception{42 + 0 * ++calls}; }); });
    comes_out([&](int &calls) { return base().progress([&](std::uint64_t) { throw own_exception{42 + 0 * ++calls}; }); });
}

static void cells() {
    std::vector<delone::point> points{{1, 1}, {3, 1}, {1, 3}, {3, 3}, {1, 1}};
    delone::triangulation t(points);
    auto cells = t.voronoi({0, 0, 4, 4});
    CHECK(cells.size() == 5 && cells.ring(4).empty() && cells.areas()[4] == 0);
    for (std::size_t i = 0; i < 4; ++i) CHECK(is_close(cells.areas()[i], 4) && cells.polygon(i).size() == 4);
    auto wide = t.voronoi();
    double sum = 0;
    for (double a : wide.areas()) sum += a;
    CHECK(is_close(sum, 2.4 * 2.4));
    THROWS(DELONE_INDEX, 5, cells.ring(5));
    THROWS(DELONE_ARGUMENT, ANY_INDEX, t.voronoi({4, 4, 0, 0}));
}

static void weights() {
    std::vector<delone::point> points{{0, 0}, {4, 0}, {0, 4}, {1, 1}};
    CHECK(delone::regular(points, std::vector<double>(4)).size() == 3);
    auto hidden = delone::regular(points, std::vector<double>{0, 0, 0, -100});
    CHECK(hidden.size() == 1 && hidden.counts().vertices == 3);
    hidden.check();
    THROWS(DELONE_ARGUMENT, -1, delone::regular(points, std::vector<double>{1}));
}

static void space() {
    std::mt19937_64 source(7);
    std::uniform_real_distribution<double> number(0, 1);
    std::vector<delone::point3> points(200);
    std::vector<double> values;
    for (auto &p : points) {
        p = {number(source), number(source), number(source)};
        values.push_back(p[0] + 2 * p[1] - p[2]);
    }
    delone::triangulation3 t(points);
    t.check();
    CHECK(t.counts().dimension == 3 && t.tetrahedra().size() == t.size() && t.neighbors().size() == t.size());
    CHECK(t.hull().size() == t.counts().hull);
    delone::point3 middle{};
    auto corners = t.tetrahedra()[4];
    for (auto v : corners) {
        for (std::size_t k = 0; k < 3; ++k) middle[k] += points[v][k] / 4;
    }
    CHECK(t.locate(middle) == 4 && t.locate({9, 9, 9}) == -1 && t.nearest(points[6]) == 6);
    std::vector<delone::point3> places{middle};
    CHECK(is_close(t.interpolate(values, places)[0], middle[0] + 2 * middle[1] - middle[2]));
    CHECK(delone::triangulation3(delone::xyz(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})).size() == 1);
    points[3][2] = INFINITY;
    THROWS(DELONE_NOT_FINITE, 3, delone::triangulation3{points});
}

static void faults() {
    auto points = random_points(10);
    points[4][1] = NAN;
    THROWS(DELONE_NOT_FINITE, 4, delone::triangulation{points});
    auto r = delone::try_triangulate(points);
    CHECK(!r && r.error().status == DELONE_NOT_FINITE && r.error().index == 4);
    THROWS(DELONE_NOT_FINITE, 4, r.value());
    points[4][1] = .5;
    auto good = delone::try_triangulate(points);
    CHECK(good && good->size() > 5 && good.error().status == DELONE_GOOD);
    static_assert(noexcept(delone::try_triangulate(points)));
    delone::triangulation none(std::vector<delone::point>{});
    CHECK(none.size() == 0 && none.counts().dimension == -1 && none.triangles().empty() && none.half_edges().triangles.empty());
    delone::triangulation line(std::vector<delone::point>{{0, 0}, {1, 1}, {2, 2}});
    CHECK(line.size() == 0 && line.counts().dimension == 1 && line.edges().size() == 2 && line.star(1).size() == 2);
}

int main() {
    for (auto test : {library, ranges, rows, queries, changes, segments, meshes, exceptions, cells, weights, space, faults}) {
        try {
            test();
        } catch (const std::exception &e) {
            ++failures;
            std::fprintf(stderr, "thrown: %s\n", e.what());
        }
    }
    std::printf("%d failures\n", failures);
    return failures;
}
