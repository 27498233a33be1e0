/* Checks of the unit tests. A failed check prints file, line, what was expected and what came, and the program goes on;
 * checks_end prints one line and returns what main has to return. Not for use from several threads. */
#ifndef CHECKS_H
#define CHECKS_H

void check_true(const char *file, int line, int condition, const char *text);
void check_int(const char *file, int line, long got, long expected, const char *text);
/* |got - expected| <= tolerance; a NaN fails */
void check_near(const char *file, int line, double got, double expected, double tolerance, const char *text);
/* the same bits, but for the sign of zero */
void check_same(const char *file, int line, const double *got, const double *expected, int n, const char *text);
void check_status(const char *file, int line, int got, int expected, const char *text);
/* `text` contains `part` */
void check_contains(const char *file, int line, const char *text, const char *part);
long checks_failed(void); /* so far */
int checks_end(const char *subject);

#define CHECK(condition) check_true(__FILE__, __LINE__, (condition), #condition)
#define CHECK_INT(got, expected) check_int(__FILE__, __LINE__, (got), (expected), #got)
#define CHECK_NEAR(got, expected, tolerance) check_near(__FILE__, __LINE__, (got), (expected), (tolerance), #got)
#define CHECK_SAME(got, expected, n) check_same(__FILE__, __LINE__, (got), (expected), (n), #got)
#define CHECK_STATUS(got, expected) check_status(__FILE__, __LINE__, (got), (expected), #got)
#define CHECK_CONTAINS(text, part) check_contains(__FILE__, __LINE__, (text), (part))

#endif
