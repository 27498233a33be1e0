/* The numerical part of a substructure test: the structure in the computer. Two kinds answer to the same calls, a linear recursion
 * (recursion_part.c) and a frame (frame_part.c). Private to the core. */
#ifndef ED_NUMERICAL_H
#define ED_NUMERICAL_H

#include "edcore.h"

enum { ED_PART_TARGETS = 3, ED_PART_MOST = 3000 }; /* target displacement, velocity, acceleration; most states and outputs */

typedef struct ed_numerical ed_numerical;
struct ed_numerical {
  int n_outputs;
  /* From rest, for n main steps; ground: n + 1, and lives as long as the test. Writes the outputs at the start. May allocate. */
  int (*start)(ed_numerical *part, int n, const double *ground, double *outputs);
  /* A main step with the force of the specimen at its start; y: targets and outputs at its end. ED_LIMIT: it is the last one. */
  int (*step)(ed_numerical *part, double force, double *y);
  void (*end)(ed_numerical *part);                   /* of a test, also of one that did not start */
  const char *(*message)(const ed_numerical *part);  /* why a call failed, or NULL */
  void (*free)(ed_numerical *part);
};

/* What is wrong with the description, or NULL. */
const char *ed_wrong_recursion(const ed_substructure_input *input);
const char *ed_wrong_frame(const ed_substructure_input *input);
/* NULL: out of memory. */
ed_numerical *ed_recursion_part(const ed_substructure_input *input);
ed_numerical *ed_frame_part_new(const ed_substructure_input *input);

#endif
