/* The inner loop of response spectra for vectors of WIDTH bytes, compiled for TARGET; included once for each. Written with vector
 * types because the compiler keeps arrays of lanes in memory, which takes twice as long. */
#define VEC JOIN(vec_, WIDTH)
#define BITS JOIN(bits_, WIDTH)
typedef double VEC __attribute__((vector_size(WIDTH), aligned(8), may_alias));
typedef long long BITS __attribute__((vector_size(WIDTH), aligned(8), may_alias));
#define AT(member) (*(VEC *)(from + offsetof(ed_lanes, member) / sizeof(double) + k * (WIDTH / 8)))
#define NOTE(kind, value) \
  do { \
    *(VEC *)(row + kind * (ED_PIECE + 2) * ED_LANES + k * (WIDTH / 8)) = value; \
    const VEC size = (VEC)((BITS)(value) & 0x7fffffffffffffffLL); \
    const BITS more = size > top[kind][k]; \
    top[kind][k] = (VEC)(((BITS)size & more) | ((BITS)top[kind][k] & ~more)); \
  } while (0)

/* `count` vectors from a lane on, side by side so that one computes while another waits; count and kinds are constants. One pointer
 * reaches all arrays: with one for each the processor's registers do not suffice. */
TARGET static inline __attribute__((always_inline)) void JOIN(advance_some_, WIDTH)(
    ed_lanes *b, int lane, const int count, const int kinds, const double *restrict a)
{
  const int rows = b->rows;
  double *from = (double *)b + lane, *row = from + offsetof(ed_lanes, y[0][2]) / sizeof(double);
  VEC y1[IN_FLIGHT], y2[IN_FLIGHT], top[ED_KINDS][IN_FLIGHT];
  for (int k = 0; k < count; k++) {
    y1[k] = AT(y1), y2[k] = AT(y2);
    for (int kind = 0; kind < kinds; kind++)
      top[kind][k] = (VEC){0.0};
  }
  for (int i = 0; i < rows; i++, row += ED_LANES) {
    const VEC ai = a[i] - (VEC){0.0};
    for (int k = 0; k < count; k++) {
      const VEC u = y1[k] + ai;
      NOTE(ED_SD, u);
      if (kinds > 1) {
        const VEC v = AT(vy) * y2[k] + AT(va) * ai, s = AT(su) * u + AT(sv) * v;
        NOTE(ED_SV, v);
        NOTE(ED_SA, s);
      }
      const VEC next = AT(e11) * y1[k] + (y2[k] + AT(d1) * ai);
      y2[k] = AT(e21) * y1[k] + (AT(e22) * y2[k] + AT(d2) * ai);
      y1[k] = next;
    }
  }
  for (int k = 0; k < count; k++) {
    AT(y1) = y1[k], AT(y2) = y2[k];
    for (int kind = 0; kind < kinds; kind++)
      AT(top[kind]) = top[kind][k];
  }
}

#define RUN(count, kinds) JOIN(advance_some_, WIDTH)(b, lane, count, kinds, a)
#define RUN_KINDS(count) (b->kinds == 1 ? RUN(count, 1) : RUN(count, ED_KINDS))
TARGET static void JOIN(advance_, WIDTH)(ed_lanes *b, int lanes, const double *a)
{
  const int in_vector = WIDTH / 8;
  for (int lane = 0; lane < lanes; lane += IN_FLIGHT * in_vector)
    switch ((lanes - lane + in_vector - 1) / in_vector) {
      case 1: RUN_KINDS(1); break;
      case 2: RUN_KINDS(2); break;
      case 3: RUN_KINDS(3); break;
      default: RUN_KINDS(IN_FLIGHT);
    }
}

#undef VEC
#undef BITS
#undef AT
#undef NOTE
#undef RUN
#undef RUN_KINDS
#undef WIDTH
#undef TARGET
