/* Before an analysis: mechanisms and loose nodes are named, ties and supports number the equations, the matrix is that
 * of the structure. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ed_model *beam_line(int nodes, double EA, double EI)
{
  ed_model *model = ed_model_new(2);
  static const char *const names[] = {"left", "middle", "right", "end"};
  ed_model_elastic_section(model, (double[]){EA, EI});
  for (int i = 0; i < nodes; i++) {
    ed_model_node(model, names[i], (double[]){3.0 * i, 0.0});
    if (i > 0)
      ed_model_elastic_beam(model, names[i], i - 1, i, 0, ED_LINEAR, NULL, NULL);
  }
  return model;
}

static void refused(ed_model *model, int expected, const char *first, const char *second)
{
  int status = ED_OK;
  char message[512] = "";
  ed_analysis *analysis = ed_analysis_new(model, &status, message, sizeof message);
  CHECK(!analysis);
  CHECK_STATUS(status, expected);
  CHECK_CONTAINS(message, first);
  CHECK_CONTAINS(message, second);
  ed_analysis_free(analysis);
  char tiny[8] = "";
  analysis = ed_analysis_new(model, &status, tiny, sizeof tiny); /* a small buffer is not overrun */
  CHECK(!analysis && strlen(tiny) < sizeof tiny);
  ed_model_free(model);
}

static void check_refusals(void)
{
  ed_model *model = beam_line(3, 1e9, 1e8);
  refused(model, ED_E_DISCONNECTED, "left", "right"); /* no support at all */

  model = beam_line(3, 1e9, 1e8);
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_node(model, "alone", (double[]){50.0, 0.0});
  refused(model, ED_E_DISCONNECTED, "alone", "1 node");

  model = beam_line(3, 1e9, 1e8);
  ed_model_fix(model, 0, (int[]){0, 1, 0});
  ed_model_fix(model, 2, (int[]){0, 1, 0});
  refused(model, ED_E_MECHANISM, "middle.ux", "mechanism"); /* rolls away */

  model = beam_line(3, 1e9, 1e8);
  ed_model_fix(model, 0, (int[]){1, 1, 0});
  refused(model, ED_E_MECHANISM, "right.uy", "mechanism"); /* turns about its hinge */

  model = beam_line(2, 1e9, 1e8);
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_node(model, "tip", (double[]){6.0, 0.0});
  ed_model_elastic_beam(model, "hinged", 1, 2, 0, ED_LINEAR, (int[]){1, 1}, NULL);
  refused(model, ED_E_MECHANISM, "tip.", "mechanism");

  model = beam_line(2, 1e9, 1e8);
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_fix(model, 1, (int[]){1, 1, 1});
  refused(model, ED_E_EMPTY, "free", "");

  refused(ed_model_new(2), ED_E_EMPTY, "", "");
}

static void check_ties(void)
{
  const frame_options o = {.bays = 2, .storeys = 2, .points = 4};
  ed_model *model = frame_model(o);
  for (int floor = 1; floor <= 2; floor++)
    for (int line = 1; line <= 2; line++) /* in a chain: C to B to A */
      CHECK_STATUS(ed_model_tie(model, frame_node(o, line, floor), frame_node(o, line - 1, floor), (int[]){1, 0, 0}), ED_OK);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_INT(ed_n_equations(analysis), 2 * (1 + 3 * 2));
  int equation[27];
  double mass[14];
  ed_equations(analysis, equation);
  ed_mass(analysis, mass);
  for (int line = 0; line <= 2; line++) {
    CHECK_INT(equation[3 * frame_node(o, line, 0) + 2], -1);
    CHECK_INT(equation[3 * frame_node(o, line, 1)], equation[3 * frame_node(o, 0, 1)]);
    CHECK(line == 0 || equation[3 * frame_node(o, line, 1) + 1] != equation[3 * frame_node(o, 0, 1) + 1]);
  }
  CHECK(mass[equation[3 * frame_node(o, 0, 1)]] == 3.0 * 20e3); /* masses of one degree add up */
  CHECK(mass[equation[3 * frame_node(o, 0, 1) + 1]] == 20e3);
  /* line A is loaded; C moves with it exactly */
  const int a = add_channel(analysis, ED_DISPLACEMENT, frame_node(o, 0, 2), 0);
  const int c = add_channel(analysis, ED_DISPLACEMENT, frame_node(o, 2, 2), 0);
  double maximum[2], minimum[2], when[2], last[2];
  CHECK_STATUS(ed_static_begin(analysis, LATERAL, 1.0, 1), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 1), ED_OK);
  ed_extremes(analysis, maximum, when, minimum, when, last);
  CHECK(last[a] > 0.0 && last[a] == last[c]);
  ed_analysis_free(analysis);

  /* a support at a tied node supports all of them */
  ed_model_free(model);
  model = frame_model(o);
  ed_model_tie(model, frame_node(o, 1, 1), frame_node(o, 0, 1), (int[]){1, 0, 0});
  ed_model_fix(model, frame_node(o, 1, 1), (int[]){1, 0, 0});
  analysis = frame_analysis(model);
  ed_equations(analysis, equation);
  CHECK_INT(equation[3 * frame_node(o, 0, 1)], -1);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Cantilever of two elastic beams: the matrix handed out is symmetric, and K u = f gives P L^3 / 3 E I. */
static void check_matrix(void)
{
  const double EI = 1e8, L = 6.0;
  ed_model *model = beam_line(3, 1e9, EI);
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_analysis *analysis = frame_analysis(model);
  const int n = ed_n_equations(analysis), nnz = ed_n_nonzeros(analysis);
  CHECK_INT(n, 6);
  int *start = malloc(((size_t)n + 1) * sizeof *start), *row = malloc((size_t)nnz * sizeof *row), equation[9];
  double *value = malloc((size_t)nnz * sizeof *value), u[6] = {0}, f[6] = {0}, K[6][6] = {{0}};
  CHECK_STATUS(ed_stiffness(analysis, start, row, value), ED_OK);
  ed_equations(analysis, equation);
  CHECK_INT(start[n], nnz);
  for (int j = 0; j < n; j++)
    for (int k = start[j]; k < start[j + 1]; k++) {
      CHECK(k == start[j] || row[k] > row[k - 1]);
      K[row[k]][j] = value[k];
    }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      CHECK_NEAR(K[i][j], K[j][i], 1e-9 * EI);
  /* u(x) = P x^2 (3 L - x) / 6 E I under P = 1 at the end */
  for (int i = 1; i <= 2; i++) {
    const double x = 3.0 * i;
    u[equation[3 * i + 1]] = x * x * (3.0 * L - x) / (6.0 * EI);
    u[equation[3 * i + 2]] = x * (2.0 * L - x) / (2.0 * EI);
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      f[i] += K[i][j] * u[j];
  for (int i = 0; i < n; i++)
    CHECK_NEAR(f[i], i == equation[7] ? 1.0 : 0.0, 1e-12);
  free(start);
  free(row);
  free(value);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  check_refusals();
  check_ties();
  check_matrix();
  ed_analysis_free(NULL);
  return checks_end("structure");
}
