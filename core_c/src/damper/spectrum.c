#include "damper/spectrum.h"

#include <math.h>

enum { MOST_INNER = ED_MAX_ODE - 2 }; /* branches but those at both ends */

/* Orders below it are none. A spectrum changes by the order in each unit of ln r: between the slowest and the fastest rate, 20 apart, it
 * then holds less than 2e-13 of what it holds on one side of them. The numbers of its nodes, up to 16 / (order ED_SPACING), would come
 * near 2^53, up to which a double distinguishes whole numbers. */
static const double NO_ORDER = 1e-14;

static void start(ed_prony *series)
{
  series->spring = series->dashpot = 0.0;
  series->branches = 0;
}

static void add(ed_prony *series, double rate, double stiffness)
{
  series->rate[series->branches] = rate;
  series->stiffness[series->branches++] = stiffness;
}

/* One branch for slow ones (sum of k, sum of k r) and for fast ones (sum of k/r, sum of k/r^2). */
static void add_slow(ed_prony *series, double k, double k_r)
{
  if (k_r > 0.0)
    add(series, k_r / k, k);
}

static void add_fast(ed_prony *series, double c, double c_by_r)
{
  if (c_by_r > 0.0)
    add(series, c / c_by_r, c * (c / c_by_r));
}

/* Spectrum sin(pi alpha)/pi r^alpha d ln r. The sums beyond both ends are geometric. */
void ed_spectrum_of_power(ed_prony *series, double alpha)
{
  if (alpha < NO_ORDER) { /* 1, in which no force relaxes */
    start(series);
    series->spring = 1.0;
    return;
  }
  const double d = ED_SPACING, inner = floor(log(ED_FASTEST / ED_SLOWEST) / d);
  const double x0 = 0.5 * (log(ED_SLOWEST) + log(ED_FASTEST) - inner * d);
  const double scale = sin(M_PI * (alpha < 0.5 ? alpha : 1.0 - alpha)) / M_PI * d;
  start(series);
  const double slow = exp(x0 - d), slow_weight = scale * pow(slow, alpha);
  add_slow(series, slow_weight / -expm1(-alpha * d), slow_weight * slow / -expm1(-(alpha + 1.0) * d));
  for (int i = 0; i <= (int)inner; i++) {
    const double r = exp(x0 + i * d);
    add(series, r, scale * pow(r, alpha));
  }
  const double fast = exp(x0 + (inner + 1.0) * d), fast_damping = scale * pow(fast, alpha - 1.0);
  add_fast(series, fast_damping / -expm1(-(1.0 - alpha) * d), fast_damping / fast / -expm1(-(2.0 - alpha) * d));
}

/* The Mittag-Leffler spectrum (Gorenflo & Mainardi) is even in x = ln(r a^(1/alpha)),
 *   sin(pi alpha) / (2 pi (cosh(alpha x) + cos(pi alpha))) dx,
 * a peak of width pi (1 - alpha) with tails exp(-alpha |x|). Its cumulative p = phi / (pi alpha), where
 * exp(alpha x) = sin(phi) / sin(pi alpha - phi), makes it uniform; trapezoids in psi = ln(p / (1 - p)) then suit peak and tails
 * and all orders. The density in psi is p (1 - p); psi is j alpha d, so that x advances by d or less. */
typedef struct {
  double alpha, shift; /* shift = ln(a) / alpha */
} spectrum;

static double weight(const spectrum *s, double j)
{
  const double step = s->alpha * ED_SPACING, tail = exp(-fabs(j * step));
  return step * tail / ((1.0 + tail) * (1.0 + tail));
}

static double rate(const spectrum *s, double j)
{
  const double psi = j * s->alpha * ED_SPACING, most = 300.0; /* squares must be finite */
  const double phi = M_PI * s->alpha / (1.0 + exp(-psi)), rest = M_PI * s->alpha / (1.0 + exp(psi));
  const double x = j * ED_SPACING + (log(sin(phi) / phi) - log(sin(rest) / rest)) / s->alpha - s->shift;
  return exp(fmax(-most, fmin(x, most)));
}

/* Sums over nodes from j in direction `way`: weights, and weights by rate to +-1 and to +-2 (-way). Few nodes count for the latter
 * two, for rates fall or rise by exp(d) a node. The rest of the weights, many nodes close together when the order is small, is an
 * integral (Euler-Maclaurin from the middle between nodes). */
static void end_sums(const spectrum *s, double j, int way, double sum[3])
{
  enum { NODES = 128 };
  const double step = s->alpha * ED_SPACING;
  sum[0] = sum[1] = sum[2] = 0.0;
  for (int i = 0; i < NODES; i++, j += way) {
    const double w = weight(s, j), r = way < 0 ? rate(s, j) : 1.0 / rate(s, j);
    if (w < 1e-18 * sum[0])
      return;
    sum[0] += w;
    sum[1] += w * r;
    sum[2] += w * r * r;
  }
  const double left = 1.0 / (1.0 + exp((way * j - 0.5) * step));
  sum[0] += left - step * step / 24.0 * left * (1.0 - left) * (1.0 - 2.0 * left);
}

/* First node that is at least as fast as `slowest`; not so far out that its weight is nothing. Whole numbers below 2^52 in size, as the
 * order is NO_ORDER or more: 53 halvings. */
static double first_node(const spectrum *s, double farthest, double slowest)
{
  double below = -farthest - 1.0, above = farthest + 1.0;
  for (int i = 0; i < 60 && above - below > 1.0; i++) {
    const double middle = floor(0.5 * (below + above));
    if (rate(s, middle) < slowest)
      below = middle;
    else
      above = middle;
  }
  return above;
}

void ed_spectrum_of_mittag_leffler(ed_prony *series, double alpha, double a, int derivative)
{
  if (alpha < NO_ORDER) { /* E_0(-1/a): 1/(1 + a) is gone at once, the rest stays for ever */
    start(series);
    series->spring = derivative ? 0.0 : a / (1.0 + a);
    series->dashpot = derivative ? 1.0 / (1.0 + a) : 0.0;
    return;
  }
  const spectrum s = {alpha, log(a) / alpha};
  const double farthest = floor(16.0 / (alpha * ED_SPACING)); /* 1e-7 of the spectrum is beyond */
  const double first = first_node(&s, farthest, ED_SLOWEST);
  double end[3], j = first;
  start(series);
  end_sums(&s, first - 1.0, -1, end);
  add_slow(series, end[derivative], end[derivative + 1]);
  for (; j <= farthest && rate(&s, j) <= ED_FASTEST && series->branches <= MOST_INNER; j++)
    add(series, rate(&s, j), weight(&s, j) * (derivative ? rate(&s, j) : 1.0));
  end_sums(&s, j, 1, end);
  add_fast(series, end[1 - derivative], end[2 - derivative]);
}
