/* Pattern and values of the matrix; factors; between nodes and equations. */
#include "space/space.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMED = 8 }; /* degrees in a message */

/* A pivot below this share of its diagonal term has lost all but some four digits to rounding: a degree meets no resistance. */
static const double VANISHING = 1e-12;

static int compare_ints(const void *a, const void *b)
{
  return *(const int *)a - *(const int *)b;
}

static const int *equations(const ed_space *s, int m, int end)
{
  return s->node[s->member[m].node[end]].equation;
}

/* Counts (`row` NULL) or writes that two equations meet in the matrix. */
static void couple(int column, int other, int *next, int *row)
{
  if (column < 0 || other < 0)
    return;
  if (row)
    row[next[column]] = other;
  next[column]++;
}

static void couple_all(const ed_space *s, int *next, int *row)
{
  for (int m = 0; m < s->n_members; m++) /* first, as place_members relies on */
    for (int i = 0; i < 12; i++)
      for (int j = 0; j < 12; j++)
        couple(equations(s, m, i / 6)[i % 6], equations(s, m, j / 6)[j % 6], next, row);
  for (int i = 0; i < s->n; i++)
    couple(i, i, next, row);
  for (int f = 0; f < s->n_floors; f++)
    for (int k = 0; k < 9; k++)
      couple(s->floor[f].equation[k / 3], s->floor[f].equation[k % 3], next, row);
}

static int place_of(const ed_space *s, int row, int column)
{
  if (row < 0 || column < 0)
    return s->nnz;
  const int *first = s->row + s->column_start[column];
  const int *found = bsearch(&row, first, (size_t)(s->column_start[column + 1] - s->column_start[column]), sizeof *first, compare_ints);
  return found ? (int)(found - s->row) : s->nnz;
}

static void add_spring(ed_space *s, int a, int b, double value)
{
  s->spring_place[s->n_springs] = place_of(s, a, b);
  s->spring_value[s->n_springs++] = value;
}

static int place_springs(ed_space *s)
{
  int count = 0;
  for (int i = 0; i < s->n_nodes; i++)
    for (int d = 0; d < 6; d++)
      count += s->node[i].spring[d] > 0.0;
  s->spring_place = malloc((4 * (size_t)count + 1) * sizeof *s->spring_place);
  s->spring_value = malloc((4 * (size_t)count + 1) * sizeof *s->spring_value);
  if (!s->spring_place || !s->spring_value)
    return ED_E_MEMORY;
  for (int i = 0; i < s->n_nodes; i++) {
    const ed_space_node *node = &s->node[i];
    for (int d = 0; d < 6; d++) {
      const double k = node->spring[d], arm = d == 0 ? -node->dy : node->dx;
      if (!(k > 0.0))
        continue;
      add_spring(s, node->equation[d], node->equation[d], k);
      if (node->floor >= 0 && d < 2) {
        add_spring(s, node->equation[d], node->equation[5], arm * k);
        add_spring(s, node->equation[5], node->equation[d], arm * k);
        add_spring(s, node->equation[5], node->equation[5], arm * arm * k);
      }
    }
  }
  return ED_OK;
}

/* Makes of counts the places where lists of that length begin. */
static int begin_lists(int n, int *start)
{
  long total = 0;
  for (int i = 0; i <= n && total <= INT_MAX; i++) {
    const int count = start[i];
    start[i] = (int)total;
    total += count;
  }
  return total <= INT_MAX;
}

/* Counts (`row` NULL) or writes the rows of each column, each once. The columns that an equation meets are its own rows, so that going
 * through them equation by equation gives all columns their rows in rising order. When written, each `met` becomes the place of its term. */
static void list_rows(const ed_space *s, const int *first, int *met, int *last, int *next, int *row)
{
  for (int i = 0; i < s->n; i++)
    last[i] = -1;
  for (int i = 0; i < s->n; i++)
    for (int k = first[i]; k < first[i + 1]; k++) {
      const int column = met[k];
      if (last[column] != i)
        couple(column, i, next, row);
      last[column] = i;
      if (row)
        met[k] = next[column] - 1;
    }
}

/* The terms of members come in the order of couple_all. */
static void place_members(ed_space *s, int *next, const int *met)
{
  int *place = s->place;
  for (int m = 0; m < s->n_members; m++)
    for (int i = 0; i < 12; i++)
      for (int j = 0; j < 12; j++) {
        const int row = equations(s, m, i / 6)[i % 6], column = equations(s, m, j / 6)[j % 6];
        *place++ = row < 0 || column < 0 ? s->nnz : met[next[row]++];
      }
}

static int make_pattern(ed_space *s, int *first, int *next, int *last)
{
  couple_all(s, first, NULL);
  int *met = begin_lists(s->n, first) ? malloc(((size_t)first[s->n] + 1) * sizeof *met) : NULL; /* else too many for their numbers */
  if (!met)
    return ED_E_MEMORY;
  memcpy(next, first, (size_t)s->n * sizeof *next);
  couple_all(s, next, met);
  list_rows(s, first, met, last, s->column_start, NULL);
  begin_lists(s->n, s->column_start);
  s->nnz = s->column_start[s->n];
  s->row = malloc(((size_t)s->nnz + 1) * sizeof *s->row);
  s->place = malloc((size_t)s->n_members * ED_SPACE_PLACES * sizeof *s->place);
  if (s->row && s->place) {
    memcpy(next, s->column_start, (size_t)s->n * sizeof *next);
    list_rows(s, first, met, last, next, s->row);
    place_members(s, first, met);
  }
  free(met);
  return s->row && s->place ? ED_OK : ED_E_MEMORY;
}

static int is_rotation(const ed_space *s, int equation)
{
  const int degree = s->name[equation], of_masters = degree - 6 * s->n_nodes;
  return of_masters >= 0 ? of_masters % 3 == 2 : degree % 6 >= 3;
}

int ed_space_build_pattern(ed_space *s)
{
  const size_t n = (size_t)s->n;
  s->column_start = calloc(n + 1, sizeof *s->column_start);
  s->diagonal = calloc(n, sizeof *s->diagonal);
  s->scale = calloc(n, sizeof *s->scale);
  s->work = calloc(n, sizeof *s->work);
  int *room = calloc(3 * n + 1, sizeof *room), status = ED_E_MEMORY;
  if (room && s->column_start && s->diagonal && s->scale && s->work)
    status = make_pattern(s, room, room + n + 1, room + 2 * n + 1);
  free(room);
  if (status != ED_OK)
    return status;
  s->matrix = malloc(((size_t)s->nnz + 1) * sizeof *s->matrix);
  if (!s->matrix)
    return ED_E_MEMORY;
  for (int i = 0; i < s->n; i++) {
    s->diagonal[i] = place_of(s, i, i);
    s->scale[i] = is_rotation(s, i) ? 1.0 / s->length : 1.0;
  }
  int of_floors = 0;
  for (int f = 0; f < s->n_floors; f++)
    for (int k = 0; k < 3; k++)
      of_floors += s->floor[f].equation[k] >= 0;
  s->factors = ed_cholesky_new(s->n, of_floors, s->column_start, s->row, s->diagonal);
  return s->factors ? place_springs(s) : ED_E_MEMORY;
}

/* Displacements of a node of a floor: ux = Ux - dy Rz, uy = Uy + dx Rz, rz = Rz. */
static void follow_master(const ed_space_node *node, int end, double *matrix)
{
  if (node->floor < 0)
    return;
  const int at = 6 * end;
  for (int i = 0; i < 12; i++)
    matrix[12 * i + at + 5] += node->dx * matrix[12 * i + at + 1] - node->dy * matrix[12 * i + at];
  for (int j = 0; j < 12; j++)
    matrix[12 * (at + 5) + j] += node->dx * matrix[12 * (at + 1) + j] - node->dy * matrix[12 * at + j];
}

void ed_space_assemble(ed_space *s, int springs, double *result)
{
  memset(result, 0, ((size_t)s->nnz + 1) * sizeof *result);
  for (int m = 0; m < s->n_members; m++) {
    const ed_space_node *start = &s->node[s->member[m].node[0]], *end = &s->node[s->member[m].node[1]];
    const int *place = s->place + (size_t)ED_SPACE_PLACES * (size_t)m;
    double matrix[144];
    ed_member_matrix(&s->member[m], &s->stiffness[m], matrix);
    for (int i = 0; i < 12; i++)
      for (int j = 0; j < i; j++)
        matrix[12 * j + i] = matrix[12 * i + j];
    follow_master(start, 0, matrix);
    follow_master(end, 1, matrix);
    for (int i = 0; i < ED_SPACE_PLACES; i++) /* adds up where both ends follow one master */
      result[place[i]] += matrix[i];
  }
  for (int i = 0; springs && i < s->n_springs; i++)
    result[s->spring_place[i]] += s->spring_value[i];
  result[s->nnz] = 0.0;
}

/* As of plane frames (system/check.c). */
static const double STIFFENING = 1e-9, STIFFENING_OF_NONE = 1e-18;

/* The degrees that move most in the softest motion, by inverse iteration on a slightly stiffened matrix. */
static void name_mechanism(ed_space *s, char *buffer, size_t size)
{
  double *x = s->work, largest = 0.0;
  int moving = 0;
  for (int i = 0; i < s->n; i++)
    largest = fmax(largest, s->matrix[s->diagonal[i]] * s->scale[i] * s->scale[i]);
  for (int i = 0; i < s->n; i++) { /* degrees without any stiffness get some */
    s->matrix[s->diagonal[i]] += STIFFENING * s->matrix[s->diagonal[i]] + STIFFENING_OF_NONE * largest / (s->scale[i] * s->scale[i]);
    x[i] = (1.0 + 0.1 * ((i * 7L) % 11)) * s->scale[i];
  }
  if (ed_cholesky_factor(s->factors, s->matrix) != ED_OK)
    return;
  for (int iteration = 0; iteration < 6; iteration++) {
    if (ed_cholesky_solve(s->factors, x, 1) != ED_OK)
      return;
    largest = 0.0;
    for (int i = 0; i < s->n; i++)
      largest = fmax(largest, fabs(x[i]) / s->scale[i]);
    for (int i = 0; largest > 0.0 && i < s->n; i++)
      x[i] /= largest;
  }
  for (int i = 0; i < s->n; i++) {
    char name[2 * ED_SPACE_NAME];
    if (fabs(x[i]) / s->scale[i] < 0.5)
      continue;
    const size_t used = strlen(buffer);
    if (moving++ < NAMED)
      snprintf(buffer + used, size - used, "%s%s", moving > 1 ? ", " : "", ed_space_degree_name(s, i, name, sizeof name));
  }
  const size_t used = strlen(buffer);
  if (moving > NAMED)
    snprintf(buffer + used, size - used, " and %d more", moving - NAMED);
}

int ed_space_factor(ed_space *s)
{
  for (int m = 0; m < s->n_members; m++)
    s->stiffness[m] = s->member[m].stiffness;
  ed_space_assemble(s, 1, s->matrix);
  for (int k = 0; k < s->nnz; k++)
    if (!isfinite(s->matrix[k]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "the stiffness of the frame is not a finite number");
  if (ed_cholesky_factor(s->factors, s->matrix) == ED_OK && ed_cholesky_pivot_ratio(s->factors) > VANISHING)
    return ED_OK;
  char names[NAMED * (2 * ED_SPACE_NAME + 2) + 40] = "";
  name_mechanism(s, names, sizeof names);
  return ed_space_fail(s, ED_E_MECHANISM, "the frame is a mechanism; it moves freely at %s", names);
}

int ed_space_n_nonzeros(const ed_space *space)
{
  return space->nnz;
}

void ed_space_reduce(const ed_space *s, const double *nodal, double *right_side)
{
  memset(right_side, 0, (size_t)s->n * sizeof *right_side);
  for (int i = 0; i < s->n_nodes; i++) {
    const ed_space_node *node = &s->node[i];
    const double *force = nodal + 6 * (size_t)i;
    for (int d = 0; d < 6; d++)
      if (node->equation[d] >= 0)
        right_side[node->equation[d]] += force[d];
    if (node->floor >= 0 && node->equation[5] >= 0)
      right_side[node->equation[5]] += node->dx * force[1] - node->dy * force[0];
  }
}

void ed_space_spread(const ed_space *s, const double *solution, double *displacements)
{
  for (int i = 0; i < s->n_nodes; i++) {
    const ed_space_node *node = &s->node[i];
    double *u = displacements + 6 * (size_t)i;
    for (int d = 0; d < 6; d++)
      u[d] = node->equation[d] >= 0 ? solution[node->equation[d]] : 0.0;
    if (node->floor >= 0) {
      u[0] -= node->dy * u[5];
      u[1] += node->dx * u[5];
    }
  }
}
