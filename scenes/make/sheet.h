/* A text that becomes a file once it is complete. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct sheet {
    FILE *stream; /* NULL: not open */
    char *text;
    size_t size;
} sheet;

static inline aur_result sheet_open(sheet *s, aur_error *error) {
    *s = (sheet){0};
    s->stream = open_memstream(&s->text, &s->size);
    return s->stream != NULL ? AUR_OK : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
}

static inline void sheet_abandon(sheet *s) {
    if (s->stream != NULL)
        fclose(s->stream);
    free(s->text);
    *s = (sheet){0};
}

static inline aur_result sheet_write(sheet *s, const char *path, aur_error *error) {
    const bool complete = fflush(s->stream) == 0 && ferror(s->stream) == 0;
    const aur_result result = complete ? aur_file_write(path, s->size, s->text, error)
                                       : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    sheet_abandon(s);
    return result;
}
