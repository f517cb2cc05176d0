/* Names of Mitsuba's parameters that do nothing here. */
#pragma once

#include "points/base/keys.h"

/* A row for each kind of object, with the names that are ignored where a type of that kind does not read
 * them. A help text that begins with "of no effect" is a warning, too. */
extern const aur_table aur_ignored_table;

/* Marks what is ignored of the parameters of a thing of this table as read, whatever its value is. */
void aur_parameters_ignore(aur_parameters *parameters, const aur_table *table, const aur_warnings *warnings);
