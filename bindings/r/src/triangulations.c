/* Triangulations of the plane and of space: made, read, asked, changed. */
#include "handles.h"

#include <string.h>

#include <R_ext/Rdynload.h>
#include <R_ext/Visibility.h>

static const delone_error NO_ERROR = {sizeof(delone_error), 0, -1, {0}};

/* p: a matrix of two or three columns. segments: NULL, or a matrix of two columns. weights: NULL, or one a point. */
static SEXP r_new(SEXP p, SEXP segments, SEXP weights, SEXP split) {
    int dimension = Rf_ncols(p);
    delone_points points = points_of(p, dimension == 3 ? 3 : 2);
    delone_error error = NO_ERROR;
    SEXP handle = PROTECT(new_handle(dimension));
    const char *what = "points";
    int32_t status;
    if (dimension == 3) {
        delone_tri3 *t = NULL;
        status = delone_tri3_new(&points, &t, &error);
        R_SetExternalPtrAddr(handle, t);
    } else {
        delone_tri2 *t = NULL;
        if (!Rf_isNull(segments)) {
            size_t count;
            uint32_t *ends = indices_of(segments, 2, &count);
            status = delone_constrained2_new(&points, ends, count, Rf_asLogical(split) == TRUE ? DELONE_SPLIT_CROSSINGS : 0, &t, &error);
            if (status == DELONE_INDEX) what = "segments";
        } else if (!Rf_isNull(weights)) {
            status = delone_regular2_new(&points, REAL(weights), &t, &error);
        } else {
            status = delone_tri2_new(&points, &t, &error);
        }
        R_SetExternalPtrAddr(handle, t);
    }
    stop_if_bad(status, &error, what);
    UNPROTECT(1);
    return handle;
}

static SEXP r_counts(SEXP handle) {
    static const char *names[] = {"dimension", "points", "vertices", "simplices", "edges", "hull", "constraints", "duplicates", ""};
    delone_counts c = counts_of(handle);
    const double values[] = {c.dimension, (double) c.points, (double) c.vertices,    (double) c.simplices,
                             (double) c.edges, (double) c.hull, (double) c.constraints, (double) c.duplicates};
    SEXP result = PROTECT(Rf_mkNamed(REALSXP, names));
    memcpy(REAL(result), values, sizeof values);
    UNPROTECT(1);
    return result;
}

/* Both kinds of rows that a simplex has: corners, or neighbors. */
static SEXP rows_of(SEXP handle, int is_neighbors) {
    int columns = dimension_of(handle) + 1;
    size_t count = counts_of(handle).simplices;
    uint32_t *rows = (uint32_t *) R_alloc(count * (size_t) columns + 1, sizeof(uint32_t));
    uint32_t *corners = is_neighbors ? NULL : rows;
    int32_t *neighbors = is_neighbors ? (int32_t *) rows : NULL, status;
    delone_error error = NO_ERROR;
    if (columns == 4) {
        status = delone_tri3_tetrahedra(address_of(handle), corners, neighbors);
    } else {
        status = delone_tri2_triangles(address_of(handle), corners, neighbors);
    }
    stop_if_bad(status, &error, "simplices");
    return signed_matrix_of((int32_t *) rows, count, columns);
}

static SEXP r_simplices(SEXP handle) { return rows_of(handle, 0); }

static SEXP r_neighbors(SEXP handle) { return rows_of(handle, 1); }

static delone_tri2 *plane(SEXP handle) {
    if (dimension_of(handle) != 2) Rf_error("this is for triangulations of the plane");
    return address_of(handle);
}

static SEXP r_points(SEXP handle) {
    size_t count = 0;
    const double *xy = delone_tri2_points(plane(handle), &count);
    return double_matrix_of(xy, count, 2);
}

static SEXP r_edges(SEXP handle) {
    delone_tri2 *t = plane(handle);
    size_t i, count = counts_of(handle).edges;
    uint32_t *ends = (uint32_t *) R_alloc(2 * count + 1, sizeof(uint32_t));
    uint8_t *is_constraint = (uint8_t *) R_alloc(count + 1, 1);
    delone_error error = NO_ERROR;
    SEXP result, flags;
    stop_if_bad(delone_tri2_edges(t, ends, is_constraint), &error, "edges");
    result = PROTECT(Rf_allocVector(VECSXP, 2));
    SET_VECTOR_ELT(result, 0, matrix_of(ends, count, 2));
    flags = Rf_allocVector(LGLSXP, (R_xlen_t) count);
    SET_VECTOR_ELT(result, 1, flags);
    for (i = 0; i < count; i++) LOGICAL(flags)[i] = is_constraint[i];
    UNPROTECT(1);
    return result;
}

static SEXP r_hull(SEXP handle) {
    int dimension = dimension_of(handle);
    size_t count = counts_of(handle).hull;
    uint32_t *corners = (uint32_t *) R_alloc(3 * count + 1, sizeof(uint32_t));
    delone_error error = NO_ERROR;
    int32_t status =
        dimension == 3 ? delone_tri3_hull(address_of(handle), corners) : delone_tri2_hull(address_of(handle), corners);
    stop_if_bad(status, &error, "hull");
    return matrix_of(corners, count, dimension);
}

/* Rows of 64 bits to a matrix that counts from 1. */
static SEXP long_matrix_of(const int64_t *rows, size_t count, int columns) {
    int32_t *narrow = (int32_t *) R_alloc(count * (size_t) columns + 1, sizeof(int32_t));
    size_t i;
    for (i = 0; i < count * (size_t) columns; i++) narrow[i] = (int32_t) rows[i];
    return signed_matrix_of(narrow, count, columns);
}

static SEXP r_locate(SEXP handle, SEXP p) {
    int dimension = dimension_of(handle);
    delone_points places = points_of(p, dimension);
    int64_t *rows = (int64_t *) R_alloc(places.count + 1, sizeof(int64_t));
    delone_error error = NO_ERROR;
    int32_t status = dimension == 3 ? delone_tri3_locate(address_of(handle), &places, rows, &error)
                                    : delone_tri2_locate(address_of(handle), &places, rows, &error);
    stop_if_bad(status, &error, "places");
    return long_matrix_of(rows, places.count, 1);
}

static SEXP r_nearest(SEXP handle, SEXP p, SEXP k) {
    int dimension = dimension_of(handle), each = Rf_asInteger(k);
    delone_points places = points_of(p, dimension);
    int64_t *rows;
    delone_error error = NO_ERROR;
    int32_t status;
    if (each == NA_INTEGER || each < 1) Rf_error("k: at least 1");
    rows = (int64_t *) R_alloc(places.count * (size_t) each + 1, sizeof(int64_t));
    status = dimension == 3 ? delone_tri3_nearest(address_of(handle), &places, (uint32_t) each, rows, &error)
                            : delone_tri2_nearest(address_of(handle), &places, (uint32_t) each, rows, &error);
    stop_if_bad(status, &error, "places");
    return long_matrix_of(rows, places.count, each);
}

static SEXP r_interpolate(SEXP handle, SEXP values, SEXP p, SEXP how) {
    int dimension = dimension_of(handle);
    size_t count = (size_t) Rf_xlength(values);
    delone_points places = points_of(p, dimension);
    delone_error error = NO_ERROR;
    SEXP out = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t) places.count));
    int32_t method = Rf_asInteger(how);
    int32_t status =
        dimension == 3 ? delone_tri3_interpolate(address_of(handle), REAL(values), count, &places, method, REAL(out), &error)
                       : delone_tri2_interpolate(address_of(handle), REAL(values), count, &places, method, REAL(out), &error);
    stop_if_bad(status, &error, "places");
    UNPROTECT(1);
    return out;
}

static SEXP r_check(SEXP handle) {
    delone_error error = NO_ERROR;
    int32_t status = dimension_of(handle) == 3 ? delone_tri3_check(address_of(handle), &error)
                                               : delone_tri2_check(address_of(handle), &error);
    stop_if_bad(status, &error, "points");
    return R_NilValue;
}

static SEXP r_insert(SEXP handle, SEXP p) {
    delone_tri2 *t = plane(handle);
    delone_points points = points_of(p, 2);
    uint32_t *ids = (uint32_t *) R_alloc(points.count + 1, sizeof(uint32_t));
    delone_error error = NO_ERROR;
    stop_if_bad(delone_tri2_insert(t, &points, ids, &error), &error, "points");
    return matrix_of(ids, points.count, 1);
}

static SEXP r_remove(SEXP handle, SEXP vertices) {
    size_t count;
    uint32_t *rows = indices_of(vertices, 1, &count);
    delone_error error = NO_ERROR;
    stop_if_bad(delone_tri2_remove(plane(handle), rows, count, &error), &error, "vertices");
    return R_NilValue;
}

/* A list: starts, corners, vertices, areas. The cells are copied before anything of R can fail. */
static SEXP r_voronoi(SEXP handle, SEXP box) {
    delone_tri2 *t = plane(handle);
    delone_cells *cells = NULL;
    delone_error error = NO_ERROR;
    size_t i, cell_count = 0, corner_count = 0, vertex_count = 0, *starts;
    size_t count = 0;
    uint32_t *corners;
    double *xy, *areas;
    SEXP result, ranges;
    int32_t status;
    delone_tri2_points(t, &count);
    starts = (size_t *) R_alloc(count + 1, sizeof(size_t));
    areas = (double *) R_alloc(count + 1, sizeof(double));
    status = delone_tri2_voronoi(t, Rf_isNull(box) ? NULL : REAL(box), &cells, &error);
    stop_if_bad(status, &error, "points");
    delone_cells_counts(cells, &cell_count, &corner_count, &vertex_count);
    corners = R_Calloc(corner_count + 1, uint32_t);
    xy = R_Calloc(2 * vertex_count + 1, double);
    status = cell_count == count ? delone_cells_rings(cells, starts, corners) : DELONE_BUG;
    if (status == DELONE_GOOD) status = delone_cells_vertices(cells, xy);
    if (status == DELONE_GOOD) status = delone_cells_areas(cells, areas);
    delone_cells_free(cells);
    result = PROTECT(Rf_allocVector(VECSXP, 4));
    ranges = Rf_allocVector(REALSXP, (R_xlen_t) count + 1);
    SET_VECTOR_ELT(result, 0, ranges);
    for (i = 0; i <= count && status == DELONE_GOOD; i++) REAL(ranges)[i] = (double) starts[i];
    SET_VECTOR_ELT(result, 1, matrix_of(corners, corner_count, 1));
    SET_VECTOR_ELT(result, 2, double_matrix_of(xy, vertex_count, 2));
    SET_VECTOR_ELT(result, 3, Rf_allocVector(REALSXP, (R_xlen_t) count));
    if (count > 0) memcpy(REAL(VECTOR_ELT(result, 3)), areas, count * sizeof(double));
    R_Free(corners);
    R_Free(xy);
    stop_if_bad(status, &error, "cells");
    UNPROTECT(1);
    return result;
}

SEXP r_mesh(SEXP p, SEXP segments, SEXP wishes);

#define ENTRY(name, count) {#name, (DL_FUNC) &name, count}

static const R_CallMethodDef ENTRIES[] = {
    ENTRY(r_new, 4),     ENTRY(r_mesh, 3),    ENTRY(r_counts, 1),      ENTRY(r_simplices, 1), ENTRY(r_neighbors, 1),
    ENTRY(r_points, 1),  ENTRY(r_edges, 1),   ENTRY(r_hull, 1),        ENTRY(r_locate, 2),    ENTRY(r_nearest, 3),
    ENTRY(r_insert, 2),  ENTRY(r_remove, 2),  ENTRY(r_interpolate, 4), ENTRY(r_check, 1),     ENTRY(r_voronoi, 2),
    {NULL, NULL, 0}};

attribute_visible void R_init_delone(DllInfo *info) {
    R_registerRoutines(info, NULL, ENTRIES, NULL, NULL);
    R_useDynamicSymbols(info, FALSE);
    if (delone_abi_version() >> 16 != DELONE_ABI_VERSION >> 16) Rf_error("libdelone is of another version than this package");
}
