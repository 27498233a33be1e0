/* Dampers in the frame; arrays per device of the model. */
#ifndef ED_DEVICES_H
#define ED_DEVICES_H

#include "damper/ode_system.h"
#include "system/model.h"
#include "system/numbering.h"
#include "system/state.h"

typedef struct {
  int *block;                    /* per device: offset of its block in the state */
  ed_ode_system *ode_system;
  int n_by_ode, *by_ode;         /* which */
  int bearings;                  /* some act in two directions */
  ed_path *path, (*path_direction)[2]; /* of those by ODE */
  ed_path direction[2];
  ed_damper_force *out;          /* of those by ODE */
  const double **old;            /* of those by ODE */
  double **new;
  double (*chord)[2];            /* what comes to dF/du and dF/dv where an iteration oscillates */
  int *oscillates;               /* its velocity fell or turned in the last iteration */
  double *reach;                 /* largest share of its force in the unbalance of a degree; moments are divided by the mean length */
  int oscillating;               /* this attempt does not settle with tangents alone */
  double duration;               /* of the present attempt */
  double velocity_factor;        /* dv/du of the present attempt */
  double tolerance;              /* of SUNDIALS */
  int failed;                    /* -1: one of those by ODE, which are solved together */
  int status;                    /* why */
} ed_devices;

/* Offsets in a device's block of the state; the law's state follows. */
enum {
  ED_DEVICE_INSTALLED,         /* 1: it acts */
  ED_DEVICE_OFFSET,            /* what its degrees say when its deformation is 0 */
  ED_DEVICE_DEFORMATION,
  ED_DEVICE_VELOCITY,
  ED_DEVICE_FORCE,
  ED_DEVICE_FORCE_PACE,        /* change of the force over the step, per time */
  ED_DEVICE_FORCE_PACE_BEFORE, /* and over the one before */
  ED_DEVICE_SLOPE,             /* dF/du, dF/dv */
  ED_DEVICE_CROSS = ED_DEVICE_SLOPE + 2, /* of a bearing, to the motion across */
  ED_DEVICE_WORK = ED_DEVICE_CROSS + 2,
  ED_DEVICE_LAW_STATE
};

static inline double *ed_device_block(const ed_devices *devices, const ed_state *state, int device)
{
  return state->devices + devices->block[device];
}

int ed_device_block_size(const ed_device *device);
int ed_devices_allocate(ed_analysis *a);
void ed_devices_free(ed_devices *devices);
int ed_update_devices(ed_analysis *a, int rough); /* trial u, v -> states and forces; rough: as in ed_damper_try */
/* Sum of coefficient * vector over the equations of a device. */
double ed_along_device(const ed_numbering *numbering, const ed_device *device, const double *vector);
/* The same of a state, with what supported degrees have of it. */
double ed_state_along_device(const ed_numbering *numbering, const ed_device *device, const double *vector, const double *of_supports);
void ed_add_along_device(const ed_numbering *numbering, const ed_device *device, double factor, double *vector);
double ed_device_force(const ed_devices *devices, const ed_state *state, int device);
double ed_largest_device_force(const ed_analysis *a); /* as unbalance counts it, at the trial state */
/* From the committed state, on as in the last step. */
double ed_expected_device_force(const ed_devices *devices, const ed_state *committed, int device);
/* dF/du + (dv/du of the attempt) dF/dv at the trial state. */
double ed_device_slope(const ed_devices *devices, const ed_state *trial, int device);
/* The same to what its bearing does across; 0 where it is none. */
double ed_device_cross_slope(const ed_devices *devices, const ed_state *trial, int i);
void ed_name_damper(const ed_model *model, const ed_devices *devices, char *buffer, int size); /* that failed, and why */
void ed_add_device_forces(ed_analysis *a);        /* into the resisting forces over all degrees */
void ed_add_device_tangent(const ed_analysis *a, double k, double *matrix);
int ed_installed(const ed_analysis *a);           /* whether some damper acts */
/* device_starts.c */
int ed_first_slopes(ed_analysis *a);              /* of the dampers that act, in a slow step from the committed state */
int ed_start_devices(ed_analysis *a);             /* forces that the velocities at the beginning of a history bring at once */
double ed_count_device_work(ed_analysis *a);
double ed_device_value(const ed_analysis *a, int kind, int device, int component);
void ed_slowly(ed_devices *devices);              /* static steps last so long that dampers relax */

#endif
