#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *aur_version(void) {
    return AUR_VERSION;
}

const char *aur_result_string(aur_result result) {
    switch (result) {
    case AUR_OK:
        return "success";
    case AUR_ERROR_INTERNAL:
        return "internal error";
    case AUR_ERROR_MEMORY:
        return "out of memory";
    case AUR_ERROR_CANCELLED:
        return "cancelled";
    case AUR_ERROR_ARGUMENT:
        return "argument out of range";
    case AUR_ERROR_CAPACITY:
        return "output buffer too small";
    case AUR_ERROR_NAME:
        return "unknown name";
    case AUR_ERROR_UNSUPPORTED:
        return "not supported";
    case AUR_ERROR_FORMAT:
        return "malformed input";
    case AUR_ERROR_OPEN:
        return "cannot read file";
    case AUR_ERROR_WRITE:
        return "cannot write file";
    }
    return "unknown result";
}

/* "FILE:LINE:COLUMN: " as far as it is known. */
static size_t format_location(char *text, size_t capacity, const char *file, size_t line, size_t column) {
    if (file == NULL || file[0] == '\0') {
        if (capacity > 0)
            text[0] = '\0';
        return 0;
    }
    int length;
    if (line == 0)
        length = snprintf(text, capacity, "%s: ", file);
    else if (column == 0)
        length = snprintf(text, capacity, "%s:%zu: ", file, line);
    else
        length = snprintf(text, capacity, "%s:%zu:%zu: ", file, line, column);
    return length < 0 ? 0 : (size_t)length;
}

size_t aur_error_format(const aur_error *error, char *text, size_t capacity) {
    const size_t used = format_location(text, capacity, error->file, error->line, error->column);
    const size_t left = used < capacity ? capacity - used : 0;
    const int length = snprintf(left > 0 ? text + used : NULL, left, "%s", error->message);
    return used + (length < 0 ? 0 : (size_t)length);
}

static void fill(aur_error *error, aur_location location, aur_result result, const char *format,
                 va_list arguments) {
    error->result = result;
    error->line = location.line;
    error->column = location.column;
    /* A path that does not fit keeps its end, which names the file. */
    const char *file = location.file != NULL ? location.file : "";
    const size_t length = strlen(file);
    const size_t room = sizeof error->file - 1;
    const char *tail = length > room ? file + (length - room) : file;
    /* The caller may pass the file of this very error. */
    memmove(error->file, tail, strlen(tail) + 1);
    vsnprintf(error->message, sizeof error->message, format, arguments);
}

aur_result aur_fail(aur_error *error, aur_result result, const char *format, ...) {
    if (error == NULL)
        return result;
    va_list arguments;
    va_start(arguments, format);
    fill(error, (aur_location){0}, result, format, arguments);
    va_end(arguments);
    return result;
}

aur_result aur_fail_at(aur_error *error, aur_location location, aur_result result, const char *format, ...) {
    if (error == NULL)
        return result;
    va_list arguments;
    va_start(arguments, format);
    fill(error, location, result, format, arguments);
    va_end(arguments);
    return result;
}

void aur_warn_at(const aur_warnings *warnings, aur_location location, const char *format, ...) {
    if (warnings == NULL || warnings->function == NULL)
        return;
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    const size_t used = format_location(text, sizeof text, location.file, location.line, location.column);
    if (used >= sizeof text)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, sizeof text - used, format, arguments);
    va_end(arguments);
    warnings->function(warnings->user, text);
}

enum { LONGEST_NAME = 63 };

/* Levenshtein distance of two short names. */
static size_t edit_distance(const char *a, const char *b) {
    size_t row[LONGEST_NAME + 1];
    const size_t length_a = strlen(a);
    const size_t length_b = strlen(b);
    for (size_t j = 0; j <= length_b; ++j)
        row[j] = j;
    for (size_t i = 1; i <= length_a; ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= length_b; ++j) {
            const size_t substitute = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            size_t best = substitute < row[j] + 1 ? substitute : row[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            row[j] = best;
        }
    }
    return row[length_b];
}

const char *aur_nearest_name(const char *wanted, size_t count, const char *const *names) {
    const size_t length = strlen(wanted);
    if (length == 0 || length > LONGEST_NAME)
        return NULL;
    const char *best = NULL;
    size_t best_distance = length < 6 ? 3 : length / 2;
    for (size_t i = 0; i < count; ++i) {
        if (strlen(names[i]) > LONGEST_NAME)
            continue;
        const size_t distance = edit_distance(wanted, names[i]);
        if (distance < best_distance) {
            best = names[i];
            best_distance = distance;
        }
    }
    return best;
}
