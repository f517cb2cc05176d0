/* The $names of a scene: -D and <default>. */
#pragma once

#include <aureole-render/scene.h>

#include "points/base/arena.h"
#include "points/base/error.h"

#include <stdbool.h>

typedef struct aur_xml_variable {
    const char *name, *value; /* in the arena */
    bool used;                /* something in the scene asked for it */
    bool defined;             /* by -D */
} aur_xml_variable;

typedef struct aur_xml_variables {
    aur_arena *arena; /* of the document */
    size_t count, capacity;
    aur_xml_variable *items;  /* the longest names first; freed by the caller */
    size_t substituted_bytes; /* that values have taken beyond the $names they stand for */
} aur_xml_variables;

/* Adds what -D defines. Errors: ARGUMENT, MEMORY. */
aur_result aur_xml_variables_define(aur_xml_variables *variables, const aur_scene_options *options,
                                    aur_error *error);
/* A <default>: ignored when the name has a value. */
aur_result aur_xml_variables_default(aur_xml_variables *variables, const char *name, const char *value,
                                     aur_location location, aur_error *error);
/* The value of a variable, which is given a default. *value is in the arena. Errors: MEMORY. */
aur_result aur_xml_variables_get(aur_xml_variables *variables, const char *name, const char *otherwise,
                                 aur_location location, const char **value, aur_error *error);
/* `text` with every $name replaced, in the arena. Errors: NAME for a name that has no value, FORMAT when the
 * values of all texts are too long, MEMORY. */
aur_result aur_xml_variables_substitute(aur_xml_variables *variables, const char *text, aur_location location,
                                        char **result, aur_error *error);
/* An error for the first -D that nothing used. */
aur_result aur_xml_variables_finish(const aur_xml_variables *variables, const char *file, aur_error *error);
