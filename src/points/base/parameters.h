/* Named, typed values with the place they came from: what a plugin of a scene, an `--integrator
 * NAME:key=value` and a SET are built from. Tables of keys (points/base/keys.h) read them:
 * aur_parameters_find marks a value as used and remembers that the name is known; aur_parameters_finish then
 * refuses what nobody asked for, with the nearest known name. */
#pragma once

#include <stdbool.h>

#include "points/base/error.h"

typedef enum aur_parameter_kind {
    AUR_PARAMETER_TEXT, /* from key=value: the key decides what it is */
    AUR_PARAMETER_BOOLEAN,
    AUR_PARAMETER_INTEGER,
    AUR_PARAMETER_FLOAT,
    AUR_PARAMETER_STRING,
    AUR_PARAMETER_VECTOR,
    AUR_PARAMETER_COLOR,
    AUR_PARAMETER_TRANSFORM,
    AUR_PARAMETER_OBJECT
} aur_parameter_kind;

typedef struct aur_parameter {
    char *name;
    aur_parameter_kind kind;
    bool used;
    bool left_out; /* counts as not given */
    aur_location location;
    char *text;              /* every kind but the last two */
    double transform[16];    /* row major, world = M * local */
    const void *object;      /* not owned */
    const char *object_kind; /* static storage: "texture", "bsdf", ... */
} aur_parameter;

enum { AUR_PARAMETERS_KNOWN_CAPACITY = 64 };

typedef struct aur_parameters {
    char *kind;   /* "bsdf", "integrator", "set", ...: for messages */
    char *plugin; /* "diffuse", "path", "sobol", ... */
    aur_location location;
    size_t count, capacity;
    aur_parameter *items;
    size_t known_count;
    const char *known[AUR_PARAMETERS_KNOWN_CAPACITY]; /* names that were asked for; string literals */
} aur_parameters;

/* `location.file` must outlive the parameters; the other strings are copied. */
AUR_INTERNAL aur_result aur_parameters_init(aur_parameters *parameters, const char *kind, const char *plugin,
                                            aur_location location, aur_error *error);
AUR_INTERNAL void aur_parameters_release(aur_parameters *parameters);
/* A copy in which nothing is used yet. */
AUR_INTERNAL aur_result aur_parameters_copy(const aur_parameters *parameters, aur_parameters *copy,
                                            aur_error *error);

/* Parses "NAME[:key=value[,key=value...]]" into initialised parameters. A value that has commas of its own
 * stands in parentheses: finalgather:pattern=(esfg:base=64,levels=1),rotations=0. */
AUR_INTERNAL aur_result aur_parameters_parse(aur_parameters *parameters, const char *kind, const char *text,
                                             aur_error *error);

/* A second value of one name is an error that names both places. */
AUR_INTERNAL aur_result aur_parameters_add_text(aur_parameters *parameters, aur_parameter_kind kind,
                                                const char *name, const char *text, aur_location location,
                                                aur_error *error);
AUR_INTERNAL aur_result aur_parameters_add_transform(aur_parameters *parameters, const char *name,
                                                     const double transform[16], aur_location location,
                                                     aur_error *error);
AUR_INTERNAL aur_result aur_parameters_add_object(aur_parameters *parameters, const char *name,
                                                  const char *object_kind, const void *object,
                                                  aur_location location, aur_error *error);

/* The value of a name if it is there, marked as used; else NULL. `name` must be a string literal. */
AUR_INTERNAL const aur_parameter *aur_parameters_find(aur_parameters *parameters, const char *name);

/* A value of that name and text counts as not given from now on, although its name is known. */
void aur_parameters_leave_out(aur_parameters *parameters, const char *name, const char *text);

/* "KIND 'PLUGIN': " and the formatted text, with the place of the whole. */
AUR_INTERNAL aur_result aur_parameters_fail(const aur_parameters *parameters, aur_error *error,
                                            aur_result result, const char *format, ...) AUR_PRINTF(4, 5);

/* "KIND 'PLUGIN': 'NAME' must be EXPECTED, not 'VALUE'", with the value's place. */
AUR_INTERNAL aur_result aur_parameters_fail_value(const aur_parameters *parameters, const aur_parameter *item,
                                                  const char *expected, aur_error *error);

/* An error for the first value that nobody asked for. */
AUR_INTERNAL aur_result aur_parameters_finish(const aur_parameters *parameters, aur_error *error);
