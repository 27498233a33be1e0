#include "edcore.h"

#include <SuiteSparse_config.h>
#include <stdio.h>
#include <sundials/sundials_version.h>

#define ED_CASE_NAME(name, value, text) \
  case value:                           \
    return #name;
#define ED_CASE_TEXT(name, value, text) \
  case value:                           \
    return text;

const char *ed_status_name(int status)
{
  switch (status) {
    ED_STATUS_LIST(ED_CASE_NAME)
  }
  return "ED_UNKNOWN";
}

const char *ed_status_text(int status)
{
  switch (status) {
    ED_STATUS_LIST(ED_CASE_TEXT)
  }
  return "unknown status";
}

const char *ed_version(void)
{
  return "0.2.0";
}

int ed_library_versions(int size, char *suitesparse, char *sundials)
{
  if (size < 1 || !suitesparse || !sundials) {
    return ED_E_ARGUMENT;
  }
  *suitesparse = *sundials = '\0';
#ifdef SUITESPARSE_HAS_VERSION_FUNCTION
  int version[3] = {0, 0, 0};
  SuiteSparse_version(version);
  snprintf(suitesparse, (size_t)size, "%d.%d.%d", version[0], version[1], version[2]);
#endif
  char text[64];
  if (!SUNDIALSGetVersion(text, (int)sizeof text)) {
    snprintf(sundials, (size_t)size, "%s", text);
  }
  return ED_OK;
}
