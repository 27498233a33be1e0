/* What is wrong with the input of a substructure test, in words; NULL: nothing. */
#ifndef ED_WRONG_INPUT_H
#define ED_WRONG_INPUT_H

#include "edcore.h"

const char *ed_wrong_substructure(const ed_substructure_input *input);
const char *ed_wrong_compensator(const ed_compensator_parameters *compensator);

#endif
