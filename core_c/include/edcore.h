/* edcore: the numerical core of edesign.
 *
 *   edstatus.h        what calls answer, and how a long one is ended
 *   edmodel.h         models of plane frames with force-based fibre beam-columns and dampers
 *   edanalysis.h      analyses of them: static loads, pushover, ground motion
 *   eddamper.h        damper laws and their effects, alone
 *   edsubstructure.h  virtual real-time substructure tests, and edcompensator.h, which laboratories compile
 *   edspace.h         linear elastic space frames, and checks of their members
 *   edmotion.h        response spectra of ground acceleration
 *
 * Conventions
 *   Units      any consistent set; where a comment names units, it is edesign's: m, N, kg, s, rad. Tolerances do not depend on them,
 *              but some dampers do: fractional laws resolve 1e-4 to 2e3 s, powers of the velocity below 1 are linear below 1e-9 m/s,
 *              and with a brace the one-sided effect's jump of the force rises over 1e-5 m. Substructure tests are in these units.
 *   Degrees    three a node: 0 ux, 1 uy, 2 rz (anticlockwise). y points upwards. Space frames have their own.
 *   Elements   local x runs from end i to end j, local y 90 degrees anticlockwise of it.
 *   Sections   strain at depth y is e0 - y*kappa; axial force and strain are positive in tension.
 *   Ids        non-negative integers in the order of creation; a negative return is an ed_status.
 *   Handles    made by *_new, freed by *_free. A model is read-only once an analysis has been made of it; analyses of one
 *              model share nothing that changes and may run in parallel threads. The library has no global state, never
 *              prints and never exits.
 */
#ifndef EDCORE_H
#define EDCORE_H

#include "edanalysis.h"
#include "edcompensator.h"
#include "eddamper.h"
#include "edmodel.h"
#include "edmotion.h"
#include "edspace.h"
#include "edstatus.h"
#include "edsubstructure.h"

#endif
