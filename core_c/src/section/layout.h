/* What states and records of sections are made of. */
#ifndef ED_SECTION_LAYOUT_H
#define ED_SECTION_LAYOUT_H

/* A record of curved layers: where they were evaluated, then n_padded stresses and tangents. */
enum { RECORD_E0, RECORD_KAPPA, RECORD_LAYERS };

/* Of layers that may break: how many have, and the largest damage. */
enum { BROKEN_LAYERS, DAMAGE, FATIGUE_HEAD };

#endif
