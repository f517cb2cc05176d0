/* The reader of one of Radiance's files, as its parts share it: words and messages (rad_text.c), what
 * surfaces (rad_surfaces.c) and materials (rad_materials.c) become, transforms (rad_xform.c), generators
 * (rad_generators.c), and the order of things (rad.c). */
#pragma once

#include "render/scene/importers/rad/rad.h"

/* A piece of the text. */
typedef struct aur_rad_word {
    const char *text;
    size_t length, line;
} aur_rad_word;

/* Where the primitives of a file stand: what xform does to them. */
struct aur_rad_pose {
    double m[16];          /* row by row, the last one 0 0 0 1 */
    double scale;          /* of lengths, above 0 */
    bool inverts;          /* surfaces face the other way */
    aur_rad_word modifier; /* of all surfaces, in place of their own; empty: their own */
};

typedef struct aur_rad_row aur_rad_row;

/* Radiance (Ward): `modifier type identifier`, then counted strings, integers and numbers. */
typedef struct aur_rad_primitive {
    aur_rad_word modifier, type, name;
    const aur_rad_row *row;
    size_t string_count, number_count;
    aur_rad_word *strings; /* into the reader's words */
    double *numbers;       /* into the reader's numbers */
} aur_rad_primitive;

/* What gensky and gendaylit write: radiance by direction, for sources. Radiance's skybright.cal and
 * perezlum.cal. */
typedef struct aur_rad_sky {
    bool perez;
    double numbers[10];
} aur_rad_sky;

/* A material under its name; a later one of the same name hides it. */
struct aur_rad_material {
    aur_rad_word name; /* its text is in the scene's arena */
    bool emits;
    bool nothing; /* surfaces of it are not there */
    aur_xml_node *bsdf, *interior, *exterior;
    double radiance[3]; /* of those that emit, times what a sky says */
    aur_rad_sky *sky;   /* in the scene's arena: the pattern, or the pattern of those that emit; or NULL */
    const struct aur_rad_lamp *lamp; /* the same of a measured lamp (rad_lamp.c) */
    /* In the scene's arena, where the material is not supported: the error of the first surface that uses it.
     */
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
    aur_rad_pose pose;     /* of this file */
    aur_rad_pose included; /* of the file that is included */
    /* Files that are still to be included, each in every pose: words, and poses in this file. */
    size_t file_count, pose_count, pose_capacity, next;
    aur_rad_pose *poses;
    aur_error *error;
};

/* A kind of primitive: how many numbers it takes, and what adds it. */
struct aur_rad_row {
    const char *name;
    size_t least, most;  /* numbers */
    size_t most_strings; /* what they are for is told by `add` */
    bool material, emits;
    /* `material`: of a surface, or the one that is to be filled. */
    aur_result (*add)(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material);
};

extern const aur_rad_row aur_rad_surfaces[], aur_rad_materials[]; /* end with a row without a name */

/* Skips blanks, line ends and comments; false at the end. A word may stand in quotes of either kind. */
bool aur_rad_next_word(aur_rad *self, aur_rad_word *word);
/* The next word of a command, up to the end of its line; a backslash before that continues the line. */
bool aur_rad_next_of_line(aur_rad *self, aur_rad_word *word);
bool aur_rad_is_word(aur_rad_word word, const char *text);
/* Whether all of the word is a number. */
bool aur_rad_number(aur_rad_word word, double *number);

/* An error at a line of the file. */
aur_result aur_rad_fail(const aur_rad *self, size_t line, aur_result result, const char *format, ...)
    AUR_PRINTF(4, 5);
/* `word` stands where `what` must; where it is empty, the file has ended. */
aur_result aur_rad_fail_end(const aur_rad *self, const char *what, aur_rad_word word);
/* Errors: FORMAT for a file's name with control characters. */
aur_result aur_rad_check_name(const aur_rad *self, aur_rad_word name);

/* Whether a type is a modifier of Radiance's that no row is about. */
bool aur_rad_is_modifier(aur_rad_word type);
/* The diffuse part of such a modifier, for --diffuse. `foreground` and `background` are those that a mixture
 * names, or NULL. Errors: UNSUPPORTED for those of which it is not known. */
aur_result aur_rad_add_diffuse_part(aur_rad *self, const aur_rad_primitive *item,
                                    const aur_rad_material *mixed, aur_rad_material *material);
/* The material of that name, or NULL. */
aur_rad_material *aur_rad_find_material(const aur_rad *self, aur_rad_word name);

aur_rad_pose aur_rad_pose_identity(void);
/* Moves a point (w = 1) or turns a direction (w = 0) as the file's pose says. */
void aur_rad_pose_apply(const aur_rad_pose *pose, double w, double x[3]);
bool aur_rad_pose_mirrors(const aur_rad_pose *pose);
/* Reads options of xform among `count` words and puts the poses that they make, arrays too, in the place of
 * all in self->poses. *used: words that were read, up to the first that is none of them. Errors: FORMAT,
 * UNSUPPORTED, MEMORY. */
aur_result aur_rad_read_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used);
/* Each of self->poses goes into every one that `count` words of options make. */
aur_result aur_rad_chain_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used);
aur_rad_pose aur_rad_pose_multiply(const aur_rad_pose *outer, const aur_rad_pose *inner);

/* Takes surfaces that a generator makes: type, and numbers. */
typedef aur_result aur_rad_take(aur_rad *self, const char *type, aur_rad_word modifier, size_t count,
                                double *numbers);
/* A command whose words are read from `at` on. */
typedef struct aur_rad_generator {
    aur_rad *rad;
    size_t count, at;
    const aur_rad_word *words;
    aur_rad_take *take;
} aur_rad_generator;

/* genbox, genprism and genrev: `words` begins with the command. *known is false for others. Errors: FORMAT,
 * UNSUPPORTED, OPEN for a file of corners, and what `take` returns. */
aur_result aur_rad_generate(aur_rad *self, size_t count, const aur_rad_word *words, aur_rad_take *take,
                            bool *known);
aur_result aur_rad_generate_prism(aur_rad_generator *self);
aur_result aur_rad_generate_revolution(aur_rad_generator *self);
/* The next `count` words are numbers; `what` names them in the message. Errors: FORMAT. */
aur_result aur_rad_generator_numbers(aur_rad_generator *self, const char *what, size_t count,
                                     double *numbers);
/* The word at self->at is no option of the command. */
aur_result aur_rad_generator_fail(const aur_rad_generator *self);

/* The value of an expression of Radiance's calcomp in the variable t. Errors: FORMAT; UNSUPPORTED for names
 * of functions and variables that are not built in. */
aur_result aur_rad_evaluate(const aur_rad *self, aur_rad_word expression, double t, double *value);

/* The text of a file that the scene names; *text is the caller's to free and ends with a zero byte. Errors:
 * OPEN, FORMAT, MEMORY. */
aur_result aur_rad_read_file(aur_rad *self, aur_rad_word name, char **text, size_t *size);

/* Hemispherical means of a BSDF file: what diffuse light becomes that falls on it. */
typedef struct aur_rad_bsdf_means {
    double reflected, through;
} aur_rad_bsdf_means;

/* Of the visible matrices of a file in Klems' format (LBNL WINDOW), means of both sides. Errors: OPEN,
 * FORMAT, UNSUPPORTED for files without such matrices. */
aur_result aur_rad_bsdf_read(aur_rad *self, aur_rad_word name, aur_rad_bsdf_means *means);

/* brightdata, where it is the distribution of a measured lamp; and the lamp, for a surface of such a light.
 */
aur_result aur_rad_add_distribution(aur_rad *self, const aur_rad_primitive *item, aur_rad_material *material);
aur_result aur_rad_add_lamp(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material);
