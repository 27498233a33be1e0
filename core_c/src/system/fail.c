/* What failed, kept for people: apart from analysis.c, which calls nearly all that fails. */
#include "system/analysis.h"

#include <stdarg.h>
#include <stdio.h>

int ed_fail(ed_analysis *a, int status, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(a->message, sizeof a->message, format, arguments);
  va_end(arguments);
  return status;
}
