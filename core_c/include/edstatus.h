/* What calls of the core answer, and how a long one is ended. */
#ifndef EDSTATUS_H
#define EDSTATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* One list yields the enum and the texts: name, value, text. Below zero: error. */
#define ED_STATUS_LIST(X) \
  X(ED_OK, 0, "ok") \
  X(ED_LIMIT, 1, "a limit of a channel was exceeded") \
  X(ED_E_MEMORY, -1, "out of memory") \
  X(ED_E_ARGUMENT, -2, "invalid argument") \
  X(ED_E_ID, -3, "no object with this id") \
  X(ED_E_EMPTY, -4, "the model has no free degree of freedom") \
  X(ED_E_DISCONNECTED, -5, "a node is not connected to any support") \
  X(ED_E_MECHANISM, -6, "the structure is a mechanism") \
  X(ED_E_SINGULAR, -7, "the tangent matrix is singular") \
  X(ED_E_NOT_CONVERGED, -8, "equilibrium was not found") \
  X(ED_E_ELEMENT, -9, "an element state was not found") \
  X(ED_E_NOT_FINITE, -10, "a result is not a finite number") \
  X(ED_E_STATE, -11, "this call is not allowed in the present state") \
  X(ED_E_UNSTABLE, -12, "the structure is unstable under its loads") \
  X(ED_E_DAMPER, -13, "a damper state was not found") \
  X(ED_E_STOPPED, -14, "the call was asked to stop")

#define ED_STATUS_ENUM(name, value, text) name = value,
typedef enum { ED_STATUS_LIST(ED_STATUS_ENUM) ED_STATUS_END = 99 } ed_status;

const char *ed_status_name(int status);
const char *ed_status_text(int status);
const char *ed_version(void);

/* The versions of SuiteSparse and SUNDIALS as loaded, "5.12.0", each into room for `size` characters; "" where a library does not
 * say it. Longer texts are cut. ED_E_ARGUMENT: no room. */
int ed_library_versions(int size, char *suitesparse, char *sundials);

/* Whether a long call shall end. `asked` is called with `data` in the thread of the call, about five times a second, and never by
 * calls that last less than that. Another answer than 0 ends the call with ED_E_STOPPED. It must not use the object that is busy. */
typedef struct {
  int (*asked)(void *data);
  void *data;
} ed_stop;

#ifdef __cplusplus
}
#endif

#endif
