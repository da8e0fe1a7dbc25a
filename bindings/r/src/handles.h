/* Handles of libdelone in external pointers, and its faults as conditions of R. */
#ifndef HANDLES_H
#define HANDLES_H

#include <delone.h>

#define R_NO_REMAP
#define STRICT_R_HEADERS
#include <R.h>
#include <Rinternals.h>

/* An external pointer without a handle yet, with a finaliser; protected by the caller. Handles go there as soon as they exist, so that no
 * error of R loses them. */
SEXP new_handle(int dimension);
int dimension_of(SEXP handle);
void *address_of(SEXP handle);

/* Ends with a condition of class delone_error if the status is not good. `what` are the rows that an index counts. */
void stop_if_bad(int32_t status, const delone_error *error, const char *what);

/* The columns of a matrix, where they are. */
delone_points points_of(SEXP matrix, int dimension);
/* Indices from 1 to indices from 0, by rows; those that are none become UINT32_MAX, which the library refuses. */
uint32_t *indices_of(SEXP matrix, int columns, size_t *count);
/* `count` rows of indices to a matrix that counts from 1; NA for negative ones. */
SEXP matrix_of(const uint32_t *rows, size_t count, int columns);
SEXP signed_matrix_of(const int32_t *rows, size_t count, int columns);
SEXP double_matrix_of(const double *rows, size_t count, int columns);
delone_counts counts_of(SEXP handle);

#endif
