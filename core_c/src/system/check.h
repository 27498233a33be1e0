/* Structures that cannot stand are refused, by name. */
#ifndef ED_CHECK_H
#define ED_CHECK_H

#include "edcore.h"

int ed_check_structure(ed_analysis *a);
void ed_name_mechanism(ed_analysis *a, char *buffer, int size);

#endif
