// The functions of the package over delone.hpp: __delone__ (name, arguments). Indices count from 1 on this side.

#include <octave/oct.h>
#include <octave/interpreter.h>
#include <octave/ov-struct.h>
#include <octave/parse.h>

#include <delone.hpp>

#include <map>

// A triangulation as a value of Octave: it goes when no variable has it.
class octave_delone : public octave_base_value {
public:
    octave_delone() = default;
    explicit octave_delone(delone::triangulation &&t) : plane(std::make_shared<delone::triangulation>(std::move(t))) {}
    explicit octave_delone(delone::triangulation3 &&t) : space(std::make_shared<delone::triangulation3>(std::move(t))) {}
    octave_base_value *clone() const override { return new octave_delone(*this); }
    octave_base_value *empty_clone() const override { return new octave_delone(); }
    bool is_defined() const override { return true; }
    dim_vector dims() const override { return dim_vector(1, 1); }
    void print(std::ostream &out, bool = false) override { out << "<triangulation>\n"; }

    std::shared_ptr<const delone::triangulation> plane;
    std::shared_ptr<const delone::triangulation3> space;

    DECLARE_OV_TYPEID_FUNCTIONS_AND_DATA
};
DEFINE_OV_TYPEID_FUNCTIONS_AND_DATA(octave_delone, "delone triangulation", "delone")

static const octave_delone &handle(const octave_value &value) {
    auto *handle = dynamic_cast<const octave_delone *>(&value.get_rep());
    if (handle == nullptr || (!handle->plane && !handle->space)) error("delone: this is no triangulation");
    return *handle;
}

static const delone::triangulation &plane(const octave_value &value) {
    const auto &t = handle(value).plane;
    if (!t) error("delone: this is for triangulations of the plane");
    return *t;
}

static Matrix numbers(const octave_value &value, const char *what) {
    if (!value.isnumeric() || value.iscomplex()) error("delone: %s are real numbers", what);
    return value.matrix_value();
}

// Columns of a matrix are read where they are.
static delone::points2 points2(const Matrix &p) {
    if (p.columns() != 2) error("delone: a matrix of 2 columns is needed, not %ld", static_cast<long>(p.columns()));
    auto n = static_cast<std::size_t>(p.rows());
    return {p.data(), p.data() + n, n};
}

static delone::points3 points3(const Matrix &p) {
    if (p.columns() != 3) error("delone: a matrix of 3 columns is needed, not %ld", static_cast<long>(p.columns()));
    auto n = static_cast<std::size_t>(p.rows());
    return {p.data(), p.data() + n, p.data() + 2 * n, n};
}

static std::vector<std::array<std::int64_t, 2>> segments(const octave_value &value) {
    Matrix ends = numbers(value, "segments");
    if (ends.isempty()) return {};
    if (ends.columns() != 2) error("delone: segments are a matrix of 2 columns");
    std::vector<std::array<std::int64_t, 2>> rows;
    for (octave_idx_type i = 0; i < ends.rows(); ++i) {
        std::array<std::int64_t, 2> row;
        for (octave_idx_type k = 0; k < 2; ++k) {
            double index = ends(i, k);
            if (!(index >= 1 && index <= 4294967295.0 && index == std::floor(index))) {
                error_with_id("delone:index", "delone: row %ld of the segments has %g, which is no index", static_cast<long>(i + 1), index);
            }
            row[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(index) - 1;
        }
        rows.push_back(row);
    }
    return rows;
}

// Rows of indices as a matrix that counts from 1; NaN for negative ones.
template <class T, std::size_t N> static Matrix indices(const std::vector<std::array<T, N>> &rows) {
    auto count = static_cast<octave_idx_type>(rows.size());
    Matrix m(count, static_cast<octave_idx_type>(N));
    for (octave_idx_type i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < N; ++k) {
            auto index = static_cast<double>(rows[static_cast<std::size_t>(i)][k]);
            m(i, static_cast<octave_idx_type>(k)) = index < 0 ? octave_NaN : index + 1;
        }
    }
    return m;
}

static Matrix indices(const std::vector<std::int64_t> &items, octave_idx_type columns = 1) {
    auto count = static_cast<octave_idx_type>(items.size()) / columns;
    Matrix m(count, columns);
    for (octave_idx_type i = 0; i < count; ++i) {
        for (octave_idx_type k = 0; k < columns; ++k) {
            auto index = items[static_cast<std::size_t>(i * columns + k)];
            m(i, k) = index < 0 ? octave_NaN : static_cast<double>(index) + 1;
        }
    }
    return m;
}

template <class Range> static Matrix coordinates(const Range &points) {
    Matrix m(static_cast<octave_idx_type>(points.size()), 2);
    octave_idx_type i = 0;
    for (const auto &p : points) {
        m(i, 0) = p[0];
        m(i, 1) = p[1];
        ++i;
    }
    return m;
}

static ColumnVector column(const std::vector<double> &values) {
    ColumnVector c(static_cast<octave_idx_type>(values.size()));
    std::copy(values.begin(), values.end(), c.fortran_vec());
    return c;
}

static octave_value_list make(const octave_value_list &args) {
    Matrix p = numbers(args(0), "points");
    if (p.columns() == 3) return ovl(octave_value(new octave_delone(delone::triangulation3(points3(p)))));
    if (args.length() < 2 || args(1).isempty()) return ovl(octave_value(new octave_delone(delone::triangulation(points2(p)))));
    auto how = args.length() > 2 && args(2).bool_value() ? delone::crossings::split : delone::crossings::refuse;
    return ovl(octave_value(new octave_delone(delone::constrained(points2(p), segments(args(1)), how))));
}

static octave_value_list simplices(const octave_value_list &args) {
    const auto &t = handle(args(0));
    return ovl(t.space ? indices(t.space->tetrahedra()) : indices(t.plane->triangles()));
}

static octave_value_list neighbors(const octave_value_list &args) {
    const auto &t = handle(args(0));
    return ovl(t.space ? indices(t.space->neighbors()) : indices(t.plane->neighbors()));
}

static octave_value_list hull(const octave_value_list &args) {
    const auto &t = handle(args(0));
    return ovl(t.space ? indices(t.space->hull()) : indices(t.plane->hull()));
}

static octave_value_list edges(const octave_value_list &args) { return ovl(indices(plane(args(0)).edges())); }

static octave_value_list constraints(const octave_value_list &args) { return ovl(indices(plane(args(0)).constraints())); }

static octave_value_list points(const octave_value_list &args) { return ovl(coordinates(plane(args(0)).points())); }

static octave_value_list check(const octave_value_list &args) {
    const auto &t = handle(args(0));
    t.space ? t.space->check() : t.plane->check();
    return ovl(true);
}

static octave_value_list locate(const octave_value_list &args) {
    const auto &t = handle(args(0));
    Matrix q = numbers(args(1), "places");
    return ovl(indices(t.space ? t.space->locate(points3(q)) : t.plane->locate(points2(q))));
}

static octave_value_list nearest(const octave_value_list &args) {
    const auto &t = handle(args(0));
    Matrix q = numbers(args(1), "places");
    int k = args(2).int_value();
    if (k < 1) error("delone: the number of nearest points is at least 1");
    auto each = static_cast<std::uint32_t>(k);
    return ovl(indices(t.space ? t.space->nearest(points3(q), each) : t.plane->nearest(points2(q), each), k));
}

static octave_value_list interpolate(const octave_value_list &args) {
    const auto &t = handle(args(0));
    NDArray z = args(1).array_value();
    Matrix q = numbers(args(2), "places");
    auto how = static_cast<delone::method>(args(3).int_value());
    delone::view<double> values(z.data(), static_cast<std::size_t>(z.numel()));
    return ovl(column(t.space ? t.space->interpolate(values, points3(q), how) : t.plane->interpolate(values, points2(q), how)));
}

static octave_value_list voronoi(const octave_value_list &args) {
    const auto &t = plane(args(0));
    NDArray box = args(1).array_value();
    if (!box.isempty() && box.numel() != 4) error("delone: a box is [least x, least y, largest x, largest y]");
    auto cells = box.isempty() ? t.voronoi() : t.voronoi({box(0), box(1), box(2), box(3)});
    auto count = static_cast<octave_idx_type>(cells.size());
    Cell rings(count, 1);
    for (octave_idx_type i = 0; i < count; ++i) {
        auto ring = cells.ring(static_cast<std::size_t>(i));
        RowVector corners(static_cast<octave_idx_type>(ring.size()));
        for (std::size_t k = 0; k < ring.size(); ++k) corners(static_cast<octave_idx_type>(k)) = ring[k] + 1.0;
        rings(i) = corners;
    }
    return ovl(coordinates(cells.vertices()), rings, column(cells.areas()));
}

static octave_value_list mesh(const octave_value_list &args) {
    Matrix p = numbers(args(0), "points");
    auto work = delone::mesh(points2(p), segments(args(1)));
    octave_scalar_map wishes = args(2).scalar_map_value();
    auto number = [&](const char *name) { return wishes.getfield(name).double_value(); };
    work.inside(static_cast<delone::fill>(wishes.getfield("fill").int_value()));
    work.keep_whole(static_cast<delone::keep>(wishes.getfield("keep").int_value()));
    if (number("split") != 0) work.split_crossings();
    work.min_angle(number("min_angle")).max_area(number("max_area")).max_edge(number("max_edge")).min_edge(number("min_edge"));
    work.max_vertices(static_cast<std::size_t>(number("max_vertices")));
    Matrix holes = wishes.getfield("holes").matrix_value();
    for (octave_idx_type i = 0; i < holes.rows(); ++i) work.hole(holes(i, 0), holes(i, 1));
    octave_value area_at = wishes.getfield("area_at"), unsuitable = wishes.getfield("unsuitable");
    // Errors of these functions are exceptions: they come out of `run`.
    if (!area_at.isempty()) work.area_at([=](double x, double y) { return octave::feval(area_at, ovl(x, y), 1)(0).double_value(); });
    if (!unsuitable.isempty()) {
        work.unsuitable([=](const std::array<delone::point, 3> &corners, double area) {
            return octave::feval(unsuitable, ovl(coordinates(corners), area), 1)(0).bool_value();
        });
    }
    work.progress([](std::uint64_t) { octave_quit(); });
    return ovl(octave_value(new octave_delone(work.run())));
}

// The message counts from 1, as Octave does.
[[noreturn]] static void fail(const delone::error &e) {
    std::string id = std::string("delone:") + delone_status_name(e.status());
    std::replace(id.begin(), id.end(), ' ', '-');
    auto row = static_cast<long>(e.index() + 1);
    const char *words = delone_status_name(e.status());
    if (row == 0) {
        error_with_id(id.c_str(), "delone: %s", e.what());
    } else if (e.status() == DELONE_NOT_FINITE) {
        error_with_id(id.c_str(), "delone: row %ld is not finite: NaN, NA or Inf", row);
    } else if (e.status() == DELONE_CROSSING) {
        error_with_id(id.c_str(), "delone: segment %ld crosses another one", row);
    }
    error_with_id(id.c_str(), "delone: row %ld: %s", row, words);
}

using action = octave_value_list (*)(const octave_value_list &);
struct row {
    action call;
    octave_idx_type arguments;
};
static const std::map<std::string, row> ACTIONS{
    {"new", {make, 1}},         {"simplices", {simplices, 1}}, {"neighbors", {neighbors, 1}}, {"hull", {hull, 1}},
    {"edges", {edges, 1}},      {"points", {points, 1}},       {"check", {check, 1}},         {"constraints", {constraints, 1}},
    {"locate", {locate, 2}},    {"nearest", {nearest, 3}},     {"mesh", {mesh, 3}},           {"interpolate", {interpolate, 4}},
    {"voronoi", {voronoi, 2}},
};

DEFMETHOD_DLD(__delone__, interp, args, , "__delone__ (NAME, ...): for the functions of the package.") {
    // The type of values stays known: the file is not unloaded.
    static const bool is_known = [&] {
        interp.mlock();
        octave_delone::register_type();
        return true;
    }();
    static_cast<void>(is_known);
    if (!delone::is_compatible()) error("delone: libdelone is of another version than this package");
    if (args.length() == 0) print_usage();
    auto found = ACTIONS.find(args(0).xstring_value("delone: a name is needed"));
    if (found == ACTIONS.end()) error("delone: there is no such function");
    octave_value_list rest = args.slice(1, args.length() - 1);
    if (rest.length() < found->second.arguments) error("delone: arguments are missing");
    try {
        return found->second.call(rest);
    } catch (const delone::error &e) {
        fail(e);
    }
}
