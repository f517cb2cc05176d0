#include "points/base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"

#define TEXT_OF(number) #number
#define DOTTED(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

const char *aur_version(void) {
    return DOTTED(AUREOLE_VERSION_MAJOR, AUREOLE_VERSION_MINOR, AUREOLE_VERSION_PATCH);
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

/* "FILE:LINE:COLUMN: ", or the parts that are set. */
static size_t format_location(size_t capacity, char *text, const char *file, size_t line, size_t column) {
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

size_t aur_error_format(const aur_error *error, size_t capacity, char *text) {
    const size_t used = format_location(capacity, text, error->file, error->line, error->column);
    const size_t left = used < capacity ? capacity - used : 0;
    const int length = snprintf(left > 0 ? text + used : NULL, left, "%s", error->message);
    return used + (length < 0 ? 0 : (size_t)length);
}

/* A path that does not fit is cut at its beginning: its end names the file. */
static void set_file(aur_error *error, const char *file) {
    const size_t length = strlen(file);
    const size_t room = sizeof error->file - 1;
    const char *const tail = length > room ? file + (length - room) : file;
    memmove(error->file, tail, strlen(tail) + 1);
}

static void fill(aur_error *error, aur_location location, aur_result result, const char *format,
                 va_list arguments) {
    error->result = result;
    error->line = location.line;
    error->column = location.column;
    /* The arguments may point into this error. */
    char message[AUR_ERROR_MESSAGE_CAPACITY];
    aur_format_list(message, sizeof message, format, arguments);
    set_file(error, location.file != NULL ? location.file : "");
    memcpy(error->message, message, strlen(message) + 1);
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

aur_result aur_fail_memory(aur_error *error) {
    return aur_fail_memory_at(error, (aur_location){0});
}

aur_result aur_fail_memory_at(aur_error *error, aur_location location) {
    return aur_fail_at(error, location, AUR_ERROR_MEMORY, "out of memory");
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

aur_result aur_fail_in(aur_error *error, aur_result result, const char *file) {
    if (result != AUR_OK && error != NULL && error->file[0] == '\0')
        set_file(error, file);
    return result;
}

void aur_warn_at(const aur_warnings *warnings, aur_location location, const char *format, ...) {
    if (warnings == NULL || warnings->function == NULL)
        return;
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    const size_t used = format_location(sizeof text, text, location.file, location.line, location.column);
    if (used >= sizeof text)
        return;
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text + used, sizeof text - used, format, arguments);
    va_end(arguments);
    warnings->function(warnings->user, text);
}

void aur_warn_error(const aur_warnings *warnings, const aur_error *error) {
    if (error->result != AUR_OK)
        aur_warn_at(warnings, (aur_location){error->file, error->line, error->column}, "%s", error->message);
}
