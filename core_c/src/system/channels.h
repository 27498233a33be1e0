/* Recorded quantities, and their extremes. */
#ifndef ED_CHANNELS_H
#define ED_CHANNELS_H

#include "edcore.h"

typedef struct {
  int n_terms;                   /* 0: the root of the sum of the squares of two channels */
  int first, second;             /* into terms; or those channels */
  int history;                   /* column, or -1 */
  double limit;                  /* of its magnitude */
} ed_channel_head;

typedef struct {
  double coefficient;
  int kind, object, component;
} ed_term;

typedef struct {
  ed_channel_head *head;         /* n */
  ed_term *terms;                /* n_terms */
  int n, n_terms, n_history;
  double *maximum, *minimum, *time_maximum, *time_minimum, *last; /* n */
  double *angle;                 /* n: where a root was largest */
} ed_channels;

void ed_channels_free(ed_channels *channels);
/* quantities.c: whether there is such a quantity, and the sum of the terms of a channel */
int ed_is_quantity(const ed_analysis *a, int kind, int object, int component);
double ed_channel_sum(const ed_analysis *a, const ed_channel_head *head);
int ed_sample(ed_analysis *a, int keep_row);        /* ED_OK, ED_E_NOT_FINITE */
int ed_beyond_limit(const ed_channels *channels);   /* channel of the last sample that is furthest beyond its limit, -1: none */

#endif
