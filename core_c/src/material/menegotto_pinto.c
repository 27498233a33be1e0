#include "material/menegotto_pinto.h"

#include "base/clones.h"
#include "base/lanes.h"

#include <math.h>
#include <string.h>

enum { DEPTH = ED_LANE_WIDTH }; /* reversals inside reversals that are remembered: a fibre's fill one vector */

/* What a fibre keeps beside the branches that it left; most trials read the first six. */
enum {
  STRAIN,                                    /* committed */
  FROM_STRAIN, FROM_STRESS, SPAN, EXPONENT, /* the branch followed, see below; the sign of its span is the direction of loading */
  SAFE,                                      /* strain, in the direction, up to which no remembered branch can govern */
  STRESS,                                    /* committed */
  AHEAD, BEHIND,                             /* how many branches are remembered for the direction, and for the other one */
  LARGEST, LEAST,                            /* strains so far, the yield strains at least */
  FIELDS
};
/* The branches left while loading upwards, or downwards, from the widest to the innermost. A branch is where it begins, the strain from
 * there to where the elastic line meets the asymptote, and the exponent R. */
typedef struct {
  double strain[DEPTH], stress[DEPTH], span[DEPTH], exponent[DEPTH];
} branches;

/* Fibres come in groups of ED_LANE_WIDTH: a group's fields lie side by side, those of all groups before all their branches. */
enum { GROUP = FIELDS * ED_LANE_WIDTH, STACK = sizeof(branches) / sizeof(double) };
#define AT(field) ((field) * ED_LANE_WIDTH)

_Static_assert(FIELDS + 2 * STACK == ED_MENEGOTTO_PINTO_STATE, "state fits");

static const double FAR = 1e300; /* strain, where nothing is remembered */

void ed_menegotto_pinto_place(ed_menegotto_pinto *law, int n, double *block)
{
  double **arrays[ED_MENEGOTTO_PINTO_ARRAYS] = {&law->E, &law->b, &law->yield_strain, &law->R0, &law->cR1, &law->cR2};
  law->n = n;
  for (int k = 0; k < ED_MENEGOTTO_PINTO_ARRAYS; k++)
    *arrays[k] = block + (size_t)k * (size_t)n;
}

void ed_menegotto_pinto_set(ed_menegotto_pinto *law, int fibre, const ed_steel *steel)
{
  law->E[fibre] = steel->E;
  law->b[fibre] = steel->hardening;
  law->yield_strain[fibre] = steel->fy / steel->E;
  law->R0[fibre] = steel->R0;
  law->cR1[fibre] = steel->cR1;
  law->cR2[fibre] = steel->cR2;
}

/* Where a fibre's fields begin: field f is at AT(f) from there. */
static size_t fields_at(int fibre)
{
  return (size_t)(fibre / ED_LANE_WIDTH) * GROUP + (size_t)(fibre % ED_LANE_WIDTH);
}

static size_t branches_at(int n, int fibre, double direction)
{
  return (size_t)n * FIELDS + (size_t)fibre * 2 * STACK + (direction > 0.0 ? 0 : STACK);
}

void ed_menegotto_pinto_initialise(const ed_menegotto_pinto *law, double *state)
{
  memset(state, 0, (size_t)law->n * ED_MENEGOTTO_PINTO_STATE * sizeof *state);
  for (int i = 0; i < law->n; i++) { /* as if loaded upwards from the origin: turning there gives the other direction's first branch */
    double *at = state + fields_at(i);
    at[AT(LARGEST)] = at[AT(SPAN)] = law->yield_strain[i];
    at[AT(LEAST)] = -law->yield_strain[i];
    at[AT(EXPONENT)] = law->R0[i];
    at[AT(SAFE)] = FAR;
  }
}

int ed_menegotto_pinto_valid(int n, const double *state)
{
  for (int i = 0; i < n; i++) {
    const double *at = state + fields_at(i);
    if (!(at[AT(AHEAD)] >= 0.0 && at[AT(AHEAD)] <= DEPTH && at[AT(BEHIND)] >= 0.0 && at[AT(BEHIND)] <= DEPTH))
      return 0;
  }
  return 1;
}

double ed_menegotto_pinto_stress(const double *state, int fibre)
{
  return state[fields_at(fibre) + AT(STRESS)];
}

/* Where |x|^R is not below the accuracy of powers, beside 1; elsewhere a branch is still its elastic line. log2 |x| is at most its
 * exponent, its mantissa less 1, and 0.08608, by which the logarithm bends above its chord. */
ED_INLINE void curved_part(const ed_lanes *x, const ed_lanes *R, ed_mask *curved)
{
  static const double NOTHING = -48.0; /* log2 of 4e-15 */
  ed_lanes size;
  ed_lanes_size(x, &size);
  const ed_lanes whole = (ed_lanes)(((ed_bits)size >> 12) | ED_WHOLE) - 0x1p52;
  const ed_lanes logarithm = whole * 0x1p-40 - (1023.0 - 0.08608);
  *curved = ~(*R * logarithm < NOTHING);
}

/* The branch that begins at the committed points of a group of fibres where they turn. The elastic line through the point meets
 * stress = direction fy (1 - b) + b E strain. */
ED_INLINE void reversal_branch(const ed_menegotto_pinto *law, const double *at, int i, ed_lanes *span, ed_lanes *exponent)
{
  const ed_lanes zero = {0}, one = zero + 1.0, strain = ED_LOAD(at + AT(STRAIN)), E = ED_LOAD(law->E + i), b = ED_LOAD(law->b + i);
  const ed_lanes yield_strain = ED_LOAD(law->yield_strain + i), shortest = 1e-12 * yield_strain;
  const ed_mask upwards = ED_LOAD(at + AT(SPAN)) < zero;
  const ed_lanes direction = ED_SELECT(upwards, one, -one);
  const ed_lanes elastic = direction * yield_strain - (ED_LOAD(at + AT(STRESS)) - b * E * strain) / (E * (1.0 - b));
  /* a turn on the asymptote itself leaves no elastic part */
  *span = ED_SELECT(direction * elastic < shortest, direction * shortest, elastic);
  ed_lanes excursion = ED_SELECT(upwards, ED_LOAD(at + AT(LARGEST)), ED_LOAD(at + AT(LEAST))) - (strain + *span);
  ed_lanes_size(&excursion, &excursion);
  const ed_lanes share = excursion / (ED_LOAD(law->cR2 + i) * yield_strain + excursion);
  *exponent = ED_LOAD(law->R0 + i) * (1.0 - ED_LOAD(law->cR1 + i) * share);
}

enum {
  CHUNK = 32,               /* fibres that are evaluated together */
  EVALUATIONS = CHUNK * (1 + 4 * DEPTH) + ED_LANE_WIDTH /* their own branches, remembered ones up to four times, room for whole vectors */
};

/* Branches to evaluate, without regard to what asks for them: where straight fibres fall out, the rest fills vectors. */
typedef struct {
  int count;
  double x[EVALUATIONS], R[EVALUATIONS], curve[EVALUATIONS], slope[EVALUATIONS];
} evaluations;

/* x / (1 + |x|^R)^(1/R) and its slope, by the power of |x| or 1/|x|, whichever is below 1: nothing overflows. Logarithms and powers in
 * passes of their own: within one pass the steps of many vectors overlap, while one vector's steps wait for each other. */
ED_INLINE void evaluate(evaluations *list)
{
  if (list->count == 0)
    return;
  const ed_lanes zero = {0}, one = zero + 1.0, tiny = zero + 1e-300, lowest = zero - 1000.0;
  double *const power = list->slope, *const exponent = list->curve;
  ED_STORE(list->x + list->count, zero);
  ED_STORE(list->R + list->count, one);
  for (int i = 0; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes x = ED_LOAD(list->x + i);
    ed_lanes size, logarithm;
    ed_lanes_size(&x, &size);
    size = ED_SELECT(size > tiny, size, tiny);
    ed_lanes_log2(&size, &logarithm);
    ed_lanes_size(&logarithm, &logarithm);
    logarithm *= -ED_LOAD(list->R + i);
    ED_STORE(exponent + i, ED_SELECT(logarithm > lowest, logarithm, lowest));
  }
  for (int i = 0; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes y = ED_LOAD(exponent + i);
    ed_lanes result;
    ed_lanes_exp2(&y, &result);
    ED_STORE(power + i, result);
  }
  for (int i = 0; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes sum = one + ED_LOAD(power + i);
    ed_lanes logarithm;
    ed_lanes_log2(&sum, &logarithm);
    logarithm /= -ED_LOAD(list->R + i);
    ED_STORE(exponent + i, ED_SELECT(logarithm > lowest, logarithm, lowest));
  }
  for (int i = 0; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes y = ED_LOAD(exponent + i), x = ED_LOAD(list->x + i), raised = ED_LOAD(power + i);
    ed_lanes root, size;
    ed_lanes_exp2(&y, &root);
    ed_lanes_size(&x, &size);
    const ed_mask outside = size > one;
    const ed_lanes sign = (ed_lanes)(((ed_bits)x & ED_SIGN) | ED_ONE);
    ED_STORE(list->curve + i, ED_SELECT(outside, sign, x) * root);
    ED_STORE(list->slope + i, ED_SELECT(outside, raised, one) * root / (ED_SELECT(outside, size, one) * (one + raised)));
  }
}

/* Lists the first `count` branches of a stack at a strain; the return is where. Only their own places are kept of the vector written. */
ED_INLINE int list_stack(evaluations *list, const branches *stack, int count, double strain)
{
  const int at = list->count;
  const ed_lanes x = (strain - ED_LOAD(stack->strain)) / ED_LOAD(stack->span);
  ED_STORE(list->x + at, x);
  ED_STORE(list->R + at, ED_LOAD(stack->exponent));
  list->count += count;
  return at;
}

/* A fibre that has to look at remembered branches. */
typedef struct {
  int fibre;     /* from the first of the chunk */
  int reversed;
  double direction;
  int here, there; /* evaluations of the branches at the committed strain, if reversed, and at the new one */
  int ahead;     /* branches that lie ahead */
  int governs;   /* which of them the fibre is on, or -1 */
} bounded_fibre;

/* What a chunk of fibres answers. */
typedef struct {
  double *stress, *tangent; /* of each */
  int elastic;
  int reversed[CHUNK / ED_LANE_WIDTH]; /* bits of the fibres of each group that turn */
  int bounded_count;
  bounded_fibre bounded[CHUNK];
  evaluations list;
} chunk_response;

/* What the fibres of a group do, as bits of each: reverse, may be bounded by remembered branches, leave the straight part. */
enum { REVERSES = 1, BOUNDED = 16, CURVED = 256, ALL = 15 };

ED_INLINE void stack_response(const ed_menegotto_pinto *law, const evaluations *list, int at, const branches *stack, int k, int i,
                              double strain, double *stress, double *tangent)
{
  const double E = law->E[i], b = law->b[i];
  *stress = stack->stress[k] + E * (b * (strain - stack->strain[k]) + (1.0 - b) * stack->span[k] * list->curve[at + k]);
  *tangent = E * (b + (1.0 - b) * list->slope[at + k]);
}

/* Where a group of fibres is on its branches. */
typedef struct {
  ed_lanes along, span, from_stress, x, R;
  int marks; /* what its fibres do */
  int place; /* in the list of evaluations; -1 where it is straight */
} group;

ED_INLINE void mark(group *it, const ed_mask *turns, const ed_mask *bounds)
{
  it->x = it->along / it->span;
  ed_mask marks;
  curved_part(&it->x, &it->R, &marks);
  marks = ED_WEIGHTED(marks, CURVED) | ED_WEIGHTED(*turns, REVERSES) | ED_WEIGHTED(*bounds, BOUNDED);
  it->marks = ed_lanes_bits(&marks);
}

/* A group whose fibres go on in their directions. */
ED_INLINE void continue_loading(const double *at, const double *strain, group *it)
{
  const ed_lanes zero = {0}, to = ED_LOAD(strain), before = ED_LOAD(at + AT(STRAIN)), past = to - ED_LOAD(at + AT(SAFE));
  it->span = ED_LOAD(at + AT(SPAN));
  it->R = ED_LOAD(at + AT(EXPONENT));
  it->along = to - ED_LOAD(at + AT(FROM_STRAIN));
  it->from_stress = ED_LOAD(at + AT(FROM_STRESS));
  it->place = -1;
  const ed_mask upwards = it->span > zero, turns = (upwards & (to < before)) | (~upwards & (to > before));
  const ed_mask bounds = (upwards & (past > zero)) | (~upwards & (past < zero));
  mark(it, &turns, &bounds);
}

/* The same group, where some fibres turn. */
ED_INLINE void reverse_loading(const ed_menegotto_pinto *law, const double *at, int i, const double *strain, group *it)
{
  const ed_mask bit = {1, 2, 4, 8}, none = {0};
  const ed_mask turns = ((it->marks & bit * REVERSES) != none), were_bounded = ((it->marks & bit * BOUNDED) != none);
  const ed_lanes zero = {0}, to = ED_LOAD(strain);
  ed_lanes span, R;
  reversal_branch(law, at, i, &span, &R);
  it->span = ED_SELECT(turns, span, it->span);
  it->R = ED_SELECT(turns, R, it->R);
  it->along = ED_SELECT(turns, to - ED_LOAD(at + AT(STRAIN)), it->along);
  it->from_stress = ED_SELECT(turns, ED_LOAD(at + AT(STRESS)), it->from_stress);
  const ed_mask bounds = (turns & (ED_LOAD(at + AT(BEHIND)) > zero)) | (~turns & were_bounded);
  mark(it, &turns, &bounds);
}

/* Lists the remembered branches that a fibre has to look at. */
ED_INLINE void list_bounds(const ed_menegotto_pinto *law, const double *state, int first, int fibre, int reversed, double strain,
                           chunk_response *a)
{
  const int i = first + fibre;
  const double *at = state + fields_at(i);
  bounded_fibre *q = &a->bounded[a->bounded_count++];
  q->fibre = fibre;
  q->reversed = reversed;
  q->direction = (at[AT(SPAN)] > 0.0) != reversed ? 1.0 : -1.0;
  q->ahead = (int)at[reversed ? AT(BEHIND) : AT(AHEAD)];
  const branches *stack = (const branches *)(const void *)(state + branches_at(law->n, i, q->direction));
  if (reversed)
    q->here = list_stack(&a->list, stack, q->ahead, at[AT(STRAIN)]);
  q->there = list_stack(&a->list, stack, q->ahead, strain);
}

/* Response of fibres first to first + count on the branch followed, or on the one that begins where they turn, bounded by those
 * remembered. A return behind the beginning of a remembered branch, or across it, has erased it. */
ED_INLINE void respond(const ed_menegotto_pinto *law, const double *state, int first, int count, const double *strain, chunk_response *a)
{
  const int groups = count / ED_LANE_WIDTH;
  group all[CHUNK / ED_LANE_WIDTH];
  int any = 0;
  a->list.count = a->bounded_count = 0;
  for (int g = 0; g < groups; g++) {
    continue_loading(state + fields_at(first + g * ED_LANE_WIDTH), strain + g * ED_LANE_WIDTH, &all[g]);
    any |= all[g].marks;
  }
  for (int g = 0; g < groups && any; g++) {
    const int i = g * ED_LANE_WIDTH;
    group *it = &all[g];
    if (it->marks & ALL * REVERSES)
      reverse_loading(law, state + fields_at(first + i), first + i, strain + i, it);
    if (it->marks & ALL * CURVED) {
      it->place = a->list.count;
      ED_STORE(a->list.x + it->place, it->x);
      ED_STORE(a->list.R + it->place, it->R);
      a->list.count += ED_LANE_WIDTH;
    }
    for (int left = it->marks / BOUNDED & ALL; left; left &= left - 1) {
      const int k = __builtin_ctz((unsigned)left);
      list_bounds(law, state, first, i + k, it->marks / REVERSES >> k & 1, strain[i + k], a);
    }
  }
  evaluate(&a->list);
  a->elastic = a->list.count == 0;
  for (int g = 0; g < groups; g++) {
    const int i = g * ED_LANE_WIDTH;
    const group *it = &all[g];
    const ed_lanes E = ED_LOAD(law->E + first + i);
    a->reversed[g] = it->marks / REVERSES & ALL;
    if (it->place < 0) {
      ED_STORE(a->stress + i, it->from_stress + E * it->along);
      ED_STORE(a->tangent + i, E);
      continue;
    }
    const ed_lanes b = ED_LOAD(law->b + first + i);
    ED_STORE(a->stress + i,
             it->from_stress + E * (b * it->along + (1.0 - b) * it->span * ED_LOAD(a->list.curve + it->place)));
    ED_STORE(a->tangent + i, E * (b + (1.0 - b) * ED_LOAD(a->list.slope + it->place)));
  }
  for (int j = 0; j < a->bounded_count; j++) {
    bounded_fibre *q = &a->bounded[j];
    const int i = first + q->fibre;
    const double *at = state + fields_at(i);
    const branches *stack = (const branches *)(const void *)(state + branches_at(law->n, i, q->direction));
    const double here = at[AT(STRAIN)], stress_here = at[AT(STRESS)];
    /* elastic lines of many branches coincide: rounding must not decide which of them is crossed. Powers are good to 2e-14, and a
     * straight part leaves out 4e-15; this is well above both, and far below any tolerance of equilibrium */
    const double on_it = 1e-12 * law->E[i] * law->yield_strain[i];
    double stress, tangent;
    for (; q->reversed && q->ahead > 0; q->ahead--) {
      stack_response(law, &a->list, q->here, stack, q->ahead - 1, i, here, &stress, &tangent);
      if (q->direction * (here - stack->strain[q->ahead - 1]) > 0.0 && q->direction * (stress_here - stress) <= on_it)
        break;
    }
    q->governs = -1;
    for (int k = q->ahead - 1; k >= 0; k--) {
      stack_response(law, &a->list, q->there, stack, k, i, strain[q->fibre], &stress, &tangent);
      if (q->direction * (a->stress[q->fibre] - stress) > 0.0) {
        a->stress[q->fibre] = stress;
        a->tangent[q->fibre] = tangent;
        q->governs = k;
      }
    }
  }
}

ED_CLONES int ed_menegotto_pinto_trial(const ed_menegotto_pinto *law, const double *state, int first, int count,
                                       const double *strain, double *stress, double *tangent)
{
  int elastic = 1;
  for (int from = 0; from < count; from += CHUNK) {
    const int some = count - from < CHUNK ? count - from : CHUNK;
    chunk_response a;
    a.stress = stress + from;
    a.tangent = tangent + from;
    respond(law, state, first + from, some, strain + from, &a);
    elastic &= a.elastic;
  }
  return elastic;
}

/* Horizons at which remembered branches are looked at in advance, in steps like the last. They decide how often fibres ask, not what
 * they do. */
enum { HORIZONS = 3 };
static const double HORIZON[HORIZONS] = {8.0, 64.0, 512.0};

/* Strain up to which a fibre that is now at `strain`, on its own branch, meets none of the first `count` remembered ones, which `list` has
 * from `at` on: at this strain, then at each horizon. Branches rise ever less steeply, so that up to a horizon the own one gains on another
 * at most the difference of its present slope and of the other's slope there. */
ED_INLINE double safe_strain(const ed_menegotto_pinto *law, const evaluations *list, int at, const branches *stack, int i, int count,
                             double direction, double strain, double step, double stress, double tangent)
{
  if (count == 0)
    return direction * FAR;
  double gap[DEPTH], ignored, safe = 0.0;
  for (int k = 0; k < count; k++) {
    stack_response(law, list, at, stack, k, i, strain, &gap[k], &ignored);
    gap[k] = direction * (gap[k] - stress);
  }
  for (int h = 0; h < HORIZONS; h++) {
    const double horizon = HORIZON[h] * fabs(step);
    double reach = horizon;
    for (int k = 0; k < count; k++) {
      const double slope = law->E[i] * (law->b[i] + (1.0 - law->b[i]) * list->slope[at + (1 + h) * count + k]), gain = tangent - slope;
      if (gap[k] < gain * reach)
        reach = gap[k] / gain;
    }
    safe = fmax(safe, reach);
    if (reach < horizon)
      break;
  }
  return strain + direction * safe;
}

/* Where fibres of a group turn the branch followed is remembered, and another begins. */
ED_INLINE void reverse(const ed_menegotto_pinto *law, double *state, int i, int reversed)
{
  double *group = state + fields_at(i);
  ed_lanes span, exponent;
  reversal_branch(law, group, i, &span, &exponent);
  for (; reversed; reversed &= reversed - 1) {
    const int k = __builtin_ctz((unsigned)reversed);
    double *at = group + k;
    branches *leaving = (branches *)(void *)(state + branches_at(law->n, i + k, at[AT(SPAN)]));
    int left = (int)at[AT(AHEAD)];
    if (left == DEPTH)
      left--; /* the wide ones matter: forget the innermost */
    leaving->strain[left] = at[AT(FROM_STRAIN)];
    leaving->stress[left] = at[AT(FROM_STRESS)];
    leaving->span[left] = at[AT(SPAN)];
    leaving->exponent[left] = at[AT(EXPONENT)];
    at[AT(AHEAD)] = 0.0;
    at[AT(BEHIND)] = left + 1;
    at[AT(FROM_STRAIN)] = at[AT(STRAIN)];
    at[AT(FROM_STRESS)] = at[AT(STRESS)];
    at[AT(SPAN)] = span[k];
    at[AT(EXPONENT)] = exponent[k];
    at[AT(SAFE)] = span[k] > 0.0 ? FAR : -FAR;
  }
}

/* Fibres that meet, or may soon meet, a remembered branch. */
ED_INLINE void update_bounds(const ed_menegotto_pinto *law, double *state, int first, const double *strain, chunk_response *a)
{
  int listed[CHUNK], count[CHUNK];
  evaluations *list = &a->list;
  list->count = 0;
  for (int j = 0; j < a->bounded_count; j++) {
    const bounded_fibre *q = &a->bounded[j];
    const int i = first + q->fibre;
    double *at = state + fields_at(i);
    const branches *stack = (const branches *)(const void *)(state + branches_at(law->n, i, q->direction));
    count[j] = q->ahead;
    if (q->governs >= 0) { /* back on a curve that was left; nothing remains of the reversals inside it */
      count[j] = q->governs;
      at[AT(FROM_STRAIN)] = stack->strain[q->governs];
      at[AT(FROM_STRESS)] = stack->stress[q->governs];
      at[AT(SPAN)] = stack->span[q->governs];
      at[AT(EXPONENT)] = stack->exponent[q->governs];
    }
    at[AT(AHEAD)] = count[j];
    const double to = strain[q->fibre], step = fabs(to - at[AT(STRAIN)]);
    listed[j] = list_stack(list, stack, count[j], to);
    for (int h = 0; h < HORIZONS; h++)
      list_stack(list, stack, count[j], to + q->direction * HORIZON[h] * step);
  }
  evaluate(list);
  for (int j = 0; j < a->bounded_count; j++) {
    const bounded_fibre *q = &a->bounded[j];
    const int i = first + q->fibre;
    double *at = state + fields_at(i);
    const branches *stack = (const branches *)(const void *)(state + branches_at(law->n, i, q->direction));
    at[AT(SAFE)] = safe_strain(law, list, listed[j], stack, i, count[j], q->direction, strain[q->fibre],
                               strain[q->fibre] - at[AT(STRAIN)], a->stress[q->fibre], a->tangent[q->fibre]);
  }
}

/* Moves one chunk of fibres. */
ED_INLINE void commit_chunk(const ed_menegotto_pinto *law, double *state, int first, int count, const double *strain, double *dissipated)
{
  double stress[CHUNK], tangent[CHUNK];
  chunk_response a;
  a.stress = stress;
  a.tangent = tangent;
  respond(law, state, first, count, strain, &a);
  for (int g = 0; g * ED_LANE_WIDTH < count; g++)
    if (a.reversed[g])
      reverse(law, state, first + g * ED_LANE_WIDTH, a.reversed[g]);
  update_bounds(law, state, first, strain, &a);
  for (int i = 0; i < count; i += ED_LANE_WIDTH) {
    double *at = state + fields_at(first + i);
    const ed_lanes strains = ED_LOAD(strain + i), before = ED_LOAD(at + AT(STRAIN));
    const ed_lanes stresses = ED_LOAD(a.stress + i), stress_before = ED_LOAD(at + AT(STRESS));
    /* trapezoid, less what is stored */
    const ed_lanes work = 0.5 * (stress_before + stresses) * (strains - before);
    const ed_lanes stored = 0.5 * (stresses * stresses - stress_before * stress_before) / ED_LOAD(law->E + first + i);
    ED_STORE(dissipated + i, work - stored);
    const ed_lanes largest = ED_LOAD(at + AT(LARGEST)), least = ED_LOAD(at + AT(LEAST));
    ED_STORE(at + AT(STRAIN), strains);
    ED_STORE(at + AT(STRESS), stresses);
    ED_STORE(at + AT(LARGEST), ED_SELECT(strains > largest, strains, largest));
    ED_STORE(at + AT(LEAST), ED_SELECT(strains < least, strains, least));
  }
}

ED_CLONES void ed_menegotto_pinto_commit(const ed_menegotto_pinto *law, double *state, int first, int count,
                                         const double *strain, double *dissipated)
{
  for (int from = 0; from < count; from += CHUNK)
    commit_chunk(law, state, first + from, count - from < CHUNK ? count - from : CHUNK, strain + from, dissipated + from);
}
