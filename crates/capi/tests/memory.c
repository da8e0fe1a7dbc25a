/* With little room for memory a large set is refused with a status, and a small one is still done. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "delone.h"

int main(void) {
    enum { SMALL_SET = 1000, LARGE_SET = 20000000 };
    struct rlimit limit = {800000000, 800000000};
    double *xy = calloc(2 * (size_t)LARGE_SET, sizeof *xy);
    delone_points p = delone_xy(xy, LARGE_SET);
    delone_tri2 *t;
    delone_error e;
    size_t i;
    e.size = (uint32_t)sizeof e;
    for (i = 0; i < 2 * SMALL_SET; i++) xy[i] = rand() / (RAND_MAX + 1.0);
    if (delone_set_threads(1, &e) != 0 || setrlimit(RLIMIT_AS, &limit) != 0) return 1;
    if (delone_tri2_new(&p, &t, &e) != DELONE_MEMORY || t != NULL || strstr(e.message, "megabytes") == NULL) {
        printf("%d: %s\n", (int)e.status, e.message);
        return 1;
    }
    p.count = SMALL_SET;
    if (delone_tri2_new(&p, &t, &e) != 0) {
        printf("%d: %s\n", (int)e.status, e.message);
        return 1;
    }
    delone_tri2_free(t);
    free(xy);
    puts("all is well");
    return 0;
}
