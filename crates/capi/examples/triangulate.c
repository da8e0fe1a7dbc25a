/* The triangles of five points, in plain C: cc triangulate.c $(pkg-config --cflags --libs delone) */
#include <delone.h>
#include <stdio.h>

int main(void) {
    double xy[] = {0, 0, 4, 0, 4, 3, 0, 3, 1, 1};
    delone_points points = delone_xy(xy, 5);
    delone_error error = {sizeof error, 0, -1, ""};
    delone_tri2 *t;
    uint32_t corners[3 * 8]; /* fewer than two for each point */
    delone_counts counts = {sizeof counts, 0, 0, 0, 0, 0, 0, 0, 0};
    size_t i;
    if (delone_tri2_new(&points, &t, &error) != DELONE_GOOD) return fprintf(stderr, "%s\n", error.message), 1;
    delone_tri2_counts(t, &counts);
    delone_tri2_triangles(t, corners, NULL);
    for (i = 0; i < counts.simplices; ++i) printf("%u %u %u\n", corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]);
    delone_tri2_free(t);
    return 0;
}
