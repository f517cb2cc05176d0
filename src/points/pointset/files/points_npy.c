/* NumPy's array files, versions 1 to 3: one or two axes of 4- or 8-byte floats of either byte order, in C or
 * Fortran order. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "points/pointset/files/points_file.h"

enum { HEADER_CAPACITY = 4096 };

typedef struct npy_layout {
    size_t width; /* bytes per number */
    bool big_endian;
    bool fortran_order;
} npy_layout;

static const char magic[] = "\x93NUMPY";
enum { MAGIC_LENGTH = 6 };

int aur_npy_recognize(const char *data, size_t size) {
    return size >= MAGIC_LENGTH && memcmp(data, magic, MAGIC_LENGTH) == 0;
}

static aur_result malformed(aur_error *error, const char *path, const char *what) {
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "NPY: %s", what);
}

/* The text after 'key': in the header, or NULL. */
static const char *value_of(const char *header, const char *key) {
    const char *const found = strstr(header, key);
    if (found == NULL)
        return NULL;
    const char *value = found + strlen(key);
    while (*value == ' ' || *value == ':')
        ++value;
    return value;
}

/* "(rows, columns)" or "(rows,)" into numbers. */
static bool parse_shape(const char *text, uint64_t *rows, uint64_t *columns) {
    *columns = 1;
    if (text == NULL || *text != '(')
        return false;
    text = aur_read_integer(aur_skip_spaces(text + 1), SIZE_MAX / 16, rows);
    if (text == NULL)
        return false;
    text = aur_skip_spaces(text);
    if (*text != ',')
        return false;
    text = aur_skip_spaces(text + 1);
    if (*text == ')')
        return true;
    text = aur_read_integer(text, SIZE_MAX / 16, columns);
    return text != NULL && *aur_skip_spaces(text) == ')';
}

static aur_result read_shape(const char *path, const char *text, aur_matrix *matrix, aur_error *error) {
    uint64_t rows, columns;
    if (!parse_shape(text, &rows, &columns) || columns == 0 || rows > SIZE_MAX / 16 / columns)
        return malformed(error, path, "the shape must be (points, coordinates)");
    matrix->row_count = (size_t)rows;
    matrix->column_count = (size_t)columns;
    return AUR_OK;
}

static aur_result read_header(const char *path, const char *header, npy_layout *layout, aur_matrix *matrix,
                              aur_error *error) {
    const char *const kind = value_of(header, "'descr'");
    if (kind == NULL || kind[0] != '\'' || (kind[1] != '<' && kind[1] != '>') || kind[2] != 'f' ||
        (kind[3] != '4' && kind[3] != '8') || kind[4] != '\'')
        return malformed(error, path, "the numbers must be floats of 4 or 8 bytes");
    layout->big_endian = kind[1] == '>';
    layout->width = (size_t)(kind[3] - '0');
    const char *const order = value_of(header, "'fortran_order'");
    if (order == NULL || (strncmp(order, "True", 4) != 0 && strncmp(order, "False", 5) != 0))
        return malformed(error, path, "fortran_order is missing");
    layout->fortran_order = order[0] == 'T';
    const char *const end = strrchr(header, '}'), *const comment = end != NULL ? strchr(end, '#') : NULL;
    if (comment != NULL)
        aur_matrix_read_comment(matrix, comment + 1);
    return read_shape(path, value_of(header, "'shape'"), matrix, error);
}

static double number_at(const unsigned char *bytes, const npy_layout *layout) {
    uint64_t bits = 0;
    for (size_t i = 0; i < layout->width; ++i)
        bits |= (uint64_t)bytes[layout->big_endian ? layout->width - 1 - i : i] << (8 * i);
    if (layout->width == 8) {
        double value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    const uint32_t low = (uint32_t)bits;
    float value;
    memcpy(&value, &low, sizeof value);
    return (double)value;
}

aur_result aur_npy_parse(const char *path, const char *data, size_t size, aur_matrix *matrix,
                         aur_error *error) {
    *matrix = (aur_matrix){0};
    const unsigned char *const bytes = (const unsigned char *)data;
    if (size < 12)
        return malformed(error, path, "the file is cut short");
    const unsigned version = bytes[MAGIC_LENGTH];
    if (version < 1 || version > 3)
        return malformed(error, path, "versions 1 to 3 of the format are known");
    const size_t start = version == 1 ? 10 : 12;
    size_t length = (size_t)bytes[8] | (size_t)bytes[9] << 8;
    if (version > 1)
        length |= (size_t)bytes[10] << 16 | (size_t)bytes[11] << 24;
    if (length > size - start)
        return malformed(error, path, "the file is cut short");
    if (length >= HEADER_CAPACITY)
        return malformed(error, path, "the header is too long");
    char header[HEADER_CAPACITY];
    memcpy(header, data + start, length);
    header[length] = '\0';
    npy_layout layout = {0};
    const aur_result result = read_header(path, header, &layout, matrix, error);
    if (result != AUR_OK)
        return result;
    const size_t count = matrix->row_count * matrix->column_count;
    if ((size - start - length) / layout.width < count)
        return malformed(error, path, "the file is cut short");
    matrix->values = malloc((count > 0 ? count : 1) * sizeof *matrix->values);
    if (matrix->values == NULL)
        return aur_fail_memory(error);
    const unsigned char *const numbers = bytes + start + length;
    for (size_t r = 0; r < matrix->row_count; ++r) {
        for (size_t c = 0; c < matrix->column_count; ++c) {
            const size_t from =
                layout.fortran_order ? c * matrix->row_count + r : r * matrix->column_count + c;
            const double value = number_at(numbers + from * layout.width, &layout);
            if (!isfinite(value))
                return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                                   "point %zu, column %zu is not a finite number", r + 1, c + 1);
            matrix->values[r * matrix->column_count + c] = value;
        }
    }
    return AUR_OK;
}
