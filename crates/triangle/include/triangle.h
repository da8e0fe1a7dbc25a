/* The C interface of Triangle, as Delone offers it. MIT OR Apache-2.0.

   Link with -ldelone_triangle. See README.md for the switches, and for how results differ from Triangle's.
   C89 and C++. Nothing but the names below is defined: neither REAL nor VOID. */

#ifndef DELONE_TRIANGLE_H
#define DELONE_TRIANGLE_H

#ifdef __cplusplus
extern "C" {
#endif

/* Input and results. A list of results that is NULL gets new memory of malloc, to be given back by trifree or free; one that is not NULL
   is written into, and must have room. Lists that the switches do not use are neither read nor written. */
struct triangulateio {
  double *pointlist;           /* x, y of each point */
  double *pointattributelist;  /* numberofpointattributes values of each point */
  int *pointmarkerlist;        /* may be NULL in the input */
  int numberofpoints;
  int numberofpointattributes;

  int *trianglelist;             /* numberofcorners points of each triangle, counter-clockwise, then nodes of second order */
  double *triangleattributelist; /* numberoftriangleattributes values of each triangle */
  double *trianglearealist;      /* input alone, for switches r and a: largest areas; none where it is not positive */
  int *neighborlist;             /* results alone: the triangle opposite to each corner, or -1 */
  int numberoftriangles;
  int numberofcorners;
  int numberoftriangleattributes;

  int *segmentlist;
  int *segmentmarkerlist; /* may be NULL in the input */
  int numberofsegments;

  double *holelist; /* x, y of each hole; results have the pointer of the input */
  int numberofholes;

  double *regionlist; /* x, y, attribute, largest area of each region; results have the pointer of the input */
  int numberofregions;

  int *edgelist;       /* results alone */
  int *edgemarkerlist; /* results alone */
  double *normlist;    /* results alone: directions of the rays of a Voronoi diagram */
  int numberofedges;
};

/* Statuses. */
#define DELONE_TRI_GOOD 0
#define DELONE_TRI_ARGUMENT 1
#define DELONE_TRI_NOT_FINITE 2
#define DELONE_TRI_INDEX 4
#define DELONE_TRI_TOO_MANY 5
#define DELONE_TRI_MEMORY 6
#define DELONE_TRI_BUG 9

/* An error, told to the caller. Set size to sizeof(struct delone_tri_error) first. */
struct delone_tri_error {
  unsigned int size;
  int status;
  int index;       /* of the first row of the input that is wrong, counted from 0; or -1 */
  char words[244]; /* UTF-8, ended by a zero */
};

/* Whether a triangle is to be refined: corners counter-clockwise, area, and what the caller gave along. It is called on the thread of
   the caller, and must return: neither throw nor jump. */
typedef int (*delone_tri_test)(const double *, const double *, const double *, double, void *);

/* Triangulates, with a status. The test is for switch u alone, and may be NULL, like vorout without switch v, and the error. Nothing is
   printed. At an error all counts of the results are 0. */
int delone_triangulate(const char *switches, const struct triangulateio *in, struct triangulateio *out,
                       struct triangulateio *vorout, delone_tri_test test, void *user, struct delone_tri_error *error);

/* The words of the last error on this thread, or "". They last until the next call. */
const char *delone_tri_last_error(void);

/* As triangulate, with a test in the form that Triangle has for switch u. */
int delone_tri_with_test(const char *switches, const struct triangulateio *in, struct triangulateio *out,
                         struct triangulateio *vorout, int (*test)(double *, double *, double *, double));

/* As Triangle's, but it returns at errors: all counts of the results are 0 then, and stderr has a line. The function returns a status;
   programs that want it define DELONE_TRIANGLE_INT first. */
#ifdef DELONE_TRIANGLE_INT
int triangulate(char *switches, struct triangulateio *in, struct triangulateio *out, struct triangulateio *vorout);
#else
void triangulate(char *switches, struct triangulateio *in, struct triangulateio *out, struct triangulateio *vorout);
#endif

/* Gives memory of results back. */
void trifree(void *memory);

/* With EXTERNAL_TEST, the program defines the test of switch u under this name. It is handed over in each call, so that a plugin
   has its own. */
#ifdef EXTERNAL_TEST
int triunsuitable(double *origin, double *destination, double *apex, double area);
#ifdef DELONE_TRIANGLE_INT
#define triangulate(switches, in, out, vorout) delone_tri_with_test((switches), (in), (out), (vorout), triunsuitable)
#else
#define triangulate(switches, in, out, vorout) ((void)delone_tri_with_test((switches), (in), (out), (vorout), triunsuitable))
#endif
#endif

#ifdef __cplusplus
}
#endif

#endif
