/* The elements of the structure at the trial state, and the forces over all its degrees. */
#ifndef ED_MEMBERS_H
#define ED_MEMBERS_H

#include "element/element.h"

typedef struct {
  ed_element *element;           /* n_members */
  int n_struts;                  /* among them */
  double *displacement;          /* over all degrees, at the trial state */
  double *resisting;             /* over all degrees, at the trial state */
  double *force;                 /* of a member its degrees, along the axes of the structure */
  ed_element_control control;
  int failed;                    /* member whose state was not found */
} ed_members;

int ed_members_allocate(ed_analysis *a);
void ed_members_free(ed_members *members, int n);
int ed_update_elements(ed_analysis *a); /* trial u, v -> states of elements and dampers, resisting forces */
int ed_update_members(ed_analysis *a);  /* the same, dampers are there already */
void ed_collect_forces(ed_analysis *a); /* element states -> resisting forces */

/* Where the forces of a member lie. */
static inline double *ed_member_force(const ed_members *members, int member)
{
  return members->force + members->element[member].degrees * member;
}

/* Displacements of a member's ends, of those over all degrees; `degrees` are those of both ends. */
ED_INLINE void ed_gather_some(const ed_members *members, int member, double *d, const int degrees)
{
  const ed_element *e = &members->element[member];
  for (int i = 0; i < degrees; i++)
    d[i] = members->displacement[e->dof[i]];
}

static inline void ed_gather(const ed_members *members, int member, double *d)
{
  if (members->element[member].degrees == 6)
    ed_gather_some(members, member, d, 6);
  else
    ed_gather_some(members, member, d, ED_MAX_DEGREES);
}

#endif
