/* The reader of one of Radiance's files, as its parts share it: words and messages (rad_text.c), what the
 * primitives become (rad_rows.c), and the order of things (rad.c). */
#pragma once

#include "render/scene/importers/rad/rad.h"

/* A piece of the text. */
typedef struct aur_rad_word {
    const char *text;
    size_t length, line;
} aur_rad_word;

typedef struct aur_rad_row aur_rad_row;

/* Radiance (Ward): `modifier type identifier`, then counted strings, integers and numbers. */
typedef struct aur_rad_primitive {
    aur_rad_word modifier, type, name;
    const aur_rad_row *row;
    size_t string_count, number_count;
    aur_rad_word *strings; /* into the reader's words */
    double *numbers;       /* into the reader's numbers */
} aur_rad_primitive;

/* A material under its name; a later one of the same name hides it. */
struct aur_rad_material {
    aur_rad_word name; /* its text is in the scene's arena */
    const aur_rad_row *row;
    aur_xml_node *bsdf; /* of those that do not emit */
    double radiance[3];
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
    size_t include_count, include_next; /* words of a command: files that are still to be included */
    aur_error *error;
};

/* A kind of primitive: how many numbers it takes, and what adds it. */
struct aur_rad_row {
    const char *name;
    size_t least, most; /* numbers */
    bool material, emits, names_file;
    aur_result (*add)(aur_rad *self, const aur_rad_primitive *item, const aur_rad_material *material);
};

enum { AUR_RAD_ROWS = 13 };
extern const aur_rad_row aur_rad_rows[AUR_RAD_ROWS];

/* Skips blanks, line ends and comments; false at the end. */
bool aur_rad_next_word(aur_rad *self, aur_rad_word *word);
bool aur_rad_is_word(aur_rad_word word, const char *text);

/* An error at a line of the file. */
aur_result aur_rad_fail(const aur_rad *self, size_t line, aur_result result, const char *format, ...)
    AUR_PRINTF(4, 5);
/* `word` stands where `what` must; where it is empty, the file has ended. */
aur_result aur_rad_fail_end(const aur_rad *self, const char *what, aur_rad_word word);
/* Errors: FORMAT for a file's name with control characters. */
aur_result aur_rad_check_name(const aur_rad *self, aur_rad_word name);
