/* Load control and displacement control of small structures against closed forms: cantilever, reactions, plastic
 * collapse of a portal, paths in both directions; energies add up. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"
#include "numbers.h"
#include "sections.h"

#include <math.h>
#include <string.h>

static const frame_options PORTAL = {.bays = 1, .storeys = 1, .points = 5};

typedef struct {
  double EI, plastic_moment;
} section_values;

static section_values values_of_section(void)
{
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES];
  const int n = i_section_fibres(4, 1, 0, 0, y, area, material);
  section_values values = {0.0, 0.0};
  for (int i = 0; i < n; i++) {
    values.EI += 2.1e11 * area[i] * y[i] * y[i];
    values.plastic_moment += 275e6 * area[i] * fabs(y[i]);
  }
  return values;
}

static double last_value(const ed_analysis *analysis, int channel)
{
  double a[16], b[16], c[16], d[16], last[16];
  ed_extremes(analysis, a, b, c, d, last);
  return last[channel];
}

static void check_cantilever(void)
{
  const section_values section = values_of_section();
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES], sections[10] = {0};
  const double steel[] = {2.1e11, 275e6, 0.0}, L = 3.0;
  ed_model *model = ed_model_new(2);
  ed_model_material(model, ED_BILINEAR, 3, steel);
  const int n = i_section_fibres(4, 1, 0, 0, y, area, material);
  ed_model_fibre_section(model, n, y, NULL, area, material, 0.0);
  ed_model_node(model, "base", (double[]){0.0, 0.0});
  ed_model_node(model, "tip", (double[]){L, 0.0});
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_beam_column(model, "beam", 0, 1, 5, sections, ED_LINEAR, NULL, NULL);
  const int load = ed_model_pattern(model);
  ed_model_nodal_load(model, load, 1, (double[]){0.0, -1.0, 0.0});
  ed_analysis *analysis = frame_analysis(model);
  const int tip = add_channel(analysis, ED_DISPLACEMENT, 1, 1), shear = add_channel(analysis, ED_REACTION, 0, 1);
  const int moment = add_channel(analysis, ED_REACTION, 0, 2), factor = add_channel(analysis, ED_LOAD_FACTOR, load, 0);
  const double elastic = 10e3, collapse = section.plastic_moment / L;
  CHECK_STATUS(ed_static_begin(analysis, load, elastic, 1), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 1), ED_OK);
  CHECK_NEAR(last_value(analysis, tip), -elastic * L * L * L / (3.0 * section.EI), 1e-6 * 1e-3);
  CHECK_NEAR(last_value(analysis, shear), elastic, 1e-6 * elastic);
  CHECK_NEAR(last_value(analysis, moment), elastic * L, 1e-6 * elastic * L);
  CHECK(last_value(analysis, factor) == elastic);
  /* up to the plastic moment, and not beyond */
  CHECK_STATUS(ed_static_begin(analysis, load, 0.999 * collapse, 20), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 20), ED_OK);
  CHECK_NEAR(last_value(analysis, moment), 0.999 * section.plastic_moment, 1e-5 * section.plastic_moment);
  CHECK_STATUS(ed_static_begin(analysis, load, 1.002 * collapse, 1), ED_OK);
  CHECK(ed_run_advance(analysis, 1) < 0);
  CHECK_CONTAINS(ed_analysis_message(analysis), "step 1");
  CHECK_CONTAINS(ed_analysis_message(analysis), "pushover");
  ed_run_end(analysis);
  /* unloads elastically */
  const double before = last_value(analysis, tip);
  CHECK_STATUS(ed_static_begin(analysis, load, 0.0, 4), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 4), ED_OK);
  CHECK_NEAR(last_value(analysis, tip) - before, 0.999 * collapse * L * L * L / (3.0 * section.EI), 1e-4 * 0.1);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

static void check_gravity(int geometry)
{
  const frame_options o = {.bays = 2, .storeys = 3, .points = 5, .geometry = geometry};
  ed_model *model = frame_model(o);
  ed_analysis *analysis = frame_analysis(model);
  int kind[3], object[3], component[3];
  const double ones[3] = {1.0, 1.0, 1.0};
  for (int i = 0; i < 3; i++) {
    kind[i] = ED_REACTION;
    object[i] = i;
    component[i] = 1;
  }
  const int sum = ed_channel(analysis, 3, ones, kind, object, component, 1);
  double energy[6 * ED_N_ENERGY], values[6], factor[6];
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 5), ED_OK);
  ed_run_buffers(analysis, 1, factor, values, energy);
  CHECK_STATUS(ed_run_advance(analysis, 5), ED_OK);
  CHECK_INT(ed_run_rows(analysis), 6);
  CHECK_INT(ed_run_steps_done(analysis), 5);
  ed_run_end(analysis);
  const double weight = 25e3 * 6.0 * 2 * 3;
  CHECK(values[0] == 0.0 && factor[0] == 0.0 && factor[5] == 1.0);
  CHECK_NEAR(values[5], weight, 1e-6 * weight);
  CHECK_NEAR(last_value(analysis, sum), weight, 1e-6 * weight);
  const double *end = energy + 5 * ED_N_ENERGY;
  CHECK(end[ED_INPUT] > 0.0 && end[ED_HYSTERETIC] == 0.0);
  CHECK_NEAR(end[ED_STORED] + end[ED_GEOMETRIC], end[ED_INPUT], 2e-5 * end[ED_INPUT]);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Side-sway of the portal: four hinges, H h = 4 Mp; axial forces up to 0.12 of the yield force cost
 * 2 per cent of Mp. */
static void check_collapse(double *path, int rows)
{
  const double expected = 4.0 * values_of_section().plastic_moment / 3.5;
  ed_model *model = frame_model(PORTAL);
  ed_analysis *analysis = frame_analysis(model);
  add_channel(analysis, ED_LOAD_FACTOR, LATERAL, 0);
  const int roof = frame_node(PORTAL, 0, 1), shear = add_channel(analysis, ED_DISPLACEMENT, roof, 0);
  double values[2 * 101], displacement[101], energy[101 * ED_N_ENERGY];
  CHECK_STATUS(ed_pushover_begin(analysis, LATERAL, roof, 0, 0.25, 100), ED_OK);
  ed_run_buffers(analysis, 1, displacement, values, energy);
  CHECK_STATUS(run_to_end(analysis, 100), ED_OK);
  for (int i = 0; i <= 100; i++) {
    CHECK_NEAR(displacement[i], 0.0025 * i, 1e-15);
    CHECK_NEAR(values[2 * i + 1], displacement[i], 1e-12);
    CHECK(i == 0 || values[2 * i] > values[2 * i - 2] * (1.0 - 1e-6)); /* no second-order effects: no descent */
    if (i < rows)
      path[i] = values[2 * i];
  }
  CHECK_NEAR(1e3 * values[200], expected, 0.03 * expected);
  CHECK(1e3 * values[200] <= expected * (1.0 + 1e-6)); /* the upper bound theorem */
  CHECK_NEAR(last_value(analysis, shear), 0.25, 1e-12);
  const double *end = energy + 100 * ED_N_ENERGY;
  CHECK(end[ED_HYSTERETIC] > 0.5 * end[ED_INPUT]);
  CHECK_NEAR(end[ED_HYSTERETIC] + end[ED_STORED], end[ED_INPUT], 2e-3 * end[ED_INPUT]); /* trapezoids of 2.5 mm */
  ed_analysis_free(analysis);
  ed_model_free(model);
}

static void check_both_directions(const double *path, int rows)
{
  ed_model *model = frame_model(PORTAL);
  ed_analysis *analysis = frame_analysis(model);
  const int roof = frame_node(PORTAL, 0, 1);
  add_channel(analysis, ED_LOAD_FACTOR, LATERAL, 0);
  double values[101];
  CHECK_STATUS(ed_pushover_begin(analysis, LATERAL, roof, 0, -0.0025 * (rows - 1), rows - 1), ED_OK);
  ed_run_buffers(analysis, 1, NULL, values, NULL);
  CHECK_STATUS(run_to_end(analysis, rows - 1), ED_OK);
  for (int i = 0; i < rows; i++)
    CHECK_NEAR(values[i], -path[i], 1e-4 * path[rows - 1]);
  /* and the load can be taken off: back by displacement to where the load vanishes */
  CHECK_STATUS(ed_static_begin(analysis, LATERAL, 0.0, 5), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 5), ED_OK);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Under gravity P-Delta makes the sway curve descend once the mechanism has formed. */
static void check_descent(void)
{
  frame_options o = PORTAL;
  o.geometry = ED_P_DELTA;
  ed_model *model = frame_model(o);
  const int roof = frame_node(o, 0, 1), dead = ed_model_pattern(model);
  ed_model_nodal_load(model, dead, roof, (double[]){0.0, -300e3, 0.0});
  ed_model_nodal_load(model, dead, roof + 1, (double[]){0.0, -300e3, 0.0});
  ed_analysis *analysis = frame_analysis(model);
  add_channel(analysis, ED_LOAD_FACTOR, LATERAL, 0);
  double values[101];
  CHECK_STATUS(ed_static_begin(analysis, dead, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 2), ED_OK);
  CHECK_STATUS(ed_pushover_begin(analysis, LATERAL, roof, 0, 0.4, 100), ED_OK);
  ed_run_buffers(analysis, 1, NULL, values, NULL);
  CHECK_STATUS(run_to_end(analysis, 100), ED_OK);
  const double peak = largest_of(values, 101);
  CHECK(values[100] < 0.97 * peak);
  /* the slope of the mechanism: the weight over the height */
  CHECK_NEAR(1e3 * (values[100] - values[80]) / 0.08, -600e3 / 3.5, 0.05 * 600e3 / 3.5);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  double path[81];
  check_cantilever();
  check_gravity(ED_LINEAR);
  check_gravity(ED_P_DELTA);
  check_gravity(ED_COROTATIONAL);
  check_collapse(path, 81);
  check_both_directions(path, 81);
  check_descent();
  return checks_end("static analyses");
}
