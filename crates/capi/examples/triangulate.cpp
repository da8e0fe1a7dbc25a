// The triangles of points of an own type, that are not copied.
#include <cstdio>
#include <delone.hpp>

struct tree {
    double x, y;
    int age;
};

int main() {
    std::vector<tree> trees{{0, 0, 5}, {4, 0, 7}, {4, 3, 9}, {0, 3, 50}, {1, 1, 2}};
    delone::triangulation t(trees);
    for (auto [a, b, c] : t.triangles()) std::printf("%u %u %u\n", a, b, c);
    for (auto v : t.star(4)) std::printf("tree 4 has a neighbor of age %d\n", trees[v].age);
}
