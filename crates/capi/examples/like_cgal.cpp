// For users of CGAL's Delaunay_triangulation_2: insert, locate, nearest_vertex, incident_vertices, remove, is_valid.
#include <cstdio>
#include <delone.hpp>

int main() {
    std::vector<delone::point> points{{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}};
    delone::triangulation t(points); // a Point_2 of CGAL with doubles is read as it is, too
    auto v = t.insert({2, 2});
    std::printf("face %d, nearest vertex %d\n", static_cast<int>(t.locate({1, .5})), static_cast<int>(t.nearest({1, .5})));
    for (auto w : t.star(v)) std::printf("%u is beside %u\n", w, v);
    t.remove(v);
    t.check(); // throws what is wrong
}
