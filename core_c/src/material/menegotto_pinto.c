#include "material/menegotto_pinto.h"

#include "base/clones.h"
#include "base/lanes.h"

#include <math.h>
#include <string.h>

enum { DEPTH = ED_LANE_WIDTH }; /* reversals inside reversals that are remembered: a fibre's fill one vector */

/* What a fibre keeps beside the branches that it left; most trials read the first seven. */
enum {
  STRAIN,                         /* committed */
  FROM_STRAIN, FROM_STRESS, SPAN, /* the branch followed, see below; the sign of its span is the direction of loading */
  STRAIGHT,                       /* how far that branch is straight, a size */
  SAFE,                           /* strain, in the direction, up to which no remembered branch can govern */
  WINDOW,                         /* how far from its beginning a turn leaves the branch as it is, see set_lengths */
  EXPONENT,                       /* of the branch followed */
  STRESS,                         /* committed */
  AHEAD, BEHIND,                  /* how many branches are remembered for the direction, and for the other one */
  LARGEST, LEAST,                 /* strains so far, the yield strains at least */
  FURTHEST,                       /* strain on the branch followed: the committed one, but where the fibre has turned in its window */
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
static const double LINEAR = 1e-12; /* error of stress / yield stress up to which it counts as linear in strain */

void ed_menegotto_pinto_place(ed_menegotto_pinto *law, int n, double *block)
{
  double **arrays[ED_MENEGOTTO_PINTO_ARRAYS] = {&law->E, &law->b, &law->yield_strain, &law->R0, &law->cR1, &law->cR2};
  law->n = n;
  law->plain_turns = 1;
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
  return (size_t)fibre / ED_LANE_WIDTH * GROUP + (size_t)fibre % ED_LANE_WIDTH;
}

static size_t branches_at(int n, int fibre, double direction)
{
  return (size_t)n * FIELDS + (size_t)fibre * 2 * STACK + (direction > 0.0 ? 0 : STACK);
}

/* How far a branch is still its elastic line: where |x|^R is below the accuracy of powers, beside 1. */
ED_INLINE void straight_length(const ed_lanes *span, const ed_lanes *R, ed_lanes *length)
{
  static const double NOTHING = -48.0; /* log2 of 4e-15 */
  const ed_lanes zero = {0}, lowest = zero - 1000.0;
  ed_lanes exponent = NOTHING / *R, size;
  exponent = ED_SELECT(exponent > lowest, exponent, lowest);
  ed_lanes_exp2(&exponent, length);
  ed_lanes_size(span, &size);
  *length *= size;
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

/* Branches that begin at (strain, stress) and go upwards or downwards, of a group of fibres with the fields `at`. The elastic line
 * through the point meets stress = direction fy (1 - b) + b E strain. */
ED_INLINE void branch_from(const ed_menegotto_pinto *law, const double *at, int i, const ed_lanes *strain, const ed_lanes *stress,
                           const ed_mask *upwards, ed_lanes *span, ed_lanes *exponent)
{
  const ed_lanes zero = {0}, one = zero + 1.0, E = ED_LOAD(law->E + i), b = ED_LOAD(law->b + i);
  const ed_lanes yield_strain = ED_LOAD(law->yield_strain + i), shortest = 1e-12 * yield_strain;
  const ed_lanes direction = ED_SELECT(*upwards, one, -one);
  const ed_lanes elastic = direction * yield_strain - (*stress - b * E * *strain) / (E * (1.0 - b));
  /* a turn on the asymptote itself leaves no elastic part */
  *span = ED_SELECT(direction * elastic < shortest, direction * shortest, elastic);
  ed_lanes excursion = ED_SELECT(*upwards, ED_LOAD(at + AT(LARGEST)), ED_LOAD(at + AT(LEAST))) - (*strain + *span);
  ed_lanes_size(&excursion, &excursion);
  const ed_lanes share = excursion / (ED_LOAD(law->cR2 + i) * yield_strain + excursion);
  *exponent = ED_LOAD(law->R0 + i) * (1.0 - ED_LOAD(law->cR1 + i) * share);
}

/* The branch that begins where the fibres of a group turn: at the furthest points of their branches. */
ED_INLINE void reversal_branch(const ed_menegotto_pinto *law, const double *at, int i, ed_lanes *strain, ed_lanes *stress, ed_lanes *span,
                               ed_lanes *exponent)
{
  const ed_lanes zero = {0}, E = ED_LOAD(law->E + i);
  const ed_mask upwards = ED_LOAD(at + AT(SPAN)) < zero;
  *strain = ED_LOAD(at + AT(FURTHEST));
  *stress = ED_SELECT(*strain == ED_LOAD(at + AT(STRAIN)), ED_LOAD(at + AT(STRESS)),
                      ED_LOAD(at + AT(FROM_STRESS)) + E * (*strain - ED_LOAD(at + AT(FROM_STRAIN))));
  branch_from(law, at, i, strain, stress, &upwards, span, exponent);
}

/* Lengths of branches that have just begun or been resumed, in lanes `begun` and `resumed` of a group.
 *
 * Within its window a branch is its elastic line, and so would be the one that began at a turn there, back to where this one began. Such a
 * turn needs no other branch, and most turns of frames are such. A turn at the distance m leaves to the other branch the span g + m,
 * g that of one from the beginning of this one: m = r (g + m), where r is the share of it that is straight. A branch that is resumed has been
 * left beyond its window. */
ED_INLINE void set_lengths(const ed_menegotto_pinto *law, double *at, int i, const ed_mask *begun, const ed_mask *resumed)
{
  const ed_lanes zero = {0}, one = zero + 1.0, span = ED_LOAD(at + AT(SPAN)), own = ED_LOAD(at + AT(EXPONENT));
  const ed_lanes strain = ED_LOAD(at + AT(FROM_STRAIN)), stress = ED_LOAD(at + AT(FROM_STRESS));
  const ed_mask back = span < zero;
  ed_lanes straight, share, other, exponent;
  straight_length(&span, &own, &straight);
  branch_from(law, at, i, &strain, &stress, &back, &other, &exponent);
  straight_length(&one, &exponent, &share);
  ed_lanes_size(&other, &other);
  const ed_lanes turn = share * other / (one - share);
  ED_STORE(at + AT(STRAIGHT), ED_SELECT(*begun | *resumed, straight, ED_LOAD(at + AT(STRAIGHT))));
  const ed_lanes window = ED_SELECT(*begun, ED_SELECT(turn < straight, turn, straight), ED_LOAD(at + AT(WINDOW)));
  ED_STORE(at + AT(WINDOW), ED_SELECT(*resumed, zero, window));
}

void ed_menegotto_pinto_initialise(const ed_menegotto_pinto *law, double *state)
{
  memset(state, 0, (size_t)law->n * ED_MENEGOTTO_PINTO_STATE * sizeof *state);
  for (int i = 0; i < law->n; i += ED_LANE_WIDTH) {
    const ed_lanes span = ED_LOAD(law->yield_strain + i), exponent = ED_LOAD(law->R0 + i);
    ed_lanes straight;
    straight_length(&span, &exponent, &straight);
    ED_STORE(state + fields_at(i) + AT(STRAIGHT), straight);
  }
  for (int i = 0; i < law->n; i++) { /* as if loaded upwards from the origin: turning there gives the other direction's first branch */
    double *at = state + fields_at(i);
    at[AT(LARGEST)] = at[AT(SPAN)] = law->yield_strain[i];
    at[AT(LEAST)] = -law->yield_strain[i];
    at[AT(EXPONENT)] = law->R0[i];
    at[AT(SAFE)] = FAR;
  }
  for (int i = 0; i < law->n && !law->plain_turns; i += ED_LANE_WIDTH) {
    const ed_mask none = {0}, all = ~none;
    set_lengths(law, state + fields_at(i), i, &all, &none);
  }
}

enum {
  CHUNK = 32,               /* fibres that are evaluated together */
  EVALUATIONS = CHUNK * (1 + 5 * DEPTH) + ED_LANE_WIDTH /* their own branches, remembered ones up to four times, room for whole vectors */
};

/* Branches to evaluate, without regard to what asks for them: where straight fibres fall out, the rest fills vectors. */
typedef struct {
  int count;
  double x[EVALUATIONS], R[EVALUATIONS], curve[EVALUATIONS], slope[EVALUATIONS];
} evaluations;

/* x / (1 + |x|^R)^(1/R) and its slope, by the power of |x| or 1/|x|, whichever is below 1: nothing overflows. Logarithms and powers in
 * passes of their own: within one pass the steps of many vectors overlap, while one vector's steps wait for each other. */
ED_INLINE void evaluate(evaluations *list, int from)
{
  if (list->count == from)
    return;
  const ed_lanes zero = {0}, one = zero + 1.0, tiny = zero + 1e-300, lowest = zero - 1000.0;
  double *const power = list->slope, *const exponent = list->curve;
  ED_STORE(list->x + list->count, zero);
  ED_STORE(list->R + list->count, one);
  for (int i = from; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes x = ED_LOAD(list->x + i);
    ed_lanes size, logarithm;
    ed_lanes_size(&x, &size);
    size = ED_SELECT(size > tiny, size, tiny);
    ed_lanes_log2(&size, &logarithm);
    ed_lanes_size(&logarithm, &logarithm);
    logarithm *= -ED_LOAD(list->R + i);
    ED_STORE(exponent + i, ED_SELECT(logarithm > lowest, logarithm, lowest));
  }
  for (int i = from; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes y = ED_LOAD(exponent + i);
    ed_lanes result;
    ed_lanes_exp2(&y, &result);
    ED_STORE(power + i, result);
  }
  for (int i = from; i < list->count; i += ED_LANE_WIDTH) {
    const ed_lanes sum = one + ED_LOAD(power + i);
    ed_lanes logarithm;
    ed_lanes_log2(&sum, &logarithm);
    logarithm /= -ED_LOAD(list->R + i);
    ED_STORE(exponent + i, ED_SELECT(logarithm > lowest, logarithm, lowest));
  }
  for (int i = from; i < list->count; i += ED_LANE_WIDTH) {
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
  size_t fields, stack; /* where its fields, and the branches of its direction, lie in the state */
  double direction;
  int here, there; /* evaluations of the branches at the committed strain, if reversed, and at the new one */
  int ahead;     /* branches that lie ahead */
  int governs;   /* which of them the fibre is on, or -1 */
} bounded_fibre;

/* Where a group of fibres is on its branches. */
typedef struct {
  ed_lanes along, span, from_stress, straight, R;
  ed_lanes moved;       /* strain since the commit */
  ed_lanes back, free;  /* strain back to where it would turn, and on to where a remembered branch may govern */
  int marks; /* what its fibres do */
  int place; /* in the list of evaluations; -1 where it has none */
} group;

/* What the fibres of a group do, as bits of each: reverse, may be bounded by remembered branches, leave the straight part. */
enum { REVERSES = 1, BOUNDED = 16, CURVED = 256, ALL = 15 };

/* A chunk of fibres at new strains. */
typedef struct {
  int groups;
  group group[CHUNK / ED_LANE_WIDTH];
  int bounded_count;
  bounded_fibre bounded[CHUNK];
  evaluations list;
} chunk;

/* How far stresses follow their tangents. */
typedef struct {
  ed_lanes room; /* strain to the nearest kink */
  ed_lanes bend; /* largest |d2 stress / d strain2| / (E yield strain) */
} smoothness;

ED_INLINE const branches *stack_of(const double *state, const bounded_fibre *q)
{
  return (const branches *)(const void *)(state + q->stack);
}

ED_INLINE void mark(group *it, const ed_mask *turns, const ed_mask *bounds)
{
  ed_lanes size;
  ed_lanes_size(&it->along, &size);
  ed_mask marks = size > it->straight;
  marks = ED_WEIGHTED(marks, CURVED) | ED_WEIGHTED(*turns, REVERSES) | ED_WEIGHTED(*bounds, BOUNDED);
  it->marks = ed_lanes_bits(&marks);
}

/* A group whose fibres go on in their directions. */
ED_INLINE void continue_loading(const double *at, const double *strain, group *it)
{
  const ed_lanes zero = {0}, far = zero + FAR, to = ED_LOAD(strain), past = to - ED_LOAD(at + AT(SAFE));
  it->moved = to - ED_LOAD(at + AT(STRAIN));
  it->span = ED_LOAD(at + AT(SPAN));
  it->straight = ED_LOAD(at + AT(STRAIGHT));
  it->along = to - ED_LOAD(at + AT(FROM_STRAIN));
  it->from_stress = ED_LOAD(at + AT(FROM_STRESS));
  it->place = -1;
  const ed_lanes before = ED_LOAD(at + AT(STRAIN)) - ED_LOAD(at + AT(FROM_STRAIN));
  const ed_mask upwards = it->span > zero;
  ed_lanes size;
  ed_lanes_size(&before, &size);
  const ed_mask inside = size <= ED_LOAD(at + AT(WINDOW)); /* it would turn where the branch begins, else where it is committed */
  const ed_lanes way = ED_SELECT(inside, it->along, it->moved);
  const ed_mask turns = (upwards & (way < zero)) | (~upwards & (way > zero));
  ed_lanes_size(&way, &it->back);
  const ed_mask bounds = (upwards & (past > zero)) | (~upwards & (past < zero));
  ed_lanes_size(&past, &it->free);
  it->free = ED_SELECT(bounds, far, it->free);
  mark(it, &turns, &bounds);
}

/* The same group, where some fibres turn. */
ED_INLINE void reverse_loading(const ed_menegotto_pinto *law, const double *at, int i, group *it)
{
  const ed_mask bit = {1, 2, 4, 8}, none = {0};
  const ed_mask turns = ((it->marks & bit * REVERSES) != none), were_bounded = ((it->marks & bit * BOUNDED) != none);
  const ed_lanes zero = {0};
  ed_lanes strain, stress, span, R, straight;
  reversal_branch(law, at, i, &strain, &stress, &span, &R);
  straight_length(&span, &R, &straight);
  it->span = ED_SELECT(turns, span, it->span);
  it->straight = ED_SELECT(turns, straight, it->straight);
  it->R = ED_SELECT(turns, R, it->R);
  it->along = ED_SELECT(turns, it->moved + (ED_LOAD(at + AT(STRAIN)) - strain), it->along);
  it->from_stress = ED_SELECT(turns, stress, it->from_stress);
  const ed_mask bounds = (turns & (ED_LOAD(at + AT(BEHIND)) > zero)) | (~turns & were_bounded);
  mark(it, &turns, &bounds);
}

/* Lists the remembered branches that fibre i, number `fibre` of the chunk, has to look at; `at` are its fields. */
ED_INLINE void list_bounds(const ed_menegotto_pinto *law, const double *state, const double *at, int i, int fibre, int reversed,
                           double strain, chunk *a)
{
  bounded_fibre *q = &a->bounded[a->bounded_count++];
  q->fibre = fibre;
  q->reversed = reversed;
  q->direction = (at[AT(SPAN)] > 0.0) != reversed ? 1.0 : -1.0;
  q->ahead = (int)at[reversed ? AT(BEHIND) : AT(AHEAD)];
  q->fields = (size_t)(at - state);
  q->stack = branches_at(law->n, i, q->direction);
  const branches *stack = stack_of(state, q);
  if (reversed)
    q->here = list_stack(&a->list, stack, q->ahead, at[AT(FURTHEST)]);
  q->there = list_stack(&a->list, stack, q->ahead, strain);
}

/* Finds what fibres first to first + count do at their strains, and evaluates the branches that matter: all that are curved, or, where
 * stresses are `known`, those of groups with a bounded fibre. */
ED_INLINE void find_branches(const ed_menegotto_pinto *law, const double *state, int first, int count, const double *strain, int known,
                             chunk *a)
{
  const double *const fields = state + fields_at(first);
  const int matters = known ? ALL * BOUNDED : ALL * CURVED;
  int any = 0;
  a->groups = count / ED_LANE_WIDTH;
  a->list.count = a->bounded_count = 0;
  for (int g = 0; g < a->groups; g++) {
    continue_loading(fields + g * GROUP, strain + g * ED_LANE_WIDTH, &a->group[g]);
    any |= a->group[g].marks;
  }
  for (int g = 0; g < a->groups && any; g++) {
    const int i = g * ED_LANE_WIDTH;
    const double *at = fields + g * GROUP;
    group *it = &a->group[g];
    it->R = ED_LOAD(at + AT(EXPONENT));
    if (it->marks & ALL * REVERSES)
      reverse_loading(law, at, first + i, it);
    if (it->marks & matters) {
      it->place = a->list.count;
      ED_STORE(a->list.x + it->place, it->along / it->span);
      ED_STORE(a->list.R + it->place, it->R);
      a->list.count += ED_LANE_WIDTH;
    }
    for (int left = it->marks / BOUNDED & ALL; left; left &= left - 1) {
      const int k = __builtin_ctz((unsigned)left);
      list_bounds(law, state, at + k, first + i + k, i + k, it->marks / REVERSES >> k & 1, strain[i + k], a);
    }
  }
  evaluate(&a->list, 0);
}

/* Stresses of a group on its own branches. */
ED_INLINE void follow_branch(const ed_menegotto_pinto *law, int i, const group *it, const evaluations *list, double *stress, double *tangent)
{
  const ed_lanes E = ED_LOAD(law->E + i);
  if (it->place < 0) {
    ED_STORE(stress, it->from_stress + E * it->along);
    ED_STORE(tangent, E);
    return;
  }
  const ed_lanes b = ED_LOAD(law->b + i);
  ED_STORE(stress, it->from_stress + E * (b * it->along + (1.0 - b) * it->span * ED_LOAD(list->curve + it->place)));
  ED_STORE(tangent, E * (b + (1.0 - b) * ED_LOAD(list->slope + it->place)));
}

/* x = (strain, from where a branch begins) / span = along / span. The curve's second derivative is
 * (R + 1) slope share / x, share = |x|^R / (1 + |x|^R) = 1 - x slope / curve. It changes with |x|^R: no farther than |x| / (R + 1) is it
 * taken for constant, where |x|^R has grown by less than e. */
ED_INLINE void smooth_branch(const ed_menegotto_pinto *law, int i, const group *it, const evaluations *list, smoothness *s)
{
  const ed_lanes zero = {0}, one = zero + 1.0, tiny = zero + 1e-300;
  ed_lanes size, kink;
  kink = ED_SELECT(it->free < it->back, it->free, it->back);
  ed_lanes_size(&it->along, &size);
  ed_lanes far = it->straight - size;
  if (it->place >= 0) {
    const ed_lanes curve = ED_LOAD(list->curve + it->place), slope = ED_LOAD(list->slope + it->place);
    const ed_lanes share = one - ED_SELECT(curve == zero, one, slope * it->along / (it->span * curve));
    const ed_lanes bend =
        (it->R + one) * (one - ED_LOAD(law->b + i)) * slope * share / (ED_LOAD(law->yield_strain + i) * (size + tiny));
    s->bend = ED_SELECT(bend > s->bend, bend, s->bend);
    far = ED_SELECT(far > zero, far, size / (it->R + one));
  }
  kink = ED_SELECT(far < kink, far, kink);
  s->room = ED_SELECT(kink < s->room, kink, s->room);
}

ED_INLINE void stack_response(const ed_menegotto_pinto *law, const evaluations *list, int at, const branches *stack, int k, int i,
                              double strain, double *stress, double *tangent)
{
  const double E = law->E[i], b = law->b[i];
  *stress = stack->stress[k] + E * (b * (strain - stack->strain[k]) + (1.0 - b) * stack->span[k] * list->curve[at + k]);
  *tangent = E * (b + (1.0 - b) * list->slope[at + k]);
}

/* As smooth_branch, of a remembered one, from which the governing response has a distance of stress and tangent: they do not meet
 * within distance / (E (1 - b)); where tangents are alike, that they meet does not matter before LINEAR yield / difference. */
ED_INLINE void smooth_bound(const ed_menegotto_pinto *law, int i, const evaluations *list, int at, const branches *stack, int k,
                            double strain, double distance, double difference, smoothness *s)
{
  const double E = law->E[i], b = law->b[i], yield_strain = law->yield_strain[i], R = stack->exponent[k];
  double room = distance / (E * (1.0 - b));
  if (room * difference < LINEAR * E * yield_strain)
    room = LINEAR * E * yield_strain / difference;
  const double along = fabs(strain - stack->strain[k]), curve = fabs(list->curve[at + k]), slope = list->slope[at + k];
  const double share = curve > 0.0 ? 1.0 - along * slope / (fabs(stack->span[k]) * curve) : 0.0;
  const double bend = (R + 1.0) * (1.0 - b) * slope * share / (yield_strain * (along + 1e-300));
  room = along / (R + 1.0) < room ? along / (R + 1.0) : room;
  s->room[0] = room < s->room[0] ? room : s->room[0];
  s->bend[0] = bend > s->bend[0] ? bend : s->bend[0];
}

/* Bounds the fibres that have to look at them by remembered branches. A return behind the beginning of a remembered branch, or across it,
 * has erased it. */
ED_INLINE void bound(const ed_menegotto_pinto *law, const double *state, int first, const double *strain, chunk *a, double *stress,
                     double *tangent, smoothness *s)
{
  for (int j = 0; j < a->bounded_count; j++) {
    bounded_fibre *q = &a->bounded[j];
    const int i = first + q->fibre;
    const double *at = state + q->fields;
    const branches *stack = stack_of(state, q);
    const double here = at[AT(FURTHEST)];
    const double stress_here = here == at[AT(STRAIN)] ? at[AT(STRESS)] : at[AT(FROM_STRESS)] + law->E[i] * (here - at[AT(FROM_STRAIN)]);
    /* elastic lines of many branches coincide: neither rounding nor what stresses leave out of bends must decide which are crossed */
    const double on_it = 2.0 * LINEAR * law->E[i] * law->yield_strain[i];
    double other, other_tangent;
    double *const governing = stress + q->fibre, *const its_tangent = tangent + q->fibre;
    for (; q->reversed && q->ahead > 0; q->ahead--) {
      stack_response(law, &a->list, q->here, stack, q->ahead - 1, i, here, &other, &other_tangent);
      if (q->direction * (here - stack->strain[q->ahead - 1]) > 0.0 && q->direction * (stress_here - other) <= on_it)
        break;
    }
    q->governs = -1;
    for (int k = q->ahead - 1; k >= 0; k--) {
      stack_response(law, &a->list, q->there, stack, k, i, strain[q->fibre], &other, &other_tangent);
      const double above = q->direction * (*governing - other);
      if (s)
        smooth_bound(law, i, &a->list, q->there, stack, k, strain[q->fibre], fabs(above), fabs(*its_tangent - other_tangent), s);
      if (above > 0.0) {
        *governing = other;
        *its_tangent = other_tangent;
        q->governs = k;
      }
    }
  }
}

ED_CLONES int ed_menegotto_pinto_trial(const ed_menegotto_pinto *law, const double *state, int first, int count, const double *strain,
                                       double *stress, double *tangent, double *reach)
{
  const ed_lanes zero = {0};
  smoothness s = {zero + FAR, zero};
  int elastic = 1;
  for (int from = 0; from < count; from += CHUNK) {
    const int some = count - from < CHUNK ? count - from : CHUNK;
    chunk a;
    find_branches(law, state, first + from, some, strain + from, 0, &a);
    elastic &= a.list.count == 0;
    for (int g = 0; g < a.groups; g++) {
      const int i = from + g * ED_LANE_WIDTH;
      follow_branch(law, first + i, &a.group[g], &a.list, stress + i, tangent + i);
      smooth_branch(law, first + i, &a.group[g], &a.list, &s);
    }
    bound(law, state, first + from, strain + from, &a, stress + from, tangent + from, &s);
  }
  double room = s.room[0], bend = s.bend[0];
  for (int k = 1; k < ED_LANE_WIDTH; k++) {
    room = s.room[k] < room ? s.room[k] : room;
    bend = s.bend[k] > bend ? s.bend[k] : bend;
  }
  /* bend distance^2 / 2, where the bend may grow by e, stays within LINEAR */
  const double smooth = sqrt(2.0 / 2.72 * LINEAR / (bend + 1e-300));
  *reach = smooth < room ? smooth : room;
  return elastic;
}

/* Horizons at which remembered branches are looked at in advance, in steps like the last. They decide how often fibres ask, not what
 * they do. */
enum { HORIZONS = 2 };
static const double HORIZON[HORIZONS] = {8.0, 128.0};

/* Strain up to which a fibre that is now at `strain`, on its own branch, meets none of the first `count` remembered ones, which `list` has
 * at this strain from `here` on, and at each horizon from `there` on. Branches rise ever less steeply: up to a horizon the own one stays
 * below its tangent, another above its chord. */
ED_INLINE double safe_strain(const ed_menegotto_pinto *law, const evaluations *list, int here, int there, const branches *stack, int i,
                             int count, double direction, double strain, double step, double stress, double tangent)
{
  if (count == 0)
    return direction * FAR;
  double now[DEPTH], ignored, safe = 0.0;
  for (int k = 0; k < count; k++)
    stack_response(law, list, here, stack, k, i, strain, &now[k], &ignored);
  for (int h = 0; h < HORIZONS; h++) {
    const double horizon = HORIZON[h] * fabs(step), ahead = strain + direction * horizon;
    double reach = horizon;
    for (int k = 0; k < count; k++) {
      double then;
      stack_response(law, list, there + h * count, stack, k, i, ahead, &then, &ignored);
      const double gap = direction * (now[k] - stress), gain = tangent - direction * (then - now[k]) / horizon;
      if (gap < gain * reach)
        reach = gap / gain;
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
  double *fields = state + fields_at(i);
  ed_lanes strain, stress, span, exponent, straight;
  reversal_branch(law, fields, i, &strain, &stress, &span, &exponent);
  straight_length(&span, &exponent, &straight);
  for (; reversed; reversed &= reversed - 1) {
    const int k = __builtin_ctz((unsigned)reversed);
    double *at = fields + k;
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
    at[AT(FROM_STRAIN)] = strain[k];
    at[AT(FROM_STRESS)] = stress[k];
    at[AT(SPAN)] = span[k];
    at[AT(EXPONENT)] = exponent[k];
    at[AT(STRAIGHT)] = straight[k];
    at[AT(SAFE)] = span[k] > 0.0 ? FAR : -FAR;
  }
}

/* Fibres that meet, or may soon meet, a remembered branch; `resumed`: of each group, as bits, those that go on along one. */
ED_INLINE void update_bounds(const ed_menegotto_pinto *law, double *state, int first, const double *strain, chunk *a, const double *stress,
                             const double *tangent, int *resumed)
{
  memset(resumed, 0, (size_t)a->groups * sizeof *resumed);
  int listed[CHUNK], count[CHUNK];
  evaluations *list = &a->list;
  const int before = list->count;
  for (int j = 0; j < a->bounded_count; j++) {
    const bounded_fibre *q = &a->bounded[j];
    double *at = state + q->fields;
    const branches *stack = stack_of(state, q);
    count[j] = q->ahead;
    if (q->governs >= 0) { /* back on a curve that was left; nothing remains of the reversals inside it */
      count[j] = q->governs;
      at[AT(FROM_STRAIN)] = stack->strain[q->governs];
      at[AT(FROM_STRESS)] = stack->stress[q->governs];
      at[AT(SPAN)] = stack->span[q->governs];
      at[AT(EXPONENT)] = stack->exponent[q->governs];
      at[AT(STRAIGHT)] = 0.0; /* where branches meet they curve, or set_lengths says better */
      resumed[q->fibre / ED_LANE_WIDTH] |= 1 << q->fibre % ED_LANE_WIDTH;
    }
    at[AT(AHEAD)] = count[j];
    const double to = strain[q->fibre], step = fabs(to - at[AT(STRAIN)]);
    listed[j] = list->count;
    for (int h = 0; h < HORIZONS; h++)
      list_stack(list, stack, count[j], to + q->direction * HORIZON[h] * step);
  }
  evaluate(list, before);
  for (int j = 0; j < a->bounded_count; j++) {
    const bounded_fibre *q = &a->bounded[j];
    double *at = state + q->fields;
    at[AT(SAFE)] = safe_strain(law, list, q->there, listed[j], stack_of(state, q), first + q->fibre, count[j], q->direction, strain[q->fibre],
                               strain[q->fibre] - at[AT(STRAIN)], stress[q->fibre], tangent[q->fibre]);
  }
}

/* Moves one chunk of fibres. */
ED_INLINE void commit_chunk(const ed_menegotto_pinto *law, double *state, int first, int count, const double *strain, double *stress,
                            double *dissipated)
{
  double *const fields = state + fields_at(first), tangent[CHUNK];
  int resumed[CHUNK / ED_LANE_WIDTH];
  chunk a;
  find_branches(law, state, first, count, strain, 1, &a);
  for (int g = 0; g < a.groups; g++)
    if (a.group[g].place >= 0)
      follow_branch(law, first + g * ED_LANE_WIDTH, &a.group[g], &a.list, stress + g * ED_LANE_WIDTH, tangent + g * ED_LANE_WIDTH);
  bound(law, state, first, strain, &a, stress, tangent, NULL);
  for (int g = 0; g < a.groups; g++)
    if (a.group[g].marks & ALL * REVERSES)
      reverse(law, state, first + g * ED_LANE_WIDTH, a.group[g].marks / REVERSES & ALL);
  update_bounds(law, state, first, strain, &a, stress, tangent, resumed);
  for (int g = 0; g < a.groups; g++) {
    double *at = fields + g * GROUP;
    const int i = g * ED_LANE_WIDTH, turned = a.group[g].marks / REVERSES & ALL;
    if ((turned | resumed[g]) && !law->plain_turns) {
      const ed_mask bit = {1, 2, 4, 8}, none = {0}, begun = (bit & turned) != none, going_on = (bit & resumed[g]) != none;
      set_lengths(law, at, first + i, &begun, &going_on);
    }
    const ed_lanes strains = ED_LOAD(strain + i), before = ED_LOAD(at + AT(STRAIN));
    const ed_lanes stresses = ED_LOAD(stress + i), stress_before = ED_LOAD(at + AT(STRESS));
    /* trapezoid, less what is stored */
    const ed_lanes work = 0.5 * (stress_before + stresses) * (strains - before);
    const ed_lanes stored = 0.5 * (stresses * stresses - stress_before * stress_before) / ED_LOAD(law->E + first + i);
    ED_STORE(dissipated + i, work - stored);
    const ed_lanes largest = ED_LOAD(at + AT(LARGEST)), least = ED_LOAD(at + AT(LEAST));
    const ed_lanes zero = {0}, span = ED_LOAD(at + AT(SPAN)), furthest = ED_LOAD(at + AT(FURTHEST));
    const ed_lanes ahead = ED_SELECT(span > zero, strains - furthest, furthest - strains);
    ED_STORE(at + AT(FURTHEST), ED_SELECT(ahead < zero, furthest, strains));
    ED_STORE(at + AT(STRAIN), strains);
    ED_STORE(at + AT(STRESS), stresses);
    ED_STORE(at + AT(LARGEST), ED_SELECT(strains > largest, strains, largest));
    ED_STORE(at + AT(LEAST), ED_SELECT(strains < least, strains, least));
  }
}

ED_CLONES void ed_menegotto_pinto_commit(const ed_menegotto_pinto *law, double *state, int first, int count, const double *strain,
                                         double *stress, double *dissipated)
{
  for (int from = 0; from < count; from += CHUNK)
    commit_chunk(law, state, first + from, count - from < CHUNK ? count - from : CHUNK, strain + from, stress + from, dissipated + from);
}
