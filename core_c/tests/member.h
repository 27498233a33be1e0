/* One member between two nodes, outside any analysis: its element, block and layers. */
#ifndef MEMBER_H
#define MEMBER_H

#include "element/element.h"

/* bilinear with b 0, bilinear with b 0.02, Menegotto-Pinto */
typedef enum { PLASTIC, HARDENING, CURVED, STEEL_KINDS } steel_kind;

typedef struct {
  ed_element_kind kind;
  int geometry, points;
  steel_kind steel;
  int release[2];
  double rigid[2]; /* lengths of rigid ends */
} member_options;

typedef struct {
  ed_model *model;
  ed_element e;
  ed_element_control control;
  double *block, *layers;
} member;

/* Length 4 m, 30 degrees above global x; an I section (depth 0.45 m) whose upper flange is the larger. */
member member_new(member_options options);
void member_free(member *m);
/* wx, wy over the length and px, py at 0.3 of it. */
void member_load(member *m, double wx, double wy, double px, double py);
int member_update(member *m, const double *displacement);
/* Displacements of a rigid turn of the member and small deformations drawn around it. */
void draw_displacement(const member *m, double turn, double size, unsigned long long seed, double *displacement);
/* Bending moment of the section when every layer has yielded without axial force in a symmetric section. */
double member_plastic_moment(const member *m, int point);

#endif
