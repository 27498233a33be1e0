/* Sections for tests. */
#ifndef SECTIONS_H
#define SECTIONS_H

#include "section/section.h"

enum { MOST_FIBRES = 64, MOST_SECTION_STATE = MOST_FIBRES * (1 + ED_MENEGOTTO_PINTO_STATE) };

/* Layers of an I section of three plates (m): n in a flange, n in the web, each of n_across equal fibres; the
 * materials of flanges and web. Returns the number of fibres; arrays for MOST_FIBRES. */
int i_section_fibres(int n, int n_across, int flange, int web, double *y, double *area, int *material);

/* The sum over the layers by the scalar law, fibre by fibre as given: the reference for the kernels. */
ed_section_response sum_of_fibres(int n, const double *y, const double *area, const int *material,
                                  const ed_steel *steels, const double plastic[], double e0, double kappa);

#endif
