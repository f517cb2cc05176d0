/* Named, typed values with their source location: the parameters of a plugin of a scene, an `--integrator
 * NAME:key=value` and a SET. Tables of keys (points/base/keys.h) read them: aur_parameters_find marks a value
 * as used and records the name; aur_parameters_finish then reports unused values, with the nearest recorded
 * name. */
#pragma once

#include <stdbool.h>

#include "points/base/error.h"

typedef enum aur_parameter_kind {
    AUR_PARAMETER_TEXT, /* from key=value: the key determines the type */
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
    char *text;              /* all kinds except the last two */
    double transform[16];    /* row major, world = M * local */
    const void *object;      /* not owned */
    const char *object_kind; /* static storage: "texture", "bsdf", ... */
} aur_parameter;

enum { AUR_PARAMETERS_NAMES_CAPACITY = 64 };

typedef struct aur_parameters {
    char *kind;   /* "bsdf", "integrator", "set", ...: for messages */
    char *plugin; /* "diffuse", "path", "sobol", ... */
    aur_location location;
    size_t count, capacity;
    aur_parameter *items;
    size_t accepted_count;
    const char *accepted[AUR_PARAMETERS_NAMES_CAPACITY]; /* names that were looked up; string literals */
} aur_parameters;

/* `location.file` must outlive the parameters; the other strings are copied. */
AUR_INTERNAL aur_result aur_parameters_init(aur_parameters *parameters, const char *kind, const char *plugin,
                                            aur_location location, aur_error *error);
AUR_INTERNAL void aur_parameters_release(aur_parameters *parameters);
/* A copy with all values marked as unused. */
AUR_INTERNAL aur_result aur_parameters_copy(const aur_parameters *parameters, aur_parameters *copy,
                                            aur_error *error);

/* Parses "NAME[:key=value[,key=value...]]" into initialised parameters. A value with commas is written in
 * parentheses: finalgather:pattern=(esfg:base=64,levels=1),rotations=0. */
AUR_INTERNAL aur_result aur_parameters_parse(aur_parameters *parameters, const char *kind, const char *text,
                                             aur_error *error);

/* A second value of one name is an error that names both locations. */
AUR_INTERNAL aur_result aur_parameters_add_text(aur_parameters *parameters, aur_parameter_kind kind,
                                                const char *name, const char *text, aur_location location,
                                                aur_error *error);
AUR_INTERNAL aur_result aur_parameters_add_transform(aur_parameters *parameters, const char *name,
                                                     const double transform[16], aur_location location,
                                                     aur_error *error);
AUR_INTERNAL aur_result aur_parameters_add_object(aur_parameters *parameters, const char *name,
                                                  const char *object_kind, const void *object,
                                                  aur_location location, aur_error *error);

/* The value of a name, marked as used, or NULL. `name` must be a string literal. */
AUR_INTERNAL const aur_parameter *aur_parameters_find(aur_parameters *parameters, const char *name);

/* From now on a value of that name and text counts as not given, without an error. */
void aur_parameters_leave_out(aur_parameters *parameters, const char *name, const char *text);

/* "KIND 'PLUGIN': " and the formatted text, with the location of the object. */
AUR_INTERNAL aur_result aur_parameters_fail(const aur_parameters *parameters, aur_error *error,
                                            aur_result result, const char *format, ...) AUR_PRINTF(4, 5);

/* "KIND 'PLUGIN': 'NAME' must be EXPECTED, not 'VALUE'", with the value's location. */
AUR_INTERNAL aur_result aur_parameters_fail_value(const aur_parameters *parameters, const aur_parameter *item,
                                                  const char *expected, aur_error *error);

/* An error for the first unused value. */
AUR_INTERNAL aur_result aur_parameters_finish(const aur_parameters *parameters, aur_error *error);
