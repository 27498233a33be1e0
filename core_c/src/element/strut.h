/* A brace that buckles: one element of the frame, and inside it a chain of corotational force-based fibre beams of one half of the
 * brace, symmetric about the middle. Its ends stay on the chord. Statics condense it to N(elongation). */
#ifndef ED_STRUT_H
#define ED_STRUT_H

#include "element/element.h"

enum {
  ED_STRUT_MAX_ELEMENTS = 16,
  ED_STRUT_MAX_UNKNOWNS = 3 * (ED_STRUT_MAX_ELEMENTS / 2) + 1,
  ED_STRUT_MAX_PARTS = ED_STRUT_MAX_ELEMENTS / 2 + 1
};

/* NULL: out of memory. */
ed_strut *ed_strut_new(const ed_model *model, const ed_member *member, double length);
void ed_strut_free(ed_strut *strut);

int ed_strut_finite(const ed_strut *strut);
int ed_strut_block_size(const ed_strut *strut);
int ed_strut_layer_size(const ed_strut *strut);
int ed_strut_record_size(const ed_strut *strut);
void ed_strut_place_records(ed_strut *strut, double *records);
void ed_strut_initialise(ed_strut *strut, double *block, double *layers);
int ed_strut_layers_valid(const ed_strut *strut, const double *layers);

/* Finds the force and the tangent of the block for an elongation, from the committed shape. */
int ed_strut_update(const ed_strut *strut, double elongation, const double *layers, double *block, ed_element_control *control);
double ed_strut_commit(const ed_strut *strut, double *block, double *layers);
double ed_strut_stored(const ed_strut *strut, const double *block, const double *layers);

/* Largest damage of a fibre, and largest share of a section that has broken. */
double ed_strut_damage(const ed_strut *strut, const double *layers);
double ed_strut_broken_share(const ed_strut *strut, const double *layers);
/* Distance of the middle from the chord, camber included. */
double ed_strut_deflection(const ed_strut *strut, const double *block);

#endif
