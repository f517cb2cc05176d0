/* A digital sequence from the user's generator matrices.
 *
 * The file is text. Lines that are empty or begin with # separate matrices. A first line "base B" with a
 * prime B sets the base, otherwise it is 2. Each matrix is some lines of digits 0..B-1 with spaces between
 * them (in base 2 to 10 the spaces may be left out): the first line gives the most significant digit of the
 * coordinate, the first column belongs to the lowest digit of the index. All matrices have the same shape, at
 * most 64 x 64; a set has as many dimensions as matrices and at most B^columns points. Random access. */
#include <ctype.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/pointset/digits/digital.h"
#include "points/pointset/digits/radical_inverse.h"

static const size_t file_limit = (size_t)1 << 26;

typedef struct reader {
    const char *path;
    size_t line;
    aur_error *error;
    uint32_t base;
    size_t row_count, column_count, matrix_count;
    size_t row; /* of the current matrix */
    size_t digit_count, capacity;
    uint16_t *digits; /* as in the file: row by row */
} reader;

static aur_result fail(const reader *r, const char *what, uint64_t number) {
    return aur_fail_at(r->error, (aur_location){.file = r->path, .line = r->line}, AUR_ERROR_FORMAT,
                       "%s (%" PRIu64 ")", what, number);
}

static aur_result end_matrix(reader *r) {
    if (r->row == 0)
        return AUR_OK;
    if (r->matrix_count > 0 && r->row != r->row_count)
        return fail(r, "a matrix must have as many rows as the first one", r->row_count);
    r->row_count = r->row;
    r->row = 0;
    ++r->matrix_count;
    return AUR_OK;
}

static aur_result put_digit(reader *r, uint64_t digit) {
    if (digit >= r->base)
        return fail(r, "a digit must be less than the base", r->base);
    if (!aur_array_reserve(&r->digits, &r->capacity, r->digit_count + 1, sizeof *r->digits))
        return aur_fail_memory(r->error);
    r->digits[r->digit_count++] = (uint16_t)digit;
    return AUR_OK;
}

static aur_result read_row(reader *r, const char *text) {
    size_t columns = 0;
    const bool joined = r->base <= 10;
    while (*text != '\0') {
        if (isspace((unsigned char)*text) || *text == ',') {
            ++text;
            continue;
        }
        if (!isdigit((unsigned char)*text))
            return fail(r, "a row must hold digits only, and not the character", (unsigned char)*text);
        uint64_t digit = 0;
        do
            digit = digit * 10 + (uint64_t)(*text++ - '0');
        while (!joined && isdigit((unsigned char)*text) && digit < AUR_RADICAL_BASE_LIMIT);
        const aur_result result = put_digit(r, digit);
        if (result != AUR_OK)
            return result;
        if (++columns > AUR_DIGITAL_COLUMNS)
            return fail(r, "a matrix has at most so many columns", AUR_DIGITAL_COLUMNS);
    }
    if (r->column_count != 0 && columns != r->column_count)
        return fail(r, "a row must have as many columns as the first one", r->column_count);
    r->column_count = columns;
    if (++r->row > AUR_DIGITAL_COLUMNS)
        return fail(r, "a matrix has at most so many rows", AUR_DIGITAL_COLUMNS);
    return AUR_OK;
}

static aur_result read_line(reader *r, const char *text) {
    while (isspace((unsigned char)*text))
        ++text;
    if (*text == '\0' || *text == '#')
        return end_matrix(r);
    if (strncmp(text, "base", 4) != 0)
        return read_row(r, text);
    char *end;
    const unsigned long base = strtoul(text + 4, &end, 10);
    while (isspace((unsigned char)*end))
        ++end;
    if (r->digit_count > 0 || *end != '\0' || base >= AUR_RADICAL_BASE_LIMIT || !aur_is_prime((uint32_t)base))
        return fail(r, "'base' must precede the matrices and be a prime below", AUR_RADICAL_BASE_LIMIT);
    r->base = (uint32_t)base;
    return AUR_OK;
}

static aur_result read_lines(reader *r, char *text, size_t size) {
    char *const end = text + size;
    while (text < end) {
        ++r->line;
        char *next = memchr(text, '\n', (size_t)(end - text));
        if (next == NULL)
            next = end;
        *next = '\0';
        const aur_result result = read_line(r, text);
        if (result != AUR_OK)
            return result;
        text = next + 1;
    }
    const aur_result result = end_matrix(r);
    if (result == AUR_OK && r->matrix_count == 0)
        return fail(r, "no matrices; lines read", r->line);
    return result;
}

/* Digits beyond the precision of a double are dropped. */
static aur_result make_rule(aur_pointset *set, const reader *r) {
    if (set->dimension > r->matrix_count)
        return aur_fail_at(r->error, (aur_location){.file = r->path}, AUR_ERROR_ARGUMENT,
                           "%zu matrices make no more than so many dimensions, not %zu", r->matrix_count,
                           set->dimension);
    uint64_t limit = 1;
    for (size_t c = 0; c < r->column_count && limit < AUR_INDEX_LIMIT; ++c)
        limit *= r->base;
    if (set->size > limit)
        return aur_fail_at(r->error, (aur_location){.file = r->path}, AUR_ERROR_ARGUMENT,
                           "matrices of %zu columns make at most %" PRIu64 " points, not %" PRIu64,
                           r->column_count, limit, set->size);
    const size_t digit_count = aur_digit_sum_places(r->base);
    const size_t rows = r->row_count < digit_count ? r->row_count : digit_count;
    aur_digital_rule *const rule = aur_digital_rule_create(r->base, rows, r->column_count, set->dimension);
    if (rule == NULL)
        return aur_fail_memory(r->error);
    for (size_t d = 0; d < set->dimension; ++d)
        for (size_t c = 0; c < r->column_count; ++c)
            for (size_t row = 0; row < rows; ++row)
                rule->digits[(d * r->column_count + c) * rows + row] =
                    r->digits[(d * r->row_count + row) * r->column_count + c];
    set->data = rule;
    return AUR_OK;
}

typedef struct matrices_keys {
    const char *file;
} matrices_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(matrices_keys, "file", file, NULL,
                     "text file of the generator matrices; must be given")},
};

static aur_result prepare(aur_pointset *set, aur_parameters *parameters, aur_error *error) {
    matrices_keys p = {NULL};
    aur_result result = aur_row_read(&set->kind->description.row, parameters, &p, error);
    const char *const path = p.file;
    if (result != AUR_OK)
        return result;
    if (path == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set 'matrices' needs file=PATH");
    char *text;
    size_t size;
    result = aur_file_read(path, file_limit, &text, &size, error);
    if (result != AUR_OK)
        return result;
    reader r = {.path = path, .error = error, .base = 2};
    result = read_lines(&r, text, size);
    if (result == AUR_OK)
        result = make_rule(set, &r);
    free(text);
    free(r.digits);
    set->net_base = r.base;
    return result;
}

const aur_square_set aur_set_matrices = {
    .description = {.row = {.name = "matrices",
                            .summary =
                                "digital sequence from generator matrices in a text file, any prime base",
                            .source = "Niederreiter 1992",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SQUARE | AUR_ON_CUBE,
                    .dimensions = {1, SIZE_MAX},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .sized_by_file = true,
                    .best_sizes = AUR_SIZES_POWERS,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_ALL,
    .prepare = prepare,
    .fill = aur_fill_digital_rule,
};
