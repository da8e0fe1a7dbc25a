/* All functions of delone.h, by a program in C89: it ends with 0, or tells the line that is wrong. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "delone.h"

#define IS(what) \
    do { \
        if (!(what)) { \
            printf("line %d: %s\n", __LINE__, #what); \
            exit(1); \
        } \
    } while (0)

static double random_number(void) { return rand() / (RAND_MAX + 1.0); }

static delone_error fresh(void) {
    delone_error e;
    memset(&e, 0xff, sizeof e);
    e.size = (uint32_t)sizeof e;
    return e;
}

static delone_counts counts_of(const delone_tri2 *t) {
    delone_counts c;
    memset(&c, 0xff, sizeof c);
    c.size = (uint32_t)sizeof c;
    IS(delone_tri2_counts(t, &c) == 0);
    return c;
}

static double cross(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Triangles are positive, neighbors tell of each other, and the areas are those of the hull. */
static void is_good(const delone_tri2 *t, double area) {
    delone_counts c = counts_of(t);
    size_t n, i, k, m, edges_of_hull = 0;
    const double *p = delone_tri2_points(t, &n);
    uint32_t *corners = malloc((3 * c.simplices + 1) * sizeof *corners);
    int32_t *neighbors = malloc((3 * c.simplices + 1) * sizeof *neighbors);
    double sum = 0;
    IS(n == c.points);
    memset(corners, 0xff, (3 * c.simplices + 1) * sizeof *corners);
    memset(neighbors, 0xff, (3 * c.simplices + 1) * sizeof *neighbors);
    IS(delone_tri2_triangles(t, corners, neighbors) == 0);
    IS(delone_tri2_triangles(t, NULL, NULL) == 0);
    IS(corners[3 * c.simplices] == 0xffffffffu);
    for (i = 0; i < c.simplices; i++) {
        double twice = cross(p + 2 * corners[3 * i], p + 2 * corners[3 * i + 1], p + 2 * corners[3 * i + 2]);
        IS(twice > 0);
        sum += twice / 2;
        for (k = 0; k < 3; k++) {
            int32_t other = neighbors[3 * i + k];
            int shared = 0;
            if (other < 0) {
                edges_of_hull++;
                continue;
            }
            for (m = 0; m < 3; m++) {
                uint32_t v = corners[3 * (size_t)other + m];
                shared += v == corners[3 * i + (k + 1) % 3] || v == corners[3 * i + (k + 2) % 3];
                IS(v != corners[3 * i + k]);
            }
            IS(shared == 2);
        }
    }
    IS(edges_of_hull == c.hull && 2 * c.edges == 3 * c.simplices + c.hull);
    IS(fabs(sum - area) < 1e-9 * area);
    free(corners);
    free(neighbors);
}

static void plane(void) {
    enum { COUNT = 3000, PLACES = 500 };
    static double xy[2 * COUNT], values[COUNT], out[PLACES], places[2 * PLACES];
    static float columns[2][COUNT];
    static int64_t rows[PLACES], found[2 * PLACES];
    static uint32_t ids[2], vertex[COUNT + 2];
    static size_t starts[COUNT + 1];
    delone_points p, q;
    delone_tri2 *t = NULL, *u = NULL;
    delone_cells *cells = NULL;
    delone_error e = fresh();
    delone_counts c;
    size_t i, corners, vertices;
    double box[4], sum = 0, *areas;
    uint32_t *edges, *stars;
    uint8_t *fixed;
    srand(1);
    for (i = 0; i < COUNT; i++) {
        xy[2 * i] = columns[0][i] = (float)random_number();
        xy[2 * i + 1] = columns[1][i] = (float)random_number();
        values[i] = 3 * xy[2 * i] - xy[2 * i + 1];
    }
    xy[0] = xy[1] = columns[0][0] = columns[1][0] = 0;
    xy[2] = columns[0][1] = 1, xy[3] = columns[1][1] = 0;
    xy[4] = xy[5] = columns[0][2] = columns[1][2] = 1;
    xy[6] = columns[0][3] = 0, xy[7] = columns[1][3] = 1;
    xy[8] = columns[0][4] = 0, xy[9] = columns[1][4] = 0; /* the first point again */
    for (i = 0; i < 5; i++) values[i] = 3 * xy[2 * i] - xy[2 * i + 1];
    IS(delone_tri2_new((p = delone_xy(xy, COUNT), &p), &t, &e) == 0);
    is_good(t, 1);
    c = counts_of(t);
    IS(c.points == COUNT && c.vertices == COUNT - 1 && c.duplicates == 1 && c.dimension == 2 && c.hull == 4);
    IS(c.simplices == 2 * c.vertices - 2 - c.hull && c.edges == 3 * c.vertices - 3 - c.hull && c.constraints == 0);
    IS(delone_tri2_check(t, &e) == 0);
    /* Columns of floats make the same. */
    memset(&p, 0, sizeof p);
    p.size = (uint32_t)sizeof p, p.type = DELONE_FLOAT, p.count = COUNT, p.stride = sizeof(float);
    p.x = columns[0], p.y = columns[1];
    IS(delone_tri2_new(&p, &u, &e) == 0);
    is_good(u, 1);
    IS(memcmp(delone_tri2_points(u, NULL), xy, sizeof xy) == 0);
    delone_tri2_free(u);
    IS(delone_tri2_vertices(t, vertex) == 0);
    for (i = 0; i < COUNT; i++) IS(vertex[i] == (i == 4 ? 0 : i));
    /* Edges and stars. */
    edges = malloc(2 * c.edges * sizeof *edges);
    fixed = malloc(c.edges);
    stars = malloc(2 * c.edges * sizeof *stars);
    IS(delone_tri2_edges(t, edges, fixed) == 0 && delone_tri2_stars(t, starts, stars) == 0);
    IS(starts[0] == 0 && starts[COUNT] == 2 * c.edges && starts[4] == starts[5] && fixed[0] == 0);
    for (i = 0; i < c.edges; i++) {
        size_t k, is_there = 0;
        for (k = starts[edges[2 * i]]; k < starts[edges[2 * i] + 1]; k++) is_there += stars[k] == edges[2 * i + 1];
        IS(is_there == 1);
    }
    IS(delone_tri2_hull(t, edges) == 0);
    free(edges), free(fixed), free(stars);
    /* Queries. */
    for (i = 0; i < 2 * PLACES; i++) places[i] = 1.2 * random_number() - 0.1;
    q = delone_xy(places, PLACES);
    IS(delone_tri2_locate(t, &q, rows, &e) == 0 && delone_tri2_nearest(t, &q, 2, found, &e) == 0);
    IS(delone_tri2_interpolate(t, values, COUNT, &q, DELONE_LINEAR, out, &e) == 0);
    for (i = 0; i < PLACES; i++) {
        const double *at = places + 2 * i;
        int inside = at[0] > 0 && at[0] < 1 && at[1] > 0 && at[1] < 1;
        IS((rows[i] >= 0) == inside);
        IS(inside ? fabs(out[i] - 3 * at[0] + at[1]) < 1e-9 : out[i] != out[i]);
        IS(found[2 * i] >= 0 && found[2 * i] != found[2 * i + 1]);
    }
    IS(delone_tri2_interpolate(t, values, COUNT, &q, DELONE_SIBSON, out, &e) == 0);
    IS(delone_tri2_interpolate(t, values, COUNT - 1, &q, DELONE_LINEAR, out, &e) == DELONE_ARGUMENT);
    IS(delone_tri2_interpolate(t, values, COUNT, &q, 9, out, &e) == DELONE_ARGUMENT && e.message[0]);
    places[7] = HUGE_VAL;
    IS(delone_tri2_locate(t, &q, rows, &e) == DELONE_NOT_FINITE && e.index == 3);
    /* Cells. */
    box[0] = box[1] = -1, box[2] = box[3] = 2;
    IS(delone_tri2_voronoi(t, box, &cells, &e) == 0);
    IS(delone_cells_counts(cells, &i, &corners, &vertices) == 0 && i == COUNT);
    areas = malloc(COUNT * sizeof *areas);
    stars = malloc(corners * sizeof *stars);
    edges = NULL;
    IS(delone_cells_areas(cells, areas) == 0 && delone_cells_rings(cells, starts, stars) == 0);
    IS(starts[COUNT] == corners && starts[4] == starts[5] && areas[4] == 0);
    for (i = 0; i < COUNT; i++) sum += areas[i];
    IS(fabs(sum - 9) < 1e-9);
    for (i = 0; i < corners; i++) IS(stars[i] < vertices);
    delone_cells_free(cells), free(areas), free(stars);
    box[2] = -3;
    IS(delone_tri2_voronoi(t, box, &cells, &e) == DELONE_ARGUMENT && cells == NULL);
    /* Changes. */
    places[0] = 0.5, places[1] = 0.25, places[2] = xy[20], places[3] = xy[21];
    q = delone_xy(places, 2);
    IS(delone_tri2_insert(t, &q, ids, &e) == 0 && ids[0] == COUNT && ids[1] == 10);
    IS(counts_of(t).points == COUNT + 1);
    is_good(t, 1);
    IS(delone_tri2_remove(t, ids, 2, &e) == 0 && delone_tri2_check(t, &e) == 0);
    IS(counts_of(t).vertices == COUNT - 2);
    IS(delone_tri2_voronoi(t, NULL, &cells, &e) == 0);
    delone_cells_free(cells);
    IS(delone_tri2_remove(t, ids, 1, &e) == DELONE_INDEX && e.index == 0);
    delone_tri2_free(t);
}

static int32_t too_large(void *user, const double *corners, double area) {
    ++*(int *)user;
    return area > 0.001 && corners[0] < 0.5;
}

static double small_on_the_left(void *user, double x, double y) {
    (void)user, (void)y;
    return x < 1 ? 0.001 : 1;
}

static int32_t after_so_many(void *user, uint64_t vertices) {
    return --*(int *)user < 0 && vertices < (uint64_t)-1;
}

static void meshes(void) {
    static const double xy[] = {0, 0, 2, 0, 2, 1, 0, 1, 0.5, 0.25, 0.75, 0.25, 0.75, 0.5, 0.5, 0.5};
    static const uint32_t segments[] = {0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4};
    static const uint32_t crossing[] = {0, 2, 1, 3};
    static const double holes[] = {0.6, 0.4};
    delone_region region = {{1.5, 0.5}, 7, 0.01};
    delone_mesh_options o;
    delone_points p = delone_xy(xy, 8);
    delone_tri2 *t = NULL;
    delone_error e = fresh();
    int32_t *regions;
    int calls = 0;
    size_t i, n;
    IS(delone_constrained2_new(&p, segments, 8, 0, &t, &e) == 0);
    is_good(t, 2);
    IS(counts_of(t).constraints == 8 && counts_of(t).simplices == 10);
    IS(delone_tri2_regions(t, NULL) == DELONE_DIMENSION);
    delone_tri2_free(t);
    IS(delone_constrained2_new(&p, crossing, 2, 0, &t, &e) == DELONE_CROSSING && e.index == 0 && t == NULL);
    IS(delone_constrained2_new(&p, crossing, 2, DELONE_SPLIT_CROSSINGS, &t, &e) == 0);
    IS(counts_of(t).points == 9 && counts_of(t).constraints == 5);
    delone_tri2_free(t);
    IS(delone_constrained2_new(&p, crossing, 2, 64, &t, &e) == DELONE_ARGUMENT);
    IS(delone_mesh2_new(&p, segments, 8, NULL, &t, &e) == 0);
    is_good(t, 2);
    delone_tri2_free(t);
    memset(&o, 0, sizeof o);
    o.size = (uint32_t)sizeof o, o.fill = DELONE_FILL_EVEN_ODD, o.min_angle = 30, o.max_area = 0.01;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == 0);
    is_good(t, 2 - 0.0625);
    IS(counts_of(t).simplices > 200 && delone_tri2_check(t, &e) == 0);
    IS(delone_tri2_left(t, &n) == 0 && n == 0);
    IS(delone_tri2_insert(t, &p, NULL, &e) == DELONE_ARGUMENT);
    delone_tri2_free(t);
    o.fill = DELONE_FILL_SEEDS, o.holes = holes, o.hole_count = 1, o.regions = &region, o.region_count = 1, o.max_area = 0;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == 0);
    is_good(t, 2 - 0.0625);
    n = counts_of(t).simplices;
    regions = malloc(n * sizeof *regions);
    IS(n > 180 && delone_tri2_regions(t, regions) == 0);
    for (i = 0; i < n; i++) IS(regions[i] == 0);
    free(regions), delone_tri2_free(t);
    region.max_area = -1;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == DELONE_ARGUMENT && strstr(e.message, "region") != NULL);
    region.max_area = 1e-300;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == DELONE_ARGUMENT);
    o.region_count = 0, o.user = &calls, o.unsuitable = too_large;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == 0 && calls > 500);
    IS(counts_of(t).simplices > 400);
    delone_tri2_free(t);
    o.unsuitable = NULL, o.area_at = small_on_the_left;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == 0 && counts_of(t).simplices > 900);
    delone_tri2_free(t);
    /* Stopped at each of its calls in turn. */
    o.progress = after_so_many;
    for (i = 0;; i++) {
        int32_t status;
        calls = (int)i;
        status = delone_mesh2_new(&p, segments, 8, &o, &t, &e);
        if (status == 0) break;
        IS(status == DELONE_STOPPED && t == NULL);
    }
    IS(i > 1);
    delone_tri2_free(t);
    o.progress = NULL, o.max_vertices = 5;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == 0 && counts_of(t).points == 8 + 5);
    IS(delone_tri2_left(t, &n) == 0 && n > 0);
    delone_tri2_free(t);
    o.size = 3;
    IS(delone_mesh2_new(&p, segments, 8, &o, &t, &e) == DELONE_ARGUMENT);
}

static void space(void) {
    enum { COUNT = 500 };
    static double xyz[3 * COUNT], values[COUNT], out[4], places[12];
    static int64_t rows[4], found[4];
    delone_points p = delone_xyz(xyz, COUNT), q = delone_xyz(places, 4);
    delone_tri3 *t = NULL;
    delone_error e = fresh();
    delone_counts c;
    size_t i, k, outside = 0;
    uint32_t *corners;
    int32_t *neighbors;
    srand(2);
    for (i = 0; i < 3 * COUNT; i++) xyz[i] = random_number();
    for (i = 0; i < COUNT; i++) values[i] = xyz[3 * i] + 2 * xyz[3 * i + 2];
    IS(delone_tri3_new(&p, &t, &e) == 0);
    c.size = (uint32_t)sizeof c;
    IS(delone_tri3_counts(t, &c) == 0 && c.vertices == COUNT && c.dimension == 3 && c.simplices > COUNT);
    corners = malloc(4 * c.simplices * sizeof *corners);
    neighbors = malloc(4 * c.simplices * sizeof *neighbors);
    IS(delone_tri3_tetrahedra(t, corners, neighbors) == 0);
    for (i = 0; i < 4 * c.simplices; i++) {
        outside += neighbors[i] < 0;
        for (k = 0; k < 4; k++) IS(neighbors[i] < 0 || corners[4 * (size_t)neighbors[i] + k] != corners[i]);
    }
    IS(outside == c.hull && delone_tri3_hull(t, corners) == 0 && delone_tri3_check(t, &e) == 0);
    for (i = 0; i < 9; i++) places[i] = 0.3 + 0.04 * (double)i;
    places[9] = places[10] = places[11] = 5;
    IS(delone_tri3_locate(t, &q, rows, &e) == 0 && rows[0] >= 0 && rows[3] == -1);
    IS(delone_tri3_nearest(t, &q, 1, found, &e) == 0 && found[0] >= 0 && found[3] >= 0);
    IS(delone_tri3_interpolate(t, values, COUNT, &q, DELONE_LINEAR, out, &e) == 0 && out[3] != out[3]);
    IS(fabs(out[0] - places[0] - 2 * places[2]) < 1e-9);
    free(corners), free(neighbors), delone_tri3_free(t);
}

/* Points on a line have edges and stars, and no triangle. */
static void on_a_line(void) {
    static const double xy[] = {0, 0, 3, 3, 1, 1, 2, 2};
    delone_points p = delone_xy(xy, 4);
    delone_tri2 *t;
    delone_counts c;
    size_t starts[5], n;
    uint32_t stars[6], ends[6];
    int64_t row;
    IS(delone_tri2_new(&p, &t, NULL) == 0);
    c = counts_of(t);
    IS(c.dimension == 1 && c.vertices == 4 && c.simplices == 0 && c.edges == 3 && c.hull == 0);
    IS(delone_tri2_edges(t, ends, NULL) == 0 && delone_tri2_stars(t, starts, stars) == 0 && starts[4] == 6);
    IS(starts[1] == 1 && stars[0] == 2);
    p.count = 1;
    IS(delone_tri2_locate(t, &p, &row, NULL) == 0 && row == -1);
    IS(delone_tri2_left(t, &n) == DELONE_DIMENSION);
    delone_tri2_free(t);
}

/* Cases of an attack: all or none, boxes after removal, points of the handle itself, numbers that are none. */
static void attacked(void) {
    static const double xy[] = {0, 0, 1, 0, 1, 1, 0, 1, 1000, 1000, 0.4, 0.5}, far[] = {0, 0, 1.7e308, 0, 0, 1.7e308};
    static const uint32_t segments[] = {0, 1, 1, 2}, some[] = {4, 5, 0};
    static const double seed[] = {0.5, HUGE_VAL};
    delone_points p = delone_xy(xy, 6), none = delone_xy(NULL, 0);
    delone_mesh_options o;
    delone_tri2 *t;
    delone_cells *cells;
    delone_error e = fresh();
    size_t n, m, i;
    uint32_t vertices[6];
    double areas[6], corners[2 * 60], sum = 0, box[4] = {0, 0, 1, 0};
    IS(delone_constrained2_new(&p, segments, 2, 0, &t, &e) == 0);
    IS(delone_tri2_remove(t, some, 3, &e) == DELONE_ARGUMENT && e.index == 2 && counts_of(t).vertices == 6);
    IS(delone_tri2_interpolate(t, xy, 3, &none, DELONE_LINEAR, NULL, &e) == DELONE_ARGUMENT);
    IS(delone_tri2_interpolate(t, xy, 6, &none, DELONE_SIBSON, NULL, &e) == DELONE_ARGUMENT);
    delone_tri2_free(t);
    IS(delone_tri2_new(&p, &t, &e) == 0 && delone_tri2_remove(t, some, 1, &e) == 0);
    IS(delone_tri2_vertices(t, vertices) == 0 && vertices[4] == DELONE_NO_VERTEX && vertices[5] == 5);
    IS(delone_tri2_voronoi(t, NULL, &cells, &e) == 0 && delone_cells_areas(cells, areas) == 0);
    for (i = 0; i < 6; i++) sum += areas[i];
    IS(fabs(sum - 1.44) < 1e-12 && delone_cells_counts(cells, NULL, &m, &n) == 0 && n <= m && n <= 60);
    IS(delone_cells_vertices(cells, corners) == 0);
    for (i = 0; i < 2 * n; i++) IS(fabs(corners[i]) < 2);
    delone_cells_free(cells);
    box[3] = HUGE_VAL;
    IS(delone_tri2_voronoi(t, box, &cells, &e) == DELONE_NOT_FINITE && e.index == 3);
    p = delone_xy(delone_tri2_points(t, &n), 6);
    IS(delone_tri2_insert(t, &p, vertices, &e) == 0 && vertices[5] == 5 && counts_of(t).vertices == 6);
    delone_tri2_free(t);
    p = delone_xy(far, 3);
    IS(delone_tri2_new(&p, &t, &e) == 0 && delone_tri2_voronoi(t, NULL, &cells, &e) == 0);
    delone_cells_free(cells), delone_tri2_free(t);
    IS(delone_tri2_new(&none, &t, &e) == 0 && delone_tri2_voronoi(t, NULL, &cells, &e) == DELONE_DIMENSION);
    delone_tri2_free(t);
    memset(&o, 0, sizeof o);
    o.size = (uint32_t)sizeof o, o.fill = DELONE_FILL_SEEDS, o.holes = seed, o.hole_count = 1;
    IS(delone_mesh2_new(&p, NULL, 0, &o, &t, &e) == DELONE_NOT_FINITE && e.index == 0);
}

static void wrong(void) {
    double xy[] = {0, 0, 1, 0, 0, 1, 5, 5}, weights[] = {0, 0, 0, -10};
    uint32_t segments[] = {0, 1, 1, 9};
    delone_points p = delone_xy(xy, 4), q;
    delone_tri2 *t = (delone_tri2 *)xy;
    delone_error e = fresh();
    delone_counts c;
    IS(delone_tri2_new(NULL, &t, &e) == DELONE_ARGUMENT && t == NULL && e.status == DELONE_ARGUMENT && e.index == -1);
    IS(delone_tri2_new(&p, NULL, &e) == DELONE_ARGUMENT);
    IS(delone_tri2_new(NULL, &t, NULL) == DELONE_ARGUMENT);
    IS(delone_constrained2_new(&p, segments, 2, 0, &t, &e) == DELONE_INDEX && e.index == 1);
    IS(delone_constrained2_new(&p, NULL, 2, 0, &t, &e) == DELONE_ARGUMENT);
    q = p, q.x = NULL;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_ARGUMENT && strstr(e.message, "x is NULL") != NULL);
    q = p, q.stride = 4;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_ARGUMENT);
    q = p, q.stride = (size_t)-1;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_ARGUMENT);
    q = p, q.type = 7;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_ARGUMENT);
    q = p, q.size = 8;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_ARGUMENT);
    q = p, q.count = (size_t)1 << 31;
    IS(delone_tri2_new(&q, &t, &e) == DELONE_TOO_MANY);
    xy[5] = HUGE_VAL - HUGE_VAL;
    IS(delone_tri2_new(&p, &t, &e) == DELONE_NOT_FINITE && e.index == 2);
    xy[5] = 1;
    /* A struct of an older program is shorter. */
    e.size = 8, e.index = 77;
    IS(delone_tri2_new(NULL, &t, &e) == DELONE_ARGUMENT && e.index == 77);
    e.size = 20, e.message[3] = 'x', e.message[4] = 'y';
    IS(delone_tri2_new(NULL, &t, &e) == DELONE_ARGUMENT && e.message[3] == 0 && e.message[4] == 'y');
    e.size = (uint32_t)sizeof e;
    q = delone_xy(NULL, 0);
    IS(delone_tri2_new(&q, &t, &e) == 0 && counts_of(t).points == 0 && counts_of(t).dimension == -1);
    c.size = 4;
    IS(delone_tri2_counts(t, &c) == DELONE_ARGUMENT && delone_tri2_counts(NULL, &c) == DELONE_ARGUMENT);
    IS(delone_tri2_counts(t, NULL) == DELONE_ARGUMENT && delone_tri2_points(NULL, NULL) == NULL);
    delone_tri2_free(t);
    on_a_line();
    delone_tri2_free(NULL), delone_tri3_free(NULL), delone_cells_free(NULL);
    xy[6] = xy[7] = 0.25; /* hidden by the others */
    IS(delone_regular2_new(&p, weights, &t, &e) == 0 && counts_of(t).vertices == 3 && delone_tri2_check(t, &e) == 0);
    delone_tri2_free(t);
    IS(delone_abi_version() == DELONE_ABI_VERSION && delone_version()[0] == '0');
    IS(strcmp(delone_status_name(2), "not finite") == 0 && strcmp(delone_status_name(-7), "unknown") == 0);
    IS(delone_set_threads(2, &e) == 0);
}

int main(void) {
    wrong();
    attacked();
    plane();
    meshes();
    space();
    IS(delone_set_threads(0, NULL) == 0);
    puts("all is well");
    return 0;
}
