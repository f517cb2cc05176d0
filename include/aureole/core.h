/* Results, errors and the version: what every other header of Aureole uses.
 *
 * Structs of options begin with `size`, which the caller sets, so that they can grow in later versions:
 *     aur_weights_options options = {.size = sizeof options};
 *     aur_weights_options_init(&options, NULL);
 * aur_..._init fills the struct with its defaults. Its only error is ARGUMENT: `size` is not set. Structs
 * without `size` never grow: errors, callbacks, vectors, rotations, lobes, outputs, moments, hours and notes
 * of weather, reports of weights. Rows of tables are read by pointer; elements of arrays of results grow
 * where the function takes the size of one.
 *
 * Enumerations that users name in text have aur_..._from_name and aur_..._name. */
#ifndef AUREOLE_CORE_H
#define AUREOLE_CORE_H

#include <aureole/version.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define AUR_API __attribute__((visibility("default")))
#define AUR_NONNULL(...) __attribute__((nonnull(__VA_ARGS__)))
#define AUR_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define AUR_API
#define AUR_NONNULL(...)
#define AUR_PRINTF(text, first)
#endif

/* Replaces AUR_API where a function, its structs and its results may change in any version. */
#define AUR_EXPERIMENTAL AUR_API

#ifdef __cplusplus
extern "C" {
#endif

/* What a function that can fail returns: 0 is success, negative is failure. The numbers never change. */
typedef enum aur_result {
    AUR_OK = 0,
    AUR_ERROR_INTERNAL = -1,     /* a defect of the library or of one that it uses */
    AUR_ERROR_MEMORY = -2,       /* an allocation failed */
    AUR_ERROR_CANCELLED = -3,    /* the progress callback requested a stop */
    AUR_ERROR_ARGUMENT = -10,    /* an argument is out of its range */
    AUR_ERROR_CAPACITY = -11,    /* an output buffer is too small */
    AUR_ERROR_NAME = -12,        /* no such set, plugin, metric or key */
    AUR_ERROR_UNSUPPORTED = -13, /* the combination is valid but has no meaning or no implementation */
    AUR_ERROR_FORMAT = -20,      /* a file or text has invalid contents */
    AUR_ERROR_OPEN = -30,        /* a file cannot be opened or read */
    AUR_ERROR_WRITE = -31        /* a file cannot be written */
} aur_result;

/* The result's name in a few words: static storage, never NULL. */
AUR_API const char *aur_result_string(aur_result result);

enum { AUR_ERROR_FILE_CAPACITY = 1024, AUR_ERROR_MESSAGE_CAPACITY = 1024 };

/* A readable error. `file` is empty when no file is concerned; line and column count from 1 and are 0 when
 * unknown. Every aur_error pointer parameter may be NULL. */
typedef struct aur_error {
    aur_result result;
    size_t line;
    size_t column;
    char file[AUR_ERROR_FILE_CAPACITY];
    char message[AUR_ERROR_MESSAGE_CAPACITY];
} aur_error;

/* Writes "FILE:LINE:COLUMN: message" (or the parts that are set) into text[capacity], always terminated.
 * Returns the length of the whole text, as snprintf does. */
AUR_API size_t aur_error_format(const aur_error *error, size_t capacity, char *text) AUR_NONNULL(1);

/* Fills `error` (may be NULL) with a result and a formatted message, and returns that result. For callbacks
 * that fail, and for programs that report errors in the library's form. */
AUR_API aur_result aur_fail(aur_error *error, aur_result result, const char *format, ...) AUR_NONNULL(3)
    AUR_PRINTF(3, 4);

/* Called at intervals with 0 <= done <= total; total is 0 while the amount of work is unknown. Any thread may
 * call it, but only one at a time for each call of the library. A non-zero return cancels the work, which
 * then ends with AUR_ERROR_CANCELLED. The callback may call the library. */
typedef int (*aur_progress_function)(void *user, const char *what, uint64_t done, uint64_t total);

typedef struct aur_progress {
    aur_progress_function function; /* NULL: no reports */
    void *user;
} aur_progress;

/* Receives each warning. The message begins with "FILE:LINE:COLUMN: ", or with those of the three that are
 * known. */
typedef void (*aur_warning_function)(void *user, const char *message);

typedef struct aur_warnings {
    aur_warning_function function; /* NULL: warnings are dropped */
    void *user;
} aur_warnings;

/* Replaces the file `path` atomically by data[size] ("-": standard output). Errors: WRITE, MEMORY. */
AUR_API aur_result aur_file_write(const char *path, size_t size, const void *data, aur_error *error)
    AUR_NONNULL(1);

/* For programs: names a file that this process will write ("-": standard output, which is ignored). After the
 * first call no input of the library may be an output: reading a file that was named here fails, and so does
 * replacing a file that has been read, by any path or link. Errors: ARGUMENT where `path` was named before or
 * has been read; MEMORY. */
AUR_API aur_result aur_file_announce_output(const char *path, aur_error *error) AUR_NONNULL(1);

/* "major.minor.patch" of the library in use; version.h has the version of the headers. */
AUR_API const char *aur_version(void);

#ifdef __cplusplus
}
#endif

#endif
