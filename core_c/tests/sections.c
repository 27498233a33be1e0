#include "sections.h"

int i_section_fibres(int n, int n_across, int flange, int web, double *y, double *area, int *material)
{
  static const double height = 0.45, width = 0.19, t_flange = 0.0146, t_web = 0.0094;
  const double clear = height - 2.0 * t_flange;
  int count = 0;
  for (int i = 0; i < 3 * n; i++) {
    const int part = i / n;
    const double share = (i % n + 0.5) / n;
    const double depth = part == 0   ? -0.5 * height + share * t_flange
                         : part == 1 ? (share - 0.5) * clear
                                     : 0.5 * height - t_flange + share * t_flange;
    for (int k = 0; k < n_across; k++) {
      y[count] = depth;
      area[count] = (part == 1 ? t_web * clear : width * t_flange) / (n * n_across);
      material[count++] = part == 1 ? web : flange;
    }
  }
  return count;
}

ed_section_response sum_of_fibres(int n, const double *y, const double *area, const int *material,
                                  const ed_steel *steels, const double plastic[], double e0, double kappa)
{
  ed_section_response r = {.elastic = 1};
  for (int i = 0; i < n; i++) {
    double stress, tangent;
    r.elastic &= ed_steel_trial(&steels[material[i]], &plastic[i], e0 - kappa * y[i], &stress, &tangent);
    r.force[0] += area[i] * stress;
    r.force[1] -= area[i] * y[i] * stress;
    r.k[0] += area[i] * tangent;
    r.k[1] -= area[i] * y[i] * tangent;
    r.k[2] += area[i] * y[i] * y[i] * tangent;
  }
  return r;
}
