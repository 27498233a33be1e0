/* The rig over a sub-step: from the command to the motion that reaches the specimen and its flexible parts. */
#ifndef ED_RIG_H
#define ED_RIG_H

#include "edcore.h"

/* Of what gives way between piston and specimen, m/N. */
static inline double ed_rig_give(const ed_rig_model *model)
{
  return model->stiffness > 0.0 ? 1.0 / model->stiffness : 0.0;
}

/* Of oil and rig, which stand in series with the specimen, m/N. */
static inline double ed_rig_flexibility(const ed_rig_model *model)
{
  return (model->kind == ED_RIG_SERVO_HYDRAULIC ? 1.0 / model->oil : 0.0) + ed_rig_give(model);
}

enum { ED_SATURATED_STROKE = 1, ED_SATURATED_VELOCITY = 2, ED_SATURATED_FORCE = 4, ED_SATURATED_SENSOR = 8 };

typedef struct {
  double r[ED_RIG_STATES]; /* LINEAR */
  double flow;             /* SERVO_HYDRAULIC: q */
  double left, mean;       /* SERVO_HYDRAULIC: exp(-t/valve_lag) at the end of a sub-step, and its mean over one */
  double command;          /* w at the end of the last sub-step */
  double x, v;             /* of what drives the specimen: the piston, or the piston without the give of its oil */
  double piston;           /* displacement of the piston */
} ed_rig_state;

/* At rest, for sub-steps of h. */
void ed_rig_start(const ed_rig_model *model, ed_rig_state *state, double h);
/* Moves the drive over a sub-step of h towards the command w. force: of the specimen at its start. v_start: velocity of the drive at the
 * start, from which its path goes. *saturated gains the limits that were met. */
void ed_rig_move(const ed_rig_model *model, ed_rig_state *state, double h, double w, double force, double *v_start, int *saturated);
/* The end of the stroke that the piston of a servo-hydraulic rig would pass with this force at the end of the sub-step; 0: none. */
double ed_rig_beyond(const ed_rig_model *model, const ed_rig_state *state, double force);
/* The piston stands at that end, with the force that the specimen has there: the valve gives nothing more. */
void ed_rig_stop(const ed_rig_model *model, ed_rig_state *state, double end, double force, int *saturated);
/* The piston, once the force at the end of the sub-step is known. */
void ed_rig_settle(const ed_rig_model *model, ed_rig_state *state, double force, int *saturated);

#endif
