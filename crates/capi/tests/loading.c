/* loading LIBRARY COPY: a library is loaded and left a thousand times, and two copies are in one process. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#include "delone.h"

enum { COUNT = 100000, LOADS = 1000 };

static double xy[2 * COUNT];

static int build(void *library, size_t count) {
    int32_t (*make)(const delone_points *, delone_tri2 **, delone_error *);
    void (*drop)(delone_tri2 *);
    delone_points p = {sizeof p, DELONE_DOUBLE, count, 16, xy, xy + 1, NULL};
    delone_tri2 *t;
    *(void **)&make = dlsym(library, "delone_tri2_new");
    *(void **)&drop = dlsym(library, "delone_tri2_free");
    if (make == NULL || drop == NULL || make(&p, &t, NULL) != 0) return 1;
    drop(t);
    return 0;
}

int main(int count, char **names) {
    void *one, *other;
    int i;
    if (count != 3) return 2;
    for (i = 0; i < 2 * COUNT; i++) xy[i] = rand() / (RAND_MAX + 1.0);
    for (i = 0; i < LOADS; i++) {
        one = dlopen(names[1], RTLD_NOW | RTLD_LOCAL);
        if (one == NULL) return puts(dlerror()), 1;
        if (build(one, i % 100 == 0 ? COUNT : 100) || dlclose(one)) return puts("loaded again"), 1;
    }
    one = dlopen(names[1], RTLD_NOW | RTLD_LOCAL);
    other = dlopen(names[2], RTLD_NOW | RTLD_LOCAL);
    if (one == NULL || other == NULL || build(one, COUNT) || build(other, COUNT)) return puts("two copies"), 1;
    puts("all is well");
    return 0;
}
