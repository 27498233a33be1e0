/* What states and records of sections are made of. */
#ifndef ED_SECTION_LAYOUT_H
#define ED_SECTION_LAYOUT_H

/* A record of curved layers: the deformation at which they were evaluated, 1 + axes numbers, then n_padded stresses and tangents. */
static inline int record_layers(int axes)
{
  return 1 + axes;
}

/* Of layers that may break: how many have, and the largest damage. */
enum { BROKEN_LAYERS, DAMAGE, FATIGUE_HEAD };

#endif
