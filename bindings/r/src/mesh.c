/* Meshes: wishes from a list of R, and callbacks into R. */
#include "handles.h"

#include <string.h>

typedef struct {
    SEXP area;      /* a function of x and y, or NULL of R */
    int is_stopped;
} watch;

static SEXP element(SEXP list, const char *name) {
    SEXP names = Rf_getAttrib(list, R_NamesSymbol);
    R_xlen_t i;
    for (i = 0; i < Rf_xlength(list); i++) {
        if (strcmp(CHAR(STRING_ELT(names, i)), name) == 0) return VECTOR_ELT(list, i);
    }
    return R_NilValue;
}

static double number(SEXP list, const char *name) {
    SEXP value = element(list, name);
    return Rf_isNull(value) ? 0 : Rf_asReal(value);
}

/* Errors of R would jump over frames of the library: they are kept until it has returned. */
static double area_at(void *user, double x, double y) {
    watch *w = user;
    int failed = 0;
    double area = R_PosInf;
    SEXP px, py, call, value;
    if (w->is_stopped) return area;
    px = PROTECT(Rf_ScalarReal(x));
    py = PROTECT(Rf_ScalarReal(y));
    call = PROTECT(Rf_lang3(w->area, px, py));
    value = R_tryEvalSilent(call, R_GlobalEnv, &failed);
    if (failed || !Rf_isNumeric(value) || Rf_xlength(value) != 1) {
        w->is_stopped = failed ? 1 : 2;
    } else {
        area = Rf_asReal(value);
    }
    UNPROTECT(3);
    return area;
}

static void ask_for_interrupts(void *unused) {
    (void) unused;
    R_CheckUserInterrupt();
}

static int32_t progress(void *user, uint64_t new_vertices) {
    watch *w = user;
    (void) new_vertices;
    if (!w->is_stopped && !R_ToplevelExec(ask_for_interrupts, NULL)) w->is_stopped = 3;
    return w->is_stopped;
}

/* p: points. segments: a matrix of two columns of indices. wishes: a list by names of delone_mesh_options. */
SEXP r_mesh(SEXP p, SEXP segments, SEXP wishes) {
    delone_points points = points_of(p, 2);
    delone_mesh_options options;
    delone_error error = {sizeof(delone_error), 0, -1, {0}};
    delone_tri2 *t = NULL;
    size_t i, count;
    uint32_t *ends = indices_of(segments, 2, &count);
    SEXP holes = element(wishes, "holes"), handle;
    double *seeds;
    watch w;
    int32_t status;
    memset(&w, 0, sizeof w);
    w.area = element(wishes, "area_at");
    memset(&options, 0, sizeof options);
    options.size = sizeof options;
    options.flags = number(wishes, "split") != 0 ? DELONE_SPLIT_CROSSINGS : 0;
    options.fill = (int32_t) number(wishes, "fill");
    options.keep = (int32_t) number(wishes, "keep");
    options.min_angle = number(wishes, "min_angle");
    options.max_area = number(wishes, "max_area");
    options.max_vertices = (size_t) number(wishes, "max_vertices");
    if (!Rf_isNull(holes)) {
        size_t n = (size_t) Rf_nrows(holes);
        seeds = (double *) R_alloc(2 * n + 1, sizeof(double));
        for (i = 0; i < n; i++) {
            seeds[2 * i] = REAL(holes)[i];
            seeds[2 * i + 1] = REAL(holes)[n + i];
        }
        options.holes = seeds;
        options.hole_count = n;
    }
    options.user = &w;
    options.area_at = Rf_isNull(w.area) ? NULL : area_at;
    options.progress = progress;
    handle = PROTECT(new_handle(2));
    status = delone_mesh2_new(&points, ends, count, &options, &t, &error);
    R_SetExternalPtrAddr(handle, t);
    if (w.is_stopped == 1) Rf_error("the function of areas: %s", R_curErrorBuf());
    if (w.is_stopped == 2) Rf_error("the function of areas gave no number");
    if (w.is_stopped == 3) Rf_error("interrupted");
    stop_if_bad(status, &error, status == DELONE_INDEX ? "segments" : "points");
    UNPROTECT(1);
    return handle;
}
