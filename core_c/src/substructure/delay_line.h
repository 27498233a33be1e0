/* A signal some time ago, linear between samples a sub-step apart; zero before the test. */
#ifndef ED_DELAY_LINE_H
#define ED_DELAY_LINE_H

typedef struct {
  int size, last;    /* samples in the ring, and where the last one is */
  int whole;         /* sub-steps of the delay ... */
  double part;       /* ... and the rest of it, as a share of one */
  double *sample;
} ed_delay_line;

/* Samples that a delay of so many sub-steps asks for. */
static inline int ed_delay_line_size(double sub_steps)
{
  return (int)sub_steps + 2;
}

static inline ed_delay_line ed_delay_line_of(double sub_steps, double *sample)
{
  const int whole = (int)sub_steps;
  return (ed_delay_line){.size = ed_delay_line_size(sub_steps), .whole = whole, .part = sub_steps - whole, .sample = sample};
}

static inline double ed_delay_line_back(const ed_delay_line *line, int back)
{
  const int at = line->last - back;
  return line->sample[at < 0 ? at + line->size : at];
}

/* Takes the next sample and gives the delayed one. */
static inline double ed_delay_line_next(ed_delay_line *line, double value)
{
  line->last = line->last + 1 == line->size ? 0 : line->last + 1;
  line->sample[line->last] = value;
  const double later = ed_delay_line_back(line, line->whole);
  return line->part == 0.0 ? later : later + line->part * (ed_delay_line_back(line, line->whole + 1) - later);
}

#endif
