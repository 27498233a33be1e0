/* Along a straight chord of the way the differential equation of q has a closed form (Krieg & Krieg 1977): on the circle the angle psi
 * between q and the chord falls as tan(psi / 2) = tan(psi_0 / 2) exp(-k length / limit). A path is cut where it turns back, and the pieces into chords that halve towards their end, where the last one says which way
 * q points. Speeds, and with them limits, are those at the ends of pieces, as in the laws of the plane. */
#include "damper/circular.h"

#include "edcore.h"

#include <math.h>
#include <string.h>

enum { CHORDS = 6, MOST_PIECES = 3, UNKNOWNS = 4 }; /* u, v along x, u, v along y */

/* Where a chord only touches the circle, where q reaches it moves infinitely fast with the unknowns; slopes take this cosine at least. */
static const double TOUCHES = 1e-3;

/* A number or a place in the plane with its derivatives to the unknowns. */
typedef struct {
  double limit, limit_slope[UNKNOWNS];
  double way[2], way_slope[UNKNOWNS]; /* unknown i moves the way along i / 2 alone */
} chord_of_way;

static double dot(const double a[2], const double b[2])
{
  return a[0] * b[0] + a[1] * b[1];
}

/* q stays within the circle or is pulled back to it from the end of an elastic chord. */
static void return_radially(double k, const chord_of_way *chord, double q[2], double slope[2][UNKNOWNS])
{
  const double end[2] = {q[0] + k * chord->way[0], q[1] + k * chord->way[1]}, size = hypot(end[0], end[1]);
  const int beyond = size > chord->limit;
  for (int i = 0; i < UNKNOWNS; i++) {
    double moved[2] = {slope[0][i], slope[1][i]};
    moved[i / 2] += k * chord->way_slope[i];
    if (beyond) {
      const double n[2] = {end[0] / size, end[1] / size}, turn = (-n[1] * moved[0] + n[0] * moved[1]) * chord->limit / size;
      moved[0] = chord->limit_slope[i] * n[0] - turn * n[1];
      moved[1] = chord->limit_slope[i] * n[1] + turn * n[0];
    }
    slope[0][i] = moved[0];
    slope[1][i] = moved[1];
  }
  for (int c = 0; c < 2; c++)
    q[c] = beyond ? chord->limit * end[c] / size : end[c];
}

/* q along one chord. The circle may have shrunk since the last one: where q lies outside it first goes on elastically as long as that
 * leads closer. */
static void follow_chord(double k, const chord_of_way *chord, double q[2], double slope[2][UNKNOWNS])
{
  const double *way = chord->way, limit = chord->limit, square = dot(way, way);
  double elastic = square > 0.0 ? fmax(-dot(q, way) / (k * square), 0.0) : 1.0; /* share of the chord */
  const int nears = elastic > 0.0;
  if (!(elastic < 1.0)) {
    return_radially(k, chord, q, slope);
    return;
  }
  double at[2] = {q[0] + elastic * k * way[0], q[1] + elastic * k * way[1]};
  const double missing = limit * limit - dot(at, at), along = k * dot(at, way);
  const int reaches = missing > 0.0;
  if (reaches) {
    elastic += missing / (along + sqrt(along * along + k * k * square * missing));
    if (!(elastic < 1.0)) {
      return_radially(k, chord, q, slope);
      return;
    }
    for (int c = 0; c < 2; c++)
      at[c] = q[c] + elastic * k * way[c];
  }
  const double size = hypot(at[0], at[1]), length = sqrt(square), rest = 1.0 - elastic, decay = exp(-k * rest * length / limit);
  const double n[2] = {at[0] / size, at[1] / size}, e[2] = {way[0] / length, way[1] / length}, p[2] = {-e[1], e[0]};
  const double cosine = dot(n, e), before = dot(n, p) / (1.0 + cosine), after = before * decay, whole = 1.0 + after * after;
  double end[2];
  for (int c = 0; c < 2; c++)
    end[c] = ((1.0 - after * after) * e[c] + 2.0 * after * p[c]) / whole;
  for (int i = 0; i < UNKNOWNS; i++) {
    const int c = i / 2;
    const double by_way = chord->way_slope[i], by_limit = chord->limit_slope[i];
    double moved[2] = {slope[0][i], slope[1][i]}, share = 0.0;
    moved[c] += elastic * k * by_way;
    if (reaches)
      share = (limit * by_limit - dot(at, moved)) / (k * limit * length * fmax(cosine, TOUCHES));
    else if (nears)
      share = -(slope[0][i] * way[0] + slope[1][i] * way[1] + q[c] * by_way) / (k * square) - 2.0 * elastic * way[c] * by_way / square;
    const double angle = (n[0] * (moved[1] + k * way[1] * share) - n[1] * (moved[0] + k * way[0] * share)) / size;
    const double turned = p[c] * by_way / length, longer = e[c] * by_way;
    const double by_after = 0.5 * decay * (1.0 + before * before) * (angle - turned) -
                            after * k / limit * (rest * longer - length * share - rest * length * by_limit / limit);
    const double turn = limit * (turned + 2.0 * by_after / whole);
    slope[0][i] = by_limit * end[0] - turn * end[1];
    slope[1][i] = by_limit * end[1] + turn * end[0];
  }
  for (int c = 0; c < 2; c++)
    q[c] = limit * end[c];
}

static void place(const ed_path path[2], double s, double to[2])
{
  to[0] = ed_path_u(&path[0], s);
  to[1] = ed_path_u(&path[1], s);
}

/* Ends of the pieces: places inside the path at which its speed is least and behind which it leads back, and its end. They do not depend
 * on axes. */
static int cut(const ed_path path[2], double at[MOST_PIECES])
{
  const double h = path[0].h;
  double f[4] = {0.0};
  for (int c = 0; c < 2; c++) { /* velocity times acceleration */
    const double *p = path[c].c;
    f[0] += 2.0 * p[1] * p[2];
    f[1] += 4.0 * p[2] * p[2] + 6.0 * p[1] * p[3];
    f[2] += 18.0 * p[2] * p[3];
    f[3] += 18.0 * p[3] * p[3];
  }
  const ed_path of_f = {h, {f[0], f[1], f[2], f[3]}};
  double turn[2], least[MOST_PIECES], from = 0.0;
  int n = 0, found = 0;
  const int turns = ed_path_reversals(&of_f, turn);
  for (int i = 0; i <= turns; i++) {
    const double to = i < turns ? turn[i] : h;
    if (ed_path_u(&of_f, from) < 0.0 && ed_path_u(&of_f, to) > 0.0)
      least[found++] = ed_path_crossing(&of_f, 0.0, from, to);
    from = to;
  }
  double before[2], here[2], next[2];
  place(path, 0.0, before);
  for (int i = 0; i < found; i++) {
    place(path, least[i], here);
    place(path, i + 1 < found ? least[i + 1] : h, next);
    if ((here[0] - before[0]) * (next[0] - here[0]) + (here[1] - before[1]) * (next[1] - here[1]) < 0.0)
      at[n++] = least[i];
    memcpy(before, here, sizeof before);
  }
  at[n++] = h;
  return n;
}

int ed_circle_follow(const ed_circle *circle, const ed_path path[2], const ed_path direction[2], double q[2], double slope[2][2][2])
{
  double end[MOST_PIECES], from = 0.0, of_unknowns[2][UNKNOWNS] = {{0.0}};
  const int n = cut(path, end);
  for (int piece = 0; piece < n; piece++) {
    const double v[2] = {ed_path_v(&path[0], end[piece]), ed_path_v(&path[1], end[piece])}, speed = hypot(v[0], v[1]);
    const double fading = circle->fading * exp(-circle->rate * speed), begins = from;
    chord_of_way chord = {.limit = circle->limit - fading};
    for (int i = 0; piece == n - 1 && speed > 0.0 && i < UNKNOWNS; i++)
      chord.limit_slope[i] = circle->rate * fading * v[i / 2] / speed * ed_path_v(&direction[i % 2], end[piece]);
    double left = end[piece] - begins;
    for (int i = 1; i <= CHORDS; i++) {
      left = i < CHORDS ? 0.5 * left : 0.0;
      const double to = end[piece] - left;
      for (int c = 0; c < 2; c++)
        chord.way[c] = ed_path_u(&path[c], to) - ed_path_u(&path[c], from);
      for (int k = 0; k < UNKNOWNS; k++)
        chord.way_slope[k] = ed_path_u(&direction[k % 2], to) - ed_path_u(&direction[k % 2], from);
      follow_chord(circle->stiffness, &chord, q, of_unknowns);
      from = to;
    }
  }
  for (int c = 0; c < 2; c++)
    for (int i = 0; i < UNKNOWNS; i++)
      slope[c][i / 2][i % 2] = of_unknowns[c][i];
  return isfinite(q[0] + q[1]) ? ED_OK : ED_E_NOT_FINITE;
}

int ed_circle_beside_spring(const ed_circle *circle, double spring, const double *const committed[2], const ed_path path[2],
                            const ed_path direction[2], double *const trial[2], ed_pair_force *out)
{
  double q[2] = {committed[0][0], committed[1][0]};
  const int status = ed_circle_follow(circle, path, direction, q, out->slope);
  for (int c = 0; c < 2; c++) {
    trial[c][0] = q[c];
    out->force[c] = spring * ed_path_u(&path[c], path[c].h) + q[c];
    for (int j = 0; j < 2; j++)
      out->slope[c][c][j] += spring * ed_path_u(&direction[j], path[c].h);
  }
  return status;
}
