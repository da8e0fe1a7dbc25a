// For users of delaunator-cpp: coordinates one after the other, flat triangles, half-edges.
#include <cstdio>
#include <delone.hpp>

int main() {
    std::vector<double> coords{-1, 1, 1, 1, 1, -1, -1, -1};
    // delaunator::Delaunator d(coords):
    auto d = delone::triangulation(delone::xy(coords)).half_edges();
    for (std::size_t i = 0; i < d.triangles.size(); i += 3) {
        std::printf("%zu %zu %zu\n", d.triangles[i], d.triangles[i + 1], d.triangles[i + 2]);
    }
    for (auto twin : d.halfedges) std::printf("%zd ", static_cast<std::ptrdiff_t>(twin));
    std::printf("\n");
}
