/* Interface between the parts of the Radiance reader: text and messages (rad_text.c), surfaces
 * (rad_surfaces.c), materials (rad_materials.c), transforms (rad_xform.c), generators (rad_generators.c), and
 * the order of primitives (rad.c). */
#pragma once

#include "render/scene/importers/rad/rad.h"

/* A substring of the text. */
typedef struct aur_rad_word {
    const char *text;
    size_t length, line;
} aur_rad_word;

/* The pose of a file's primitives, from xform. */
struct aur_rad_pose {
    double m[16];          /* row major, the last row is 0 0 0 1 */
    double scale;          /* scale factor, above 0 */
    bool inverts;          /* mirrored: surface orientation is reversed */
    aur_rad_word modifier; /* modifier that replaces the surfaces' modifiers; empty: none */
};

typedef struct aur_rad_row aur_rad_row;

/* A Radiance primitive (Ward): `modifier type identifier`, then counted strings, integers and numbers. */
typedef struct aur_rad_primitive {
    aur_rad_word modifier, type, name;
    const aur_rad_row *row;
    size_t string_count, number_count;
    aur_rad_word *strings; /* index into the reader's words */
    double *numbers;       /* index into the reader's numbers */
} aur_rad_primitive;

/* Output of gensky and gendaylit: radiance by direction, for sources. From Radiance's skybright.cal and
 * perezlum.cal. */
typedef struct aur_rad_sky {
    bool perez;
    bool by_irradiance; /* numbers: the sun's normal and the sky's horizontal irradiance, the ground's
                         * radiance, then the sun as the last three */
    double numbers[10];
} aur_rad_sky;

/* A named material; a later one of the same name replaces it. */
struct aur_rad_material {
    aur_rad_word name; /* text in the scene's arena */
    bool emits;
    bool nothing; /* surfaces with it are omitted */
    aur_xml_node *bsdf, *interior, *exterior;
    double radiance[3]; /* radiance of emitters, a factor of the sky's */
    aur_rad_sky *sky;   /* in the scene's arena: the pattern of an emitter, or a pattern by itself; or NULL */
    const struct aur_rad_luminaire *luminaire; /* the same for a photometric luminaire (rad_luminaire.c) */
    /* For unsupported materials, in the scene's arena: the error for the first surface that uses it. */
    const aur_error *unsupported;
    bool reported;
};

struct aur_rad {
    aur_rad_scene *scene;
    aur_nodes *nodes;
    aur_xml_node *parent;
    const char *at, *end;
    char *text;
    size_t line;
    aur_rad_word *words;
    double *numbers;
    size_t word_capacity, number_capacity;
    aur_rad_pose pose;     /* pose of this file */
    aur_rad_pose included; /* pose of the included file */
    /* Files still to be included, each in every pose: file names, and poses within this file. */
    size_t file_count, pose_count, pose_capacity, next;
    aur_rad_pose *poses;
    aur_error *error;
};

/* A primitive type: its number of arguments, and the function that adds it. */
struct aur_rad_row {
    const char *name;
    size_t least, most;  /* argument counts */
    size_t most_strings; /* checked and interpreted by `add` */
    bool material, emits;
    /* `material`: the surface's, or the one to define. */
    aur_result (*add)(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material);
};

extern const aur_rad_row aur_rad_surfaces[], aur_rad_materials[]; /* terminated by a row without a name */

/* Skips blanks, line ends and comments; false at the end of the text. A word may be in single or double
 * quotes. */
bool aur_rad_next_word(aur_rad *self, aur_rad_word *word);
/* The next word of a command line; a backslash before the line end continues the line. */
bool aur_rad_next_of_line(aur_rad *self, aur_rad_word *word);
bool aur_rad_is_word(aur_rad_word word, const char *text);
/* Whether the whole word is a number. */
bool aur_rad_number(aur_rad_word word, double *number);

/* An error at a line of the file. */
aur_result aur_rad_fail(const aur_rad *self, size_t line, aur_result result, const char *format, ...)
    AUR_PRINTF(4, 5);
/* Error: found `word`, expected `what`. An empty word means the end of the file. */
aur_result aur_rad_fail_end(const aur_rad *self, const char *what, aur_rad_word word);
/* Errors: FORMAT for a file name with control characters. */
aur_result aur_rad_check_name(const aur_rad *self, aur_rad_word name);

/* Whether a type is a modifier of Radiance without a table row. */
bool aur_rad_is_modifier(aur_rad_word type);
/* The diffuse part of such a modifier, for --diffuse. `foreground` and `background` are those of a mixture,
 * or NULL. Errors: UNSUPPORTED if it cannot be determined. */
aur_result aur_rad_add_diffuse_part(aur_rad *self, const aur_rad_primitive *item,
                                    const aur_rad_material *mixed, aur_rad_material *material);
/* The material of that name, or NULL. */
aur_rad_material *aur_rad_find_material(const aur_rad *self, aur_rad_word name);

aur_rad_pose aur_rad_pose_identity(void);
/* Applies the file's pose to a point (w = 1) or direction (w = 0). */
void aur_rad_pose_apply(const aur_rad_pose *pose, double w, double x[3]);
bool aur_rad_pose_mirrors(const aur_rad_pose *pose);
/* Parses xform options among `count` words, and replaces self->poses by the resulting poses, including
 * arrays. *used: number of words parsed, up to the first that is not an option. Errors: FORMAT, UNSUPPORTED,
 * MEMORY. */
aur_result aur_rad_read_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used);
/* Composes each of self->poses with every pose from `count` words of options. */
aur_result aur_rad_chain_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used);
aur_rad_pose aur_rad_pose_multiply(const aur_rad_pose *outer, const aur_rad_pose *inner);

/* Receives the surfaces of a generator: type and numbers. */
typedef aur_result aur_rad_take(aur_rad *self, const char *type, aur_rad_word modifier, size_t count,
                                double *numbers);
/* A command whose words are read from `at` on. */
typedef struct aur_rad_generator {
    aur_rad *rad;
    size_t count, at;
    const aur_rad_word *words;
    aur_rad_take *take;
} aur_rad_generator;

/* genbox, genprism and genrev: `words` begins with the command. *recognised is false for other commands.
 * Errors: FORMAT, UNSUPPORTED, OPEN for a file of corners, and the result of `take`. */
aur_result aur_rad_generate(aur_rad *self, size_t count, const aur_rad_word *words, aur_rad_take *take,
                            bool *recognised);
/* gendaylit and gensky: the pattern `skyfunc`, and the sun of gendaylit. Errors: FORMAT, MEMORY; UNSUPPORTED
 * for options by date or without irradiances. */
aur_result aur_rad_read_daylight(aur_rad *self, size_t count, const aur_rad_word *words,
                                 aur_rad_material *material);
aur_result aur_rad_generate_prism(aur_rad_generator *self);
aur_result aur_rad_generate_revolution(aur_rad_generator *self);
/* Parses the next `count` words as numbers; `what` names them in the message. Errors: FORMAT. */
aur_result aur_rad_generator_numbers(aur_rad_generator *self, const char *what, size_t count,
                                     double *numbers);
/* Error: the word at self->at is not an option of the command. */
aur_result aur_rad_generator_fail(const aur_rad_generator *self);

/* Evaluates a Radiance calcomp expression in the variable t. Errors: FORMAT; UNSUPPORTED for functions and
 * variables that are not built in. */
aur_result aur_rad_evaluate(const aur_rad *self, aur_rad_word expression, double t, double *value);

/* The text of a file referenced by the scene; the caller frees *text, which ends with a zero byte. Errors:
 * OPEN, FORMAT, MEMORY. */
aur_result aur_rad_read_file(aur_rad *self, aur_rad_word name, char **text, size_t *size);

/* Hemispherical means of a BSDF file: reflectance and transmittance for diffuse incident light. */
typedef struct aur_rad_bsdf_means {
    double reflected, through;
} aur_rad_bsdf_means;

/* Means of both sides from the visible matrices of a file in Klems' format (LBNL WINDOW). Errors: OPEN,
 * FORMAT, UNSUPPORTED for files without such matrices. */
aur_result aur_rad_bsdf_read(aur_rad *self, aur_rad_word name, aur_rad_bsdf_means *means);

/* brightdata with the distribution of a photometric luminaire, or a spotlight; and the luminaire for a
 * surface with that light. */
aur_result aur_rad_add_distribution(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material);
aur_result aur_rad_add_spotlight(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material);
aur_result aur_rad_add_luminaire(aur_rad *self, const aur_rad_primitive *item,
                                 const aur_rad_material *material);
