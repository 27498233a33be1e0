/* Status names are unique, every status has a text of its own, unknown numbers have one too. */
#include "checks.h"
#include "edcore.h"

#include <SuiteSparse_config.h>
#include <stdio.h>
#include <string.h>
#include <sundials/sundials_config.h>

#define NAME(name, value, text) #name,
#define VALUE(name, value, text) value,

int main(void)
{
  static const char *const names[] = {ED_STATUS_LIST(NAME)};
  static const int values[] = {ED_STATUS_LIST(VALUE)};
  enum { N = sizeof values / sizeof *values };
  for (int i = 0; i < N; i++) {
    CHECK(strcmp(ed_status_name(values[i]), names[i]) == 0);
    CHECK(strlen(ed_status_text(values[i])) > 0);
    CHECK((names[i][3] == 'E') == (values[i] < 0)); /* ED_E_*: errors are negative */
    for (int j = 0; j < i; j++) {
      CHECK(values[i] != values[j]);
      CHECK(strcmp(ed_status_name(values[i]), ed_status_name(values[j])) != 0);
      CHECK(strcmp(ed_status_text(values[i]), ed_status_text(values[j])) != 0);
    }
  }
  CHECK(ED_OK == 0);
  CHECK_CONTAINS(ed_status_name(-12345), "UNKNOWN");
  CHECK_CONTAINS(ed_status_text(-12345), "unknown");
  CHECK(strlen(ed_version()) > 0);
  char suitesparse[32] = "", sundials[32] = "";
  CHECK(ed_library_versions(32, suitesparse, sundials) == ED_OK);
  char expected[32];
  snprintf(expected, sizeof expected, "%d.%d.%d", SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION, SUITESPARSE_SUBSUB_VERSION);
  CHECK(strcmp(suitesparse, expected) == 0);
  CHECK(strcmp(sundials, SUNDIALS_VERSION) == 0);
  CHECK(ed_library_versions(2, suitesparse, sundials) == ED_OK && strlen(suitesparse) == 1 && strlen(sundials) == 1);
  CHECK(ed_library_versions(0, suitesparse, sundials) == ED_E_ARGUMENT);
  CHECK(ed_library_versions(2, NULL, sundials) == ED_E_ARGUMENT);
  return checks_end("status");
}
