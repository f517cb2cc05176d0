/* A file of points as a matrix of numbers, before its columns are interpreted. */
#pragma once

#include <aureole/pointset.h>
#include <stdbool.h>

#include "points/base/error.h"

typedef struct aur_matrix {
    size_t row_count, column_count;
    double *values;   /* row by row; free with free() */
    size_t *lines;    /* the line of each row; NULL when the file has no lines; free with free() */
    char header[256]; /* column names with commas between them; empty when there are none */
    bool declared;    /* a comment gives the domain: */
    aur_domain domain;
    bool weighted; /* declared without names of columns: the last column has weights */
} aur_matrix;

/* Interprets the rows as aur_points_read does; takes ownership of `lines`. Errors: FORMAT, UNSUPPORTED,
 * MEMORY. */
aur_result aur_points_interpret(const char *path, const aur_domain *requested, aur_matrix *matrix,
                                aur_points **points, aur_error *error);

/* Reads a comment "domain: NAME", or "domain: NAME; weights"; other comments are ignored. */
void aur_matrix_read_comment(aur_matrix *matrix, const char *text);

/* `text` is modified and ends with a zero byte. `path` is for messages. */
AUR_INTERNAL aur_result aur_csv_parse(const char *path, char *text, size_t size, aur_matrix *matrix,
                                      aur_error *error);
AUR_INTERNAL aur_result aur_npy_parse(const char *path, const char *data, size_t size, aur_matrix *matrix,
                                      aur_error *error);
/* Whether the data begins as NPY files do. */
AUR_INTERNAL int aur_npy_recognize(const char *data, size_t size);
