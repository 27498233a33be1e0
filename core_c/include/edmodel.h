/* Models of frames in a plane or in space: materials, sections, nodes, members, dampers and loads. Each call that adds returns the id of what
 * it added, or an ed_status below zero; ed_model_message then says why, and the model is as before.
 *
 * In a plane: x to the right, y upwards; degrees of a node 0 ux, 1 uy, 2 rz. In space: x, y horizontal, z upwards; 0 ux, 1 uy, 2 uz, 3 rx, 4 ry,
 * 5 rz, right-handed. Arrays over degrees have 3 or 6 numbers, positions 2 or 3. Local x of a member runs from i to j. In a plane local y is
 * across, to the left of it; in space local z is the direction of the web and local y completes a right-handed system. */
#ifndef EDMODEL_H
#define EDMODEL_H

#include "edstatus.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ed_model ed_model;

ed_model *ed_model_new(int dimension); /* 2 or 3; NULL: out of memory */
void ed_model_free(ed_model *model);
const char *ed_model_message(const ed_model *model); /* the last error, for people */

/* Uniaxial laws. Parameters: ELASTIC E; BILINEAR E, fy, b (kinematic hardening ratio, 0 <= b < 1);
 * MENEGOTTO_PINTO E, fy, b, R0, cR1, cR2. */
enum { ED_ELASTIC = 0, ED_BILINEAR = 1, ED_MENEGOTTO_PINTO = 2 };
int ed_model_material(ed_model *model, int law, int n_parameters, const double *parameters);

/* Fibres of a material break: a cycle of the strain range r does the damage (r / strain)^exponent, cycles counted by rainflow; at a sum
 * of 1 the fibre breaks as soon as it is in tension. Before any section. */
int ed_model_fatigue(ed_model *model, int material, double strain, double exponent);

int ed_model_elastic_section(ed_model *model, const double *stiffness); /* EA, EI; in space EA, EI about z, EI about y, GJ */
/* n fibres at depths y with areas and materials; those of one place and material are merged into one layer. In space at (y, z) along the local
 * axes: the strain is e0 - kappa_z y + kappa_y z, the torsion elastic, GJ, beside it and without warping. Braces (ed_model_strut) take
 * sections in one plane in space too: z NULL. */
int ed_model_fibre_section(ed_model *model, int n, const double *y, const double *z, const double *area, const int *material,
                           double torsion);
/* Such a section with a stress in each fibre before any load, which is below yield. Together they have no force and no moment; all materials are
 * bilinear and do not break. Plastic strains -stress / E leave it, with their back stress. */
int ed_model_stressed_section(ed_model *model, int n, const double *y, const double *z, const double *area, const int *material,
                              const double *stress, double torsion);
int ed_model_section_layers(const ed_model *model, int section); /* layers after merging */

int ed_model_node(ed_model *model, const char *name, const double *position);
int ed_model_fix(ed_model *model, int node, const int *degrees);
int ed_model_tie(ed_model *model, int node, int master, const int *degrees);     /* the node shares the master's degrees */
/* In space: ux, uy and rz of n nodes follow those of the master as a body that is rigid in plan and turns a little. The master stands at the
 * centre of mass of what moves with it; a support of the diaphragm is a support of its master. Before dampers. */
int ed_model_diaphragm(ed_model *model, int master, int n, const int *node);
int ed_model_mass(ed_model *model, int node, const double *mass);                /* over degrees; added to what is there */

enum { ED_LINEAR = 0, ED_P_DELTA = 1, ED_COROTATIONAL = 2 };
/* Force-based fibre beam-column; sections: one id a Gauss-Lobatto point (2..10). release: ends that are free of moment, about z at i and at j,
 * in space then about y at i and at j; NULL: none. web: in space the direction of local z, of length 1 at right angles to the member.
 * Corotational in space: rotations of a node are its rotation vector, and stay below a whole turn. Two points integrate
 * the square of a linear moment wrongly (far too flexible); from three on an elastic prismatic member is exact.
 * A load that begins, ends or stands inside leaves a kink in the moment, which quadrature meets only with a break there. */
int ed_model_beam_column(ed_model *model, const char *name, int i, int j, int points, const int *sections, int geometry,
                         const int *release, const double *web);
/* A beam-column of one section is integrated piece by piece, by its points in each piece, between n positions (0..1, rising) of its length:
 * a kink of the moment at such a place is met exactly. A place between two pieces is one point, with the weight of both. */
int ed_model_breaks(ed_model *model, int element, int n, const double *position);
/* The first and the last part of a beam-column do not bend; lengths. End forces and deformations are then those where it begins to. */
int ed_model_rigid_ends(ed_model *model, int element, double start, double end);
/* In space: what bends of a beam-column begins and ends beside its nodes, as far from them as these vectors in global axes; rigid arms stand
 * between. Its local x runs between these ends; a web that is not at right angles to it is turned until it is. Loads are of the length along
 * local x, with what the arms cover of it towards the nodes; there they stand on the arm. P-Delta turns the arms to the second order. */
int ed_model_offset_ends(ed_model *model, int element, const double *at_i, const double *at_j);
int ed_model_elastic_beam(ed_model *model, const char *name, int i, int j, int section, int geometry, const int *release,
                          const double *web);
int ed_model_truss(ed_model *model, const char *name, int i, int j, int material, double area, int geometry);
/* A brace that buckles between its ends, which stay on its chord. Inside are `elements` (even, 2..16) corotational fibre beams of the
 * section with `points` integration points each (3..10), in a camber of the first mode: its height / buckling length, > 0. The part
 * that buckles is buckling_length (0..1] of the length; the rest is a straight bar of the material and area. end_stiffness: rotational,
 * of each end; 0 pinned, infinite fixed. */
int ed_model_strut(ed_model *model, const char *name, int i, int j, int section, int points, int elements, double camber,
                   double buckling_length, double end_stiffness, int material, double area, int geometry);
/* In a plane: elastic link with stiffnesses along local x, y and in rotation. Two nodes apart: local x runs along the link and shear
 * acts at mid-length; at one place: local x is at `angle` (rad) from global x. */
int ed_model_link(ed_model *model, const char *name, int i, int j, double kx, double ky, double krz, double angle);

/* A spring without length: its deformation is the sum of coefficient * displacement of the degrees of i, then of j, which may be at
 * one place. Laws and their parameters, of force and deformation (or moment and rotation):
 * MULTILINEAR  deformation and force of each corner (0..4), then the last slope: kinematic, Masing's rule; without corners it is linear.
 * CONTACT      stiffness and capacity: forces are negative, up to the capacity, at which it gives way (HUGE_VAL: never).
 * DETERIORATING stiffness; of the positive and the negative side each the deformation from yield to capping, from there to no force, the
 *              ultimate one, the force at yield, force at capping / at yield, residual force / force at yield, D; energies that may be
 *              dissipated until nothing is left of strength, of the line after capping and of the unloading stiffness (HUGE_VAL: no
 *              deterioration); their exponents c. The modified Ibarra-Medina-Krawinkler law with bilinear hysteresis. */
enum { ED_SPRING_MULTILINEAR = 0, ED_SPRING_CONTACT = 1, ED_SPRING_DETERIORATING = 2 };
int ed_model_spring(ed_model *model, const char *name, int i, int j, const double *coefficient, int law, int n_parameters,
                    const double *parameters);
/* An elastic beam's ends leave out these flexibilities (rad a moment), because springs beside them have them: with the springs it
 * is the plain member. about_y: in space, of bending about local y, else about z. Each must be below that of the simply supported member,
 * L / 3EI. */
int ed_model_without_flexibility(ed_model *model, int element, int about_y, double at_i, double at_j);
/* Damping that is proportional to stiffness takes this factor (default 1) times the stiffness of the element: 0 for springs that are
 * stiffer than what they stand for, and more than 1 for the members beside them (Zareian & Medina 2010). */
int ed_model_damping_factor(ed_model *model, int element, double factor);

/* A damper (laws: eddamper.h) whose deformation is the sum of coefficient * displacement of n_terms degrees of nodes,
 * F = force_scale * law(deformation_scale * u); brace: stiffness in series at the size of the device, 0: rigid; play: of its pins, from
 * end to end, 0: none. It carries nothing before ed_install_dampers. Give its degrees mass: velocities of others are left to ring by
 * the trapezoidal rule. Up to 12 terms. */
int ed_model_damper(ed_model *model, const char *name, int law, int n_parameters, const double *parameters, double brace,
                    double play, double force_scale, double deformation_scale, int n_terms, const int *node, const int *degree,
                    const double *coefficient);
/* A bearing: the damper acts across its own direction too, with forces that lie within a circle, and the number of this second
 * direction is returned; in any single direction it has the force of its law. Of laws FRICTION, ELASTIC_PLASTIC, LEAD_RUBBER and
 * FRICTION_PENDULUM, without brace and effects; the terms are those of two deformations at right angles. */
int ed_model_damper_across(ed_model *model, int damper, const char *name, int n_terms, const int *node, const int *degree,
                           const double *coefficient);
/* The damper acts from the beginning, under gravity too: a bearing that holds what stands on it. In static steps it answers slowly, and
 * with its slope there it counts in the check whether the structure stands. */
int ed_model_damper_carries(ed_model *model, int damper);
/* In histories the damper has N / weight times its force, N the compression of a spring at that moment, and none where it is pulled: a
 * slider that rubs by what presses on it. The tangent leaves out how N changes. */
int ed_model_damper_weighs(ed_model *model, int damper, int element, double weight);
/* Adds an effect (eddamper.h) to a damper of the model, in the units of its law. */
int ed_model_add_damper_effect(ed_model *model, int damper, int form, int placement, int n_parameters, const double *parameters);

int ed_model_pattern(ed_model *model);
int ed_model_nodal_load(ed_model *model, int pattern, int node, const double *force); /* over degrees */
/* Loads on beam-columns, force a length in local axes, or a force at position (0..1) of the length. transverse: along y, in space along z too. */
int ed_model_uniform_load(ed_model *model, int pattern, int element, double axial, const double *transverse);
int ed_model_point_load(ed_model *model, int pattern, int element, double position, double axial, const double *transverse);
/* Across a beam-column from `start` to `end` (0..1) of its length, linear from at_start to at_end, force a length. */
int ed_model_partial_load(ed_model *model, int pattern, int element, double start, double end, const double *at_start,
                          const double *at_end);

#ifdef __cplusplus
}
#endif

#endif
