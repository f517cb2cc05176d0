/* Comma separated numbers; spaces and tabs separate as well. Lines that are empty or begin with # are
 * skipped, and so is text after a # in the header, except for a comment that gives the domain. */
#include <ctype.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/text.h"
#include "points/pointset/files/points_file.h"

typedef struct reader {
    const char *path;
    size_t line;
    size_t value_capacity, line_capacity; /* of the matrix */
    aur_matrix *matrix;
    aur_error *error;
} reader;

static aur_location here(const reader *r) {
    return (aur_location){.file = r->path, .line = r->line};
}

static char *skip_spaces(char *text) {
    while (*text == ' ' || *text == '\t' || *text == '\r')
        ++text;
    return text;
}

/* Advances to the next field, over blanks and at most one comma. */
static char *skip_separator(char *text) {
    text = skip_spaces(text);
    return *text == ',' ? skip_spaces(text + 1) : text;
}

static bool grow(reader *r) {
    aur_matrix *const matrix = r->matrix;
    size_t needed;
    return aur_size_product(matrix->row_count + 1, matrix->column_count, &needed) &&
           aur_array_reserve(&matrix->values, &r->value_capacity, needed, sizeof *matrix->values) &&
           aur_array_reserve(&matrix->lines, &r->line_capacity, matrix->row_count + 1, sizeof *matrix->lines);
}

/* A field ends at a comma, a blank or the end of the line. */
static size_t field_length(const char *text) {
    return strcspn(text, ", \t\r");
}

static size_t count_fields(char *text) {
    size_t count = 0;
    for (text = skip_spaces(text); *text != '\0'; text = skip_separator(text + field_length(text)))
        ++count;
    return count;
}

/* Stores the names in lower case and without spaces. */
static aur_result read_header(reader *r, char *text) {
    char *const header = r->matrix->header;
    size_t used = 0;
    for (text = skip_spaces(text); *text != '\0'; text = skip_separator(text)) {
        const char *const end = text + field_length(text);
        if (used + (size_t)(end - text) + 2 > sizeof r->matrix->header)
            return aur_fail_at(r->error, here(r), AUR_ERROR_FORMAT, "the header is too long");
        if (used > 0)
            header[used++] = ',';
        while (text < end)
            header[used++] = (char)tolower((unsigned char)*text++);
    }
    header[used] = '\0';
    return AUR_OK;
}

static aur_result read_row(reader *r, char *text) {
    aur_matrix *const matrix = r->matrix;
    const size_t fields = count_fields(text);
    if (fields != matrix->column_count)
        return aur_fail_at(r->error, here(r), AUR_ERROR_FORMAT, "expected %zu columns as before (found %zu)",
                           matrix->column_count, fields);
    if (!grow(r))
        return aur_fail_memory(r->error);
    double *const row = matrix->values + matrix->row_count * matrix->column_count;
    text = skip_spaces(text);
    for (size_t c = 0; c < fields; ++c, text = skip_separator(text)) {
        const char *const end = aur_read_double(text, AUR_NUMBER_FINITE, &row[c]);
        const size_t length = field_length(text);
        if (end != text + length)
            return aur_fail_at(r->error, here(r), AUR_ERROR_FORMAT,
                               "column %zu: '%.*s' is not a finite number", c + 1, (int)length, text);
        text += length;
    }
    matrix->lines[matrix->row_count++] = r->line;
    return AUR_OK;
}

/* A header is a first line that begins with a letter, except the spellings of NaN and infinity. */
static bool is_header(const char *text) {
    double ignored;
    return aur_read_double(text, AUR_NUMBER_ANY, &ignored) == NULL &&
           (isalpha((unsigned char)*text) || *text == '_');
}

static aur_result read_line(reader *r, char *text) {
    aur_matrix *const matrix = r->matrix;
    text = skip_spaces(text);
    if (*text == '#')
        aur_matrix_read_comment(matrix, text + 1);
    if (*text == '\0' || *text == '#')
        return AUR_OK;
    if (matrix->column_count == 0 && is_header(text)) {
        char *const comment = strchr(text, '#');
        if (comment != NULL) {
            aur_matrix_read_comment(matrix, comment + 1);
            *comment = '\0';
        }
        matrix->column_count = count_fields(text);
        return read_header(r, text);
    }
    if (matrix->column_count == 0)
        matrix->column_count = count_fields(text);
    return read_row(r, text);
}

aur_result aur_csv_parse(const char *path, char *text, size_t size, aur_matrix *matrix, aur_error *error) {
    *matrix = (aur_matrix){0};
    reader r = {.path = path, .matrix = matrix, .error = error};
    char *const end = text + size;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3;
    while (text < end) {
        ++r.line;
        char *next = memchr(text, '\n', (size_t)(end - text));
        if (next == NULL)
            next = end;
        if (memchr(text, '\0', (size_t)(next - text)) != NULL)
            return aur_fail_at(error, here(&r), AUR_ERROR_FORMAT, "a zero byte: this is not a text file");
        *next = '\0';
        const aur_result result = read_line(&r, text);
        if (result != AUR_OK)
            return result;
        text = next + 1;
    }
    return AUR_OK;
}
