#include "edcore.h"

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
  return "0.1.0";
}
