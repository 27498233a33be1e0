/* A small steel frame, analyses of it and ground motions, for tests. */
#ifndef FRAME_H
#define FRAME_H

#include "edcore.h"

typedef struct {
  int bays, storeys, points;
  int geometry;    /* of the columns; beams are linear */
  double hardening;
} frame_options;

enum { GRAVITY = 0, LATERAL = 1 }; /* patterns: 25 kN/m on the beams; 1 kN times the floor on line A */

/* Bays of 6 m, storeys of 3.5 m, one I section, 20 t a node (25 kN/m on beams keeps columns far from buckling). */
ed_model *frame_model(frame_options options);
/* Line 0.., floor 0.. */
int frame_node(frame_options options, int line, int floor);
/* A new analysis; a failure is a failed check. */
ed_analysis *frame_analysis(const ed_model *model);
/* Runs to the end; the status of the last piece. */
int run_to_end(ed_analysis *analysis, int steps);
/* Channel with one term. */
int add_channel(ed_analysis *analysis, int kind, int object, int component);
/* A small damper of every law between the floors of the lower two storeys, those of the second with a brace. */
void add_dampers(ed_model *model, frame_options options);
/* n+1 samples of a motion of several frequencies that fades in. */
void ground_motion(int n, double dt, double peak, double *acceleration);
/* Newmark's constant average acceleration. */
extern const double AVERAGE_ACCELERATION[2];

#endif
