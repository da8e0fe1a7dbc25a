#include "handles.h"

#include <stdio.h>
#include <string.h>

static void free_handle(SEXP handle) {
    void *address = R_ExternalPtrAddr(handle);
    R_ClearExternalPtr(handle);
    if (INTEGER(R_ExternalPtrTag(handle))[0] == 3) {
        delone_tri3_free(address);
    } else {
        delone_tri2_free(address);
    }
}

SEXP new_handle(int dimension) {
    SEXP tag = PROTECT(Rf_ScalarInteger(dimension));
    SEXP handle = PROTECT(R_MakeExternalPtr(NULL, tag, R_NilValue));
    R_RegisterCFinalizerEx(handle, free_handle, TRUE);
    UNPROTECT(2);
    return handle;
}

int dimension_of(SEXP handle) {
    if (TYPEOF(handle) != EXTPTRSXP || TYPEOF(R_ExternalPtrTag(handle)) != INTSXP) Rf_error("this is no triangulation");
    return INTEGER(R_ExternalPtrTag(handle))[0];
}

void *address_of(SEXP handle) {
    dimension_of(handle);
    if (R_ExternalPtrAddr(handle) == NULL) Rf_error("this triangulation is of another session: make it anew");
    return R_ExternalPtrAddr(handle);
}

/* The message counts from 1, as R does. */
static void describe(char *message, size_t size, int32_t status, const delone_error *error, const char *what) {
    double row = (double) error->index + 1;
    if (error->index < 0 || status == DELONE_BUG) {
        snprintf(message, size, "%s", error->message[0] ? error->message : delone_status_name(status));
    } else if (status == DELONE_NOT_FINITE) {
        snprintf(message, size, "row %.0f of the %s is not finite: NA, NaN or infinite", row, what);
    } else if (status == DELONE_CROSSING) {
        snprintf(message, size, "segment %.0f crosses another one", row);
    } else if (status == DELONE_INDEX) {
        snprintf(message, size, "row %.0f of the %s has an index that is out of range", row, what);
    } else {
        snprintf(message, size, "row %.0f of the %s: %s", row, what, delone_status_name(status));
    }
}

void stop_if_bad(int32_t status, const delone_error *error, const char *what) {
    static const char *const names[] = {"message", "call", "status", "row", ""};
    char message[512];
    SEXP condition, classes, call;
    if (status == DELONE_GOOD) return;
    describe(message, sizeof message, status, error, what);
    condition = PROTECT(Rf_mkNamed(VECSXP, (const char **) names));
    SET_VECTOR_ELT(condition, 0, Rf_ScalarString(Rf_mkCharCE(message, CE_UTF8)));
    SET_VECTOR_ELT(condition, 2, Rf_mkString(delone_status_name(status)));
    SET_VECTOR_ELT(condition, 3, Rf_ScalarReal(error->index < 0 ? NA_REAL : (double) error->index + 1));
    classes = PROTECT(Rf_allocVector(STRSXP, 3));
    SET_STRING_ELT(classes, 0, Rf_mkChar("delone_error"));
    SET_STRING_ELT(classes, 1, Rf_mkChar("error"));
    SET_STRING_ELT(classes, 2, Rf_mkChar("condition"));
    Rf_setAttrib(condition, R_ClassSymbol, classes);
    call = PROTECT(Rf_lang2(Rf_install("stop"), condition));
    Rf_eval(call, R_BaseEnv);
    UNPROTECT(3);
}

delone_points points_of(SEXP matrix, int dimension) {
    size_t count;
    delone_points points;
    if (!Rf_isReal(matrix) || !Rf_isMatrix(matrix) || Rf_ncols(matrix) != dimension) {
        Rf_error("a matrix of numbers with %d columns is needed", dimension);
    }
    count = (size_t) Rf_nrows(matrix);
    memset(&points, 0, sizeof points);
    points.size = sizeof points;
    points.type = DELONE_DOUBLE;
    points.count = count;
    points.stride = sizeof(double);
    points.x = REAL(matrix);
    points.y = REAL(matrix) + count;
    points.z = dimension == 3 ? REAL(matrix) + 2 * count : NULL;
    return points;
}

uint32_t *indices_of(SEXP matrix, int columns, size_t *count) {
    size_t i, k, n = (size_t) Rf_xlength(matrix) / (size_t) columns;
    uint32_t *rows = (uint32_t *) R_alloc(n * (size_t) columns + 1, sizeof(uint32_t));
    const int *from = INTEGER(matrix);
    for (i = 0; i < n; i++) {
        for (k = 0; k < (size_t) columns; k++) {
            int index = from[k * n + i];
            rows[i * (size_t) columns + k] = index == NA_INTEGER || index < 1 ? UINT32_MAX : (uint32_t) (index - 1);
        }
    }
    *count = n;
    return rows;
}

SEXP matrix_of(const uint32_t *rows, size_t count, int columns) {
    return signed_matrix_of((const int32_t *) rows, count, columns);
}

SEXP signed_matrix_of(const int32_t *rows, size_t count, int columns) {
    SEXP matrix = PROTECT(Rf_allocMatrix(INTSXP, (int) count, columns));
    int *to = INTEGER(matrix);
    size_t i, k;
    for (i = 0; i < count; i++) {
        for (k = 0; k < (size_t) columns; k++) {
            int32_t index = rows[i * (size_t) columns + k];
            to[k * count + i] = index < 0 ? NA_INTEGER : index + 1;
        }
    }
    UNPROTECT(1);
    return matrix;
}

SEXP double_matrix_of(const double *rows, size_t count, int columns) {
    SEXP matrix = PROTECT(Rf_allocMatrix(REALSXP, (int) count, columns));
    double *to = REAL(matrix);
    size_t i, k;
    for (i = 0; i < count; i++) {
        for (k = 0; k < (size_t) columns; k++) to[k * count + i] = rows[i * (size_t) columns + k];
    }
    UNPROTECT(1);
    return matrix;
}

delone_counts counts_of(SEXP handle) {
    delone_counts counts;
    memset(&counts, 0, sizeof counts);
    counts.size = sizeof counts;
    if (dimension_of(handle) == 3) {
        delone_tri3_counts(address_of(handle), &counts);
    } else {
        delone_tri2_counts(address_of(handle), &counts);
    }
    return counts;
}
