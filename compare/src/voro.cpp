// Voro++ behind a C function: cells of points in the unit cube, with volumes, centroids, neighbors, areas of faces and their corners.
#include <voro++/voro++.hh>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

// Sums the volumes and counts the faces. Returns seconds.
extern "C" double voro_cells(const double *xyz, std::size_t n, double *volume, std::size_t *faces) {
    auto start = std::chrono::steady_clock::now();
    // The size of blocks that its manual recommends.
    int blocks = static_cast<int>(std::cbrt(static_cast<double>(n) / 5.6)) + 1;
    voro::container container(0, 1, 0, 1, 0, 1, blocks, blocks, blocks, false, false, false, 8);
    for (std::size_t i = 0; i < n; ++i)
        container.put(static_cast<int>(i), xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    voro::c_loop_all loop(container);
    voro::voronoicell_neighbor cell;
    std::vector<int> neighbors, corners;
    std::vector<double> areas, vertices;
    *volume = 0;
    *faces = 0;
    if (loop.start()) do if (container.compute_cell(cell, loop)) {
        double x, y, z, a, b, c;
        loop.pos(x, y, z);
        *volume += cell.volume();
        cell.centroid(a, b, c);
        cell.neighbors(neighbors);
        cell.face_areas(areas);
        cell.face_vertices(corners);
        cell.vertices(x, y, z, vertices);
        *faces += neighbors.size();
    } while (loop.inc());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
