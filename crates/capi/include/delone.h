/*
 * delone.h: exact Delaunay triangulation for C. C89 with stdint.h.
 *
 * Functions that can fail return a status: 0 is good. They fill in the error of the caller, if there is one, and set the results that are
 * handles to NULL. Nothing is printed, and no global state is kept but the threads.
 *
 * Points are borrowed while a call runs. Results are written into memory of the caller: ask for counts, then for rows. Pointers
 * that a getter returns are valid until the handle is changed or freed.
 *
 * Any number of threads may ask one handle at the same time; while one changes it, no other may.
 */
#ifndef DELONE_H
#define DELONE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface: the upper 16 bits change when a program must be compiled anew. */
#define DELONE_ABI_VERSION 65536u

/* Statuses. */
#define DELONE_GOOD 0
#define DELONE_ARGUMENT 1   /* a pointer, a stride, a number out of range */
#define DELONE_NOT_FINITE 2 /* a coordinate that is NaN or infinite: `index` is its row */
#define DELONE_CROSSING 3   /* segments cross: `index` is one of them */
#define DELONE_INDEX 4      /* an index out of range: `index` is its row */
#define DELONE_TOO_MANY 5   /* more points than 2^29, in space 2^27 */
#define DELONE_MEMORY 6     /* there is no memory */
#define DELONE_STOPPED 7    /* the callback of the caller said so */
#define DELONE_DIMENSION 8  /* the points do not span the plane, or the handle has no such rows */
#define DELONE_BUG 9        /* please report it */

/* What went wrong. Set `size` to sizeof(delone_error). */
typedef struct delone_error {
    uint32_t size;
    int32_t status;
    int64_t index;     /* the first item that is wrong, or -1 */
    char message[240]; /* UTF-8 */
} delone_error;

#define DELONE_DOUBLE 0
#define DELONE_FLOAT 1

/*
 * Points anywhere in memory: the first x, the first y, and in space the first z. From one point to the next it is `stride` bytes, of each
 * coordinate alike. So rows of structs and columns are both read as they are.
 */
typedef struct delone_points {
    uint32_t size; /* sizeof(delone_points) */
    int32_t type;  /* DELONE_DOUBLE or DELONE_FLOAT */
    size_t count;
    size_t stride; /* at least the size of a number */
    const void *x;
    const void *y;
    const void *z; /* NULL in the plane */
} delone_points;

/* Triangulations of the plane and of space; clipped Voronoi cells. */
typedef struct delone_tri2 delone_tri2;
typedef struct delone_tri3 delone_tri3;
typedef struct delone_cells delone_cells;

/* Numbers of rows. */
typedef struct delone_counts {
    uint32_t size;       /* sizeof(delone_counts) */
    int32_t dimension;   /* of the hull: -1 without points, else 0 to 3 */
    size_t points;       /* indices of points, those of duplicates and of removed points included */
    size_t vertices;     /* points that are vertices */
    size_t simplices;    /* triangles, or tetrahedra */
    size_t edges;        /* 0 in space */
    size_t hull;         /* facets of the hull: edges, or triangles */
    size_t constraints;  /* edges that are constraints */
    size_t duplicates;   /* points at the place of another one */
} delone_counts;

/* --- The library ------------------------------------------------------------------------------------------------------------------ */

uint32_t delone_abi_version(void);
/* As "0.1.0". */
const char *delone_version(void);
/* As "not finite"; "unknown" for a number that is no status. */
const char *delone_status_name(int32_t status);
/* The threads of this library: without a call as many as there are cores, or RAYON_NUM_THREADS. 0 is that, too. */
int32_t delone_set_threads(uint32_t count, delone_error *error);

/* Points one after the other: x, y; or x, y, z. */
delone_points delone_xy(const double *xy, size_t count);
delone_points delone_xyz(const double *xyz, size_t count);

/* --- Triangulations of the plane -------------------------------------------------------------------------------------------------- */

/* The Delaunay triangulation. Points at one place are one vertex: the first. */
int32_t delone_tri2_new(const delone_points *points, delone_tri2 **out, delone_error *error);

/* Segments that cross are an error without this flag; with it they get a vertex there. */
#define DELONE_SPLIT_CROSSINGS 1u

/* The constrained Delaunay triangulation with `segment_count` segments, pairs of indices of points. All of the hull is triangulated. */
int32_t delone_constrained2_new(const delone_points *points, const uint32_t *segments, size_t segment_count, uint32_t flags,
                                delone_tri2 **out, delone_error *error);

/* The regular triangulation, of weights in units of squared length. */
int32_t delone_regular2_new(const delone_points *points, const double *weights, delone_tri2 **out, delone_error *error);

#define DELONE_FILL_ALL 0      /* all of the hull */
#define DELONE_FILL_EVEN_ODD 1 /* what an odd number of segments is around */
#define DELONE_FILL_NONZERO 2  /* where the winding number is not zero */
#define DELONE_FILL_SEEDS 3    /* without holes, and without bays of the hull: as Triangle does */

#define DELONE_KEEP_NOTHING 0     /* segments are divided where that helps */
#define DELONE_KEEP_BORDER 1      /* no vertex on the border */
#define DELONE_KEEP_CONSTRAINTS 2 /* no vertex on any segment */

/* A region by a point in it, of DELONE_FILL_SEEDS. */
typedef struct delone_region {
    double at[2];
    double attribute;
    double max_area; /* 0: none of its own; not negative */
} delone_region;

/*
 * The wishes for a mesh. Set all to 0, and `size` to sizeof(delone_mesh_options); then what is wanted. Lengths, areas and angles of 0 are no
 * wish. Callbacks are called on the thread of the caller.
 */
typedef struct delone_mesh_options {
    uint32_t size;
    uint32_t flags;       /* DELONE_SPLIT_CROSSINGS */
    int32_t fill;         /* DELONE_FILL_... */
    int32_t keep;         /* DELONE_KEEP_... */
    double min_angle;     /* degrees, 0 to below 60; up to 30 is usually reached */
    double max_area;
    double max_edge;
    double min_edge;      /* no edge with a new vertex is shorter */
    size_t max_vertices;  /* new ones; 0: no bound but the library's. At the bound the mesh is as it is: see delone_tri2_left */
    const double *holes;  /* x, y of a point in each hole, of DELONE_FILL_SEEDS */
    size_t hole_count;
    const delone_region *regions;
    size_t region_count;
    void *user;           /* what callbacks get */
    /* The largest area of a triangle at a place; NULL for none. */
    double (*area_at)(void *user, double x, double y);
    /* Nonzero if a triangle must get smaller: its corners x0, y0, x1, y1, x2, y2, and its area; NULL for none. */
    int32_t (*unsuitable)(void *user, const double *corners, double area);
    /* How many new vertices there are, now and then; nonzero stops. NULL for none. */
    int32_t (*progress)(void *user, uint64_t new_vertices);
} delone_mesh_options;

/* A mesh: the constrained triangulation, refined. `options` may be NULL. Its triangles are those inside. */
int32_t delone_mesh2_new(const delone_points *points, const uint32_t *segments, size_t segment_count,
                         const delone_mesh_options *options, delone_tri2 **out, delone_error *error);

/* NULL is fine. */
void delone_tri2_free(delone_tri2 *t);

int32_t delone_tri2_counts(const delone_tri2 *t, delone_counts *counts);
/* All points, x and y in turn: those given, in their order, then new ones. */
const double *delone_tri2_points(const delone_tri2 *t, size_t *count);
/*
 * Three indices of points a triangle, counter-clockwise; and three rows of neighbors, the k-th across from the k-th corner, -1 for none. Each may be
 * NULL.
 */
int32_t delone_tri2_triangles(const delone_tri2 *t, uint32_t *corners, int32_t *neighbors);
/* Two indices an edge, and 1 for constraints. Each may be NULL. */
int32_t delone_tri2_edges(const delone_tri2 *t, uint32_t *ends, uint8_t *is_constraint);
/* The edges of the hull, of a mesh those of its border: two indices each, with what is inside on their left. */
int32_t delone_tri2_hull(const delone_tri2 *t, uint32_t *ends);
/*
 * The neighbors of each point: those of point i are neighbors[starts[i]] to neighbors[starts[i + 1]], counter-clockwise. `starts` has one number
 * more than there are points, `neighbors` two for each edge. Each may be NULL.
 */
int32_t delone_tri2_stars(const delone_tri2 *t, size_t *starts, uint32_t *neighbors);
/* The region of each triangle of a mesh, by its row in the options; -1 for none. */
int32_t delone_tri2_regions(const delone_tri2 *t, int32_t *regions);
/* How many triangles of a mesh are not as wanted, because no angle there can be larger, or no vertex is allowed. */
int32_t delone_tri2_left(const delone_tri2 *t, size_t *count);
/* For each point the vertex at its place: itself, but for duplicates; DELONE_NO_VERTEX for removed points, and for those that weights hide. */
#define DELONE_NO_VERTEX 0xffffffffu
int32_t delone_tri2_vertices(const delone_tri2 *t, uint32_t *vertices);

/* The row of a triangle that each place is in, -1 outside. A place on an edge is in one of both triangles. */
int32_t delone_tri2_locate(const delone_tri2 *t, const delone_points *places, int64_t *triangles, delone_error *error);
/* The `k` nearest vertices of each place, by increasing distance; -1 where there are fewer. */
int32_t delone_tri2_nearest(const delone_tri2 *t, const delone_points *places, uint32_t k, int64_t *vertices, delone_error *error);

#define DELONE_LINEAR 0
#define DELONE_NEAREST 1
#define DELONE_LAPLACE 2
#define DELONE_SIBSON 3 /* natural neighbors */

/*
 * The value at each place, of one value a point; NaN outside of the hull, or of the mesh. Beyond the hull by 2^-48 of the largest coordinate is on it,
 * because places that are computed are rounded; beyond the border of a mesh is outside. With segments linear and nearest only, and not with
 * weights.
 */
int32_t delone_tri2_interpolate(const delone_tri2 *t, const double *values, size_t value_count, const delone_points *places, int32_t how,
                                double *out, delone_error *error);

/* Proves that it is Delaunay, constrained Delaunay or regular. */
int32_t delone_tri2_check(const delone_tri2 *t, delone_error *error);

/* Inserts points, and tells their indices: `ids` may be NULL. Meshes and triangulations with weights stay as they are: DELONE_ARGUMENT. */
int32_t delone_tri2_insert(delone_tri2 *t, const delone_points *points, uint32_t *ids, delone_error *error);
/*
 * Removes vertices: all, or none if there is one that is no vertex, is there twice, or has a segment. `index` is its row. As above. Later points at the
 * place of a removed vertex are gone with it.
 */
int32_t delone_tri2_remove(delone_tri2 *t, const uint32_t *vertices, size_t count, delone_error *error);

/* --- Voronoi cells ---------------------------------------------------------------------------------------------------------------- */

/*
 * The cells of all points in a box: x and y of the lower left corner, then of the upper right one. NULL: the box around all vertices, and a
 * tenth of its larger side more on each side.
 */
int32_t delone_tri2_voronoi(const delone_tri2 *t, const double *box, delone_cells **out, delone_error *error);
void delone_cells_free(delone_cells *cells);
/* Cells (one a point), corners in all, vertices. Each may be NULL. */
int32_t delone_cells_counts(const delone_cells *cells, size_t *cell_count, size_t *corner_count, size_t *vertex_count);
/* x and y of all vertices. */
int32_t delone_cells_vertices(const delone_cells *cells, double *xy);
/* The corners of cell i are corners[starts[i]] to corners[starts[i + 1]], vertices counter-clockwise; none for duplicates. Each may be NULL. */
int32_t delone_cells_rings(const delone_cells *cells, size_t *starts, uint32_t *corners);
int32_t delone_cells_areas(const delone_cells *cells, double *areas);

/* --- Triangulations of space ------------------------------------------------------------------------------------------------------ */

int32_t delone_tri3_new(const delone_points *points, delone_tri3 **out, delone_error *error);
void delone_tri3_free(delone_tri3 *t);
int32_t delone_tri3_counts(const delone_tri3 *t, delone_counts *counts);
/* Four indices a tetrahedron: the first three are seen counter-clockwise from the fourth. Each may be NULL. */
int32_t delone_tri3_tetrahedra(const delone_tri3 *t, uint32_t *corners, int32_t *neighbors);
/* Three indices a triangle of the hull, counter-clockwise from outside. */
int32_t delone_tri3_hull(const delone_tri3 *t, uint32_t *corners);
int32_t delone_tri3_locate(const delone_tri3 *t, const delone_points *places, int64_t *tetrahedra, delone_error *error);
int32_t delone_tri3_nearest(const delone_tri3 *t, const delone_points *places, uint32_t k, int64_t *vertices, delone_error *error);
int32_t delone_tri3_interpolate(const delone_tri3 *t, const double *values, size_t value_count, const delone_points *places, int32_t how,
                                double *out, delone_error *error);
int32_t delone_tri3_check(const delone_tri3 *t, delone_error *error);

#ifdef __cplusplus
}
#endif

#endif
