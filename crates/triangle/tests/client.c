/* A client of the header, in C89 and C++. */

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "triangle.h"

#if defined(REAL) || defined(VOID)
#error "names of others are defined"
#endif

#define CHECK(claim)                                           \
  do {                                                         \
    if (!(claim)) {                                            \
      fprintf(stderr, "line %d: %s\n", __LINE__, #claim);      \
      exit(1);                                                 \
    }                                                          \
  } while (0)

static double points[] = {0, 0, 8, 0, 8, 8, 0, 8, 3, 3, 5, 3, 5, 5, 3, 5};
static int segments[] = {1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5};
static double hole[] = {4, 4};

static int is_large(const double *a, const double *b, const double *c, double area, void *user) {
  double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  *(int *)user += 1;
  return twice > 2 * 0.3 && area > 0.3;
}

#ifdef EXTERNAL_TEST
int triunsuitable(double *origin, double *destination, double *apex, double area) {
  return origin[0] + destination[0] + apex[0] < 12 && area > 0.2;
}
#endif

static void free_all(struct triangulateio *io) {
  trifree(io->pointlist);
  trifree(io->pointattributelist);
  trifree(io->pointmarkerlist);
  trifree(io->trianglelist);
  trifree(io->triangleattributelist);
  trifree(io->neighborlist);
  trifree(io->segmentlist);
  trifree(io->segmentmarkerlist);
  trifree(io->edgelist);
  trifree(io->edgemarkerlist);
  trifree(io->normlist);
  memset(io, 0, sizeof *io);
}

int main(void) {
  struct triangulateio in, out, vorout, finer;
  struct delone_tri_error error;
  char switches[] = "pq30,5a0.5evnQ";
  char again[] = "rpq30a.25Q";
  char wrong[] = "Q";
  int calls = 0, row;

  setlocale(LC_ALL, "");
  memset(&in, 0, sizeof in);
  memset(&out, 0, sizeof out);
  memset(&vorout, 0, sizeof vorout);
  memset(&finer, 0, sizeof finer);
  in.pointlist = points;
  in.numberofpoints = 8;
  in.segmentlist = segments;
  in.numberofsegments = 8;
  in.holelist = hole;
  in.numberofholes = 1;

  triangulate(switches, &in, &out, &vorout);
  CHECK(strcmp(delone_tri_last_error(), "") == 0);
  CHECK(out.numberoftriangles > 120 && out.numberofcorners == 3);
  CHECK(out.numberofpoints - out.numberofedges + out.numberoftriangles == 0);
  CHECK(vorout.numberofpoints == out.numberoftriangles && vorout.numberofedges == out.numberofedges);
  CHECK(out.holelist == hole && out.numberofholes == 1);
  for (row = 0; row < 3 * out.numberoftriangles; row++) {
    CHECK(1 <= out.trianglelist[row] && out.trianglelist[row] <= out.numberofpoints);
    CHECK(out.neighborlist[row] == -1 || (1 <= out.neighborlist[row] && out.neighborlist[row] <= out.numberoftriangles));
  }

  /* The results are refined again. */
  triangulate(again, &out, &finer, NULL);
  CHECK(finer.numberoftriangles > out.numberoftriangles);
  free_all(&finer);
  free_all(&out);
  free_all(&vorout);

  /* Errors. */
  in.numberofpoints = 2;
#ifdef DELONE_TRIANGLE_INT
  CHECK(triangulate(wrong, &in, &out, NULL) == DELONE_TRI_ARGUMENT);
#else
  triangulate(wrong, &in, &out, NULL);
#endif
  CHECK(out.numberofpoints == 0 && strlen(delone_tri_last_error()) > 10);
  in.numberofpoints = 8;
  error.size = sizeof error;
  segments[3] = 9;
  CHECK(delone_triangulate("p", &in, &out, NULL, NULL, NULL, &error) == DELONE_TRI_INDEX);
  CHECK(error.status == DELONE_TRI_INDEX && error.index == 1);
  CHECK(strcmp(error.words, delone_tri_last_error()) == 0);
  segments[3] = 3;

  /* Tests of triangles. */
  CHECK(delone_triangulate("pu", &in, &out, NULL, is_large, &calls, &error) == DELONE_TRI_GOOD);
  CHECK(error.status == 0 && calls > out.numberoftriangles && out.numberoftriangles > 200);
  free_all(&out);
#ifdef EXTERNAL_TEST
  {
    char user[] = "puQ";
    triangulate(user, &in, &out, NULL);
    CHECK(out.numberoftriangles > 150);
    free_all(&out);
  }
#endif
  return 0;
}
