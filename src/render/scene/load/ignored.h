/* Names of Mitsuba's parameters that do nothing here. */
#pragma once

#include "points/base/keys.h"

/* A row for each kind of object, with the names that are ignored where a type of that kind does not read
 * them. A help text that begins with "of no effect" is a warning, too. */
extern const aur_table aur_ignored_table;

/* Marks what is ignored of an object's parameters as read, whatever its value is, unless `reader` has a key
 * of that name; NULL: nothing is known to read them. */
void aur_parameters_ignore(aur_parameters *parameters, const aur_row *reader, const aur_warnings *warnings);
