
#include <stdlib.h>
#include <string.h>

#include "program/import/writer.h"

typedef struct open_file {
    size_t size, at;
    char *data;
} open_file;

static size_t read_bytes(struct aiFile *file, char *to, size_t size, size_t count) {
    open_file *const self = (open_file *)(void *)file->UserData;
    const size_t left = size > 0 ? (self->size - self->at) / size : 0;
    const size_t taken = count < left ? count : left;
    memcpy(to, self->data + self->at, taken * size);
    self->at += taken * size;
    return taken;
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t report_position(struct aiFile *file) {
    return ((open_file *)(void *)file->UserData)->at;
}

static size_t size_of(struct aiFile *file) {
    return ((open_file *)(void *)file->UserData)->size;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *const self = (open_file *)(void *)file->UserData;
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? self->at : self->size;
    if (base + offset > self->size) /* wraps around, which is correct for a negative offset */
        return aiReturn_FAILURE;
    self->at = base + offset;
    return aiReturn_SUCCESS;
}

static void flush(struct aiFile *file) {
    (void)file;
}

void files_decode_address(char *text) {
    char *out = text;
    for (const char *c = text; *c != '\0'; ++c) {
        char digits[3] = {0}, *end = digits;
        if (c[0] == '%' && c[1] != '\0' && c[2] != '\0') {
            memcpy(digits, c + 1, 2);
            const long code = strtol(digits, &end, 16);
            if (end == digits + 2 && code > 0) {
                *out++ = (char)code;
                c += 2;
                continue;
            }
        }
        *out++ = *c;
    }
    *out = '\0';
}

/* File names begin with what assimp considers the model's folder. */
struct aiFile *files_open(struct aiFileIO *io, const char *name, const char *mode) {
    struct aiFile *const file = calloc(1, sizeof *file);
    open_file *const self = calloc(1, sizeof *self);
    if (file == NULL || self == NULL)
        stream_fail_memory();
    while (strncmp(name, "./", 2) == 0 || strncmp(name, ".\\", 2) == 0)
        name += 2;
    char *const path = strdup(name);
    if (path == NULL)
        stream_fail_memory();
    const model_file *const model = (const model_file *)(const void *)io->UserData;
    const bool is_model = strcmp(path, model->name) == 0;
    if (model->is_gltf && !is_model)
        files_decode_address(path);
    bool found = mode[0] == 'r' && path[0] != '\0';
    if (is_model && model->bytes != NULL) {
        self->size = model->size;
        self->data = malloc(self->size + 1);
        if (self->data == NULL)
            stream_fail_memory();
        memcpy(self->data, model->bytes, self->size);
    } else if (found) {
        stream_send(AUR_IMPORT_OPEN, 0, strlen(path), path);
        found = stream_receive(AUR_IMPORT_ANSWER, &self->size, &self->data) != 0;
    }
    free(path);
    if (!found) {
        free(self->data);
        free(file);
        free(self);
        return NULL;
    }
    *file = (struct aiFile){read_bytes, write_nothing, report_position, size_of, seek, flush, (char *)self};
    return file;
}

void files_close(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    open_file *const self = (open_file *)(void *)file->UserData;
    free(self->data);
    free(self);
    free(file);
}
