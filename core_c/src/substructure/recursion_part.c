/* A linear structure as a recursion: z' = A z + B w, y' = C z + D w. */
#include "base/finite.h"
#include "substructure/numerical.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INPUTS = 4 };

typedef struct {
  ed_numerical part;
  int n_states, k;           /* states, and main steps done */
  const double *ground;
  double earlier;            /* force a step ago */
  double *A, *B, *C, *D;     /* one block, owned through A; column by column, so that lanes run over rows */
  double *state, *z, *z_next;
} recursion;

const char *ed_wrong_recursion(const ed_substructure_input *in)
{
  if (in->n_states > ED_PART_MOST || in->n_outputs < 0 || in->n_outputs > ED_PART_MOST)
    return "the numerical part has too many states or outputs";
  const size_t n = (size_t)in->n_states, rows = ED_PART_TARGETS + (size_t)in->n_outputs;
  if (!ed_all_finite(n * n, in->A) || !ed_all_finite(n * INPUTS, in->B) || !ed_all_finite(rows * n, in->C) || !ed_all_finite(rows * INPUTS, in->D))
    return "a value of the numerical part is not finite";
  return NULL;
}

static void by_columns(int rows, int columns, const double *from, double *to)
{
  for (int i = 0; i < rows; i++)
    for (int j = 0; j < columns; j++)
      to[(size_t)j * (size_t)rows + (size_t)i] = from[(size_t)i * (size_t)columns + (size_t)j];
}

/* y += M x, column by column. */
static void add_product(int rows, int columns, const double *restrict M, const double *restrict x, double *restrict y)
{
  for (int j = 0; j < columns; j++)
    for (int i = 0; i < rows; i++)
      y[i] += M[(size_t)j * (size_t)rows + (size_t)i] * x[j];
}

static int start(ed_numerical *part, int n, const double *ground, double *outputs)
{
  recursion *r = (recursion *)part;
  (void)n;
  r->k = 0;
  r->ground = ground;
  memset(r->state, 0, sizeof *r->state * 2 * (size_t)r->n_states);
  memset(outputs, 0, sizeof *outputs * (size_t)part->n_outputs);
  return ED_OK;
}

static int step(ed_numerical *part, double force, double *y)
{
  recursion *r = (recursion *)part;
  const int n = r->n_states, rows = ED_PART_TARGETS + part->n_outputs;
  const double w[INPUTS] = {force, r->k ? r->earlier : force, r->ground[r->k], r->ground[r->k + 1]};
  memset(y, 0, sizeof *y * (size_t)rows);
  add_product(rows, n, r->C, r->z, y);
  add_product(rows, INPUTS, r->D, w, y);
  memset(r->z_next, 0, sizeof *r->z_next * (size_t)n);
  add_product(n, n, r->A, r->z, r->z_next);
  add_product(n, INPUTS, r->B, w, r->z_next);
  double *swap = r->z;
  r->z = r->z_next;
  r->z_next = swap;
  r->earlier = force;
  r->k++;
  return ED_OK;
}

static void end(ed_numerical *part)
{
  (void)part;
}

static const char *message(const ed_numerical *part)
{
  (void)part;
  return NULL;
}

static void discard(ed_numerical *part)
{
  recursion *r = (recursion *)part;
  free(r->A);
  free(r->state);
  free(r);
}

ed_numerical *ed_recursion_part(const ed_substructure_input *in)
{
  const int n = in->n_states, rows = ED_PART_TARGETS + in->n_outputs;
  const size_t states = (size_t)n, height = (size_t)rows;
  recursion *r = calloc(1, sizeof *r);
  if (!r)
    return NULL;
  r->part = (ed_numerical){in->n_outputs, start, step, end, message, discard};
  r->n_states = n;
  r->A = malloc(sizeof *r->A * (states * states + states * INPUTS + height * states + height * INPUTS));
  r->state = malloc(sizeof *r->state * 2 * states);
  if (!r->A || !r->state) {
    discard(&r->part);
    return NULL;
  }
  r->B = r->A + states * states;
  r->C = r->B + states * INPUTS;
  r->D = r->C + height * states;
  r->z = r->state;
  r->z_next = r->z + n;
  by_columns(n, n, in->A, r->A);
  by_columns(n, INPUTS, in->B, r->B);
  by_columns(rows, n, in->C, r->C);
  by_columns(rows, INPUTS, in->D, r->D);
  return &r->part;
}
