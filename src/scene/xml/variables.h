/* The $names of a scene: -D and <default>. */
#pragma once

#include <aureole/scene.h>

#include "core/error.h"

#include <stdbool.h>

typedef struct aur_xml_variable {
    char *name;
    char *value;
    bool used;    /* something in the scene asked for it */
    bool defined; /* by -D */
} aur_xml_variable;

/* Kept with the longest names first. */
typedef struct aur_xml_variables {
    size_t count, capacity;
    aur_xml_variable *items;
} aur_xml_variables;

aur_result aur_xml_variables_init(aur_xml_variables *variables, const aur_scene_options *options,
                                  aur_error *error);
void aur_xml_variables_release(aur_xml_variables *variables);
/* A <default>: ignored when the name has a value. */
aur_result aur_xml_variables_default(aur_xml_variables *variables, const char *name, const char *value,
                                     aur_location location, aur_error *error);
/* `text` with every $name replaced; *result is malloc'ed. */
aur_result aur_xml_variables_substitute(aur_xml_variables *variables, const char *text, aur_location location,
                                        char **result, aur_error *error);
/* An error for the first -D that nothing used. */
aur_result aur_xml_variables_finish(const aur_xml_variables *variables, const char *file, aur_error *error);
