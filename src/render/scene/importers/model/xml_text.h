/* Writing the XML of a model. */
#pragma once

#include <stdio.h>

#include "points/base/error.h"

/* With decimal points under every locale; at most 1023 bytes. */
void aur_model_put(FILE *xml, const char *format, ...) AUR_PRINTF(2, 3);
/* A text as the value of an attribute, in which scenes replace $names. */
void aur_model_put_escaped(FILE *xml, const char *text);
