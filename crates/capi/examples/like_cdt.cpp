// For users of CDT: vertices, edges, and what is outside or in holes taken away. Duplicates and crossings need no work before.
#include <cstdio>
#include <delone.hpp>

int main() {
    std::vector<delone::point> vertices{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {2, 3}, {4, 4}};
    std::vector<delone::edge> edges{{0, 1}, {1, 7}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 4}};
    // insertVertices, insertEdges, eraseOuterTrianglesAndHoles:
    auto t = delone::mesh(vertices, edges).inside(delone::fill::even_odd).split_crossings().run();
    for (auto [a, b, c] : t.triangles()) std::printf("%u %u %u\n", a, b, c);
    // And with angles of 30 degrees:
    auto fine = delone::mesh(vertices, edges).inside(delone::fill::even_odd).min_angle(30).max_area(.1).run();
    std::printf("%zu triangles, %zu points\n", fine.size(), fine.points().size());
}
