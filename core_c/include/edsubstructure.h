/* Virtual real-time substructure tests. */
#ifndef EDSUBSTRUCTURE_H
#define EDSUBSTRUCTURE_H

#include "edanalysis.h"
#include "edcompensator.h"
#include "eddamper.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A virtual test: numerical part, compensator, rig, specimen and sensors in a loop. A main step begins with what is measured then; the
 * numerical part gives the target at its end, the compensator the command, which rises in a ramp over the step; the rig follows in
 * sub-steps and moves the specimen. Everything begins at rest. One thread at a time may use an object. */
typedef struct ed_substructure ed_substructure;

enum { ED_RIG_LINEAR = 0, ED_RIG_SERVO_HYDRAULIC = 1 };
#define ED_RIG_STATES 12
/* Whoever moves the specimen. w: command, `delay` seconds late. */
typedef struct {
  int kind;              /* ED_RIG_... */
  double delay;          /* s, >= 0 */
  /* LINEAR: r_1 = A r_0 + b0 w_0 + b1 w_1 over a sub-step (w linear), position = c r + d w, velocity = c_v r + d_v w. Without states
   * the position is d w, and the velocity its slope. */
  int n;
  double A[ED_RIG_STATES * ED_RIG_STATES], b0[ED_RIG_STATES], b1[ED_RIG_STATES], c[ED_RIG_STATES], c_v[ED_RIG_STATES], d, d_v; /* A row by row */
  /* SERVO_HYDRAULIC: valve_lag q' + q = gain (w - x), q: velocity of the piston without load, |q| <= velocity sqrt(1 -+ F / force);
   * x = integral of q less F / oil. */
  double gain;           /* 1/s */
  double valve_lag;      /* s */
  double oil;            /* stiffness of its column, N/m */
  double stiffness;      /* of what stands between actuator and specimen, N/m; 0: rigid */
  int corrected;         /* the difference of both displacements is added to the command */
  /* limits, infinite: none; a motion beyond the first two is cut off there */
  double stroke;         /* m, either way */
  double velocity;       /* m/s */
  double force;          /* N */
} ed_rig_model;

/* Readings: normal noise, then rounding to whole steps of quantisation (0: none) within a range (infinite: none). */
typedef struct {
  double displacement_noise, displacement_quantisation, displacement_range; /* m: standard deviation, step of quantisation, largest magnitude */
  double force_noise, force_quantisation, force_range;                      /* N: the same */
  double force_delay;    /* s */
} ed_sensors;

/* A frame as the numerical part, in the state in which tests begin: loaded, its dampers installed. It is integrated as by
 * ed_history_begin, with so many steps in a main step. The specimen's force at the end of a main step is not known then; it is
 * extrapolated from the last two, or held. So however the frame is integrated, the loop is stable only for steps that are short against
 * the period of the interface's mass on the specimen. The analysis must outlive the test, and only one of both runs at a time. */
typedef struct {
  ed_analysis *analysis;
  int divisions;         /* steps of the frame in a main step, 1 to 1000 */
  int method;            /* ED_NEWMARK or ED_GENERALISED_ALPHA */
  double parameters[4];  /* of the method, as of ed_history_begin */
  int n_terms;           /* the specimen's deformation is the sum of coefficient * degree of node, and counts from that state */
  const int *node, *degree;
  const double *coefficient;
  int held;              /* 1: the force is held over a main step, 0: extrapolated */
} ed_frame_part;         /* records its channels: buffers that ed_run_buffers was given before a test are those of the test */

typedef struct {
  double step;           /* main step, s */
  int sub_steps;         /* of the rig in a main step */
  /* Numerical part: z' = A z + B w, y' = C z + D w with w = (F_k, F_(k-1), a_g,k, a_g,k+1); y': target displacement, velocity and
   * acceleration at the end of the step, then n_outputs more to be recorded. n_states = 0: the target is given. Row by row. */
  int n_states, n_outputs;
  const double *A, *B, *C, *D;
  const ed_frame_part *frame; /* or a frame in their place, without outputs; else NULL */
  const ed_compensator_parameters *compensator; /* with the same main step */
  int unseen_delay;      /* main steps that pass between the target and the compensator */
  const ed_rig_model *rig;
  const ed_sensors *sensors;
  /* F = force_scale * law(deformation_scale * u), both > 0. It has no brace, and must outlive the test. */
  ed_damper *specimen;
  double force_scale, deformation_scale;
  double abort_displacement; /* of the target or the specimen, m; infinite: none */
} ed_substructure_input;

/* Channels of the record. LIMITED: bits of the compensator. SATURATED: 1 stroke, 2 velocity, 4 force, 8 range of a sensor. */
enum {
  ED_RTS_TARGET = 0, ED_RTS_TARGET_VELOCITY = 1, ED_RTS_TARGET_ACCELERATION = 2,
  ED_RTS_COMMAND = 3,        /* of the compensator */
  ED_RTS_MEASURED = 4,       /* displacement of the specimen, as read */
  ED_RTS_ACTUATOR = 5,       /* displacement of the piston */
  ED_RTS_DEFORMATION = 6,    /* of the specimen, true */
  ED_RTS_FORCE = 7,          /* as read */
  ED_RTS_TRUE_FORCE = 8,
  ED_RTS_ALPHA = 9,          /* three, of ATS; of a live delay the first is the delay, s */
  ED_RTS_INDEPENDENCE = 12, ED_RTS_LIMITED = 13, ED_RTS_SATURATED = 14,
  ED_RTS_APPLIED_FORCE = 15, /* on the numerical part in the next step: as read, and what the compensator adds */
  ED_RTS_CHANNELS = 16       /* then n_outputs */
};

/* Keeps a copy of what the input says, but not of analysis and specimen. NULL: *status (ED_E_ARGUMENT, ED_E_MEMORY) and `message` (size
 * bytes) say why. */
ed_substructure *ed_substructure_new(const ed_substructure_input *input, int *status, char *message, int size);
void ed_substructure_free(ed_substructure *test);
void ed_substructure_ask(ed_substructure *test, const ed_stop *stop);
/* n main steps from rest. drive: n + 1 ground accelerations, or (n + 1) x 3 targets. record: (n + 1) x (ED_RTS_CHANNELS + n_outputs),
 * row by row. seed: of the noise. *done: rows that hold. ED_LIMIT: the abort displacement or the limit of a channel of the frame was
 * exceeded, in the last of them. */
int ed_substructure_run(ed_substructure *test, int n, const double *drive, unsigned long long seed, double *record, int *done);
/* The numerical part alone from rest, under a force of the specimen that is known: n + 1 ground accelerations, forces and target
 * displacements. *done: targets that hold. */
int ed_substructure_by_force(ed_substructure *test, int n, const double *ground, const double *force, double *target, int *done);
const char *ed_substructure_message(const ed_substructure *test); /* of the last run that failed: what did, for people */
/* A compensator on its own: commands of n steps. target: n x 3. */
int ed_compensator_run(const ed_compensator_parameters *parameters, int n, const double *target, const double *measured, double *command);

#ifdef __cplusplus
}
#endif

#endif
