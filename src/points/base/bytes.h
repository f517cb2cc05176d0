/* Serialisation of values into a byte buffer, and back. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

typedef struct aur_bytes {
    unsigned char *data;
    size_t size, capacity;
    bool failed; /* out of memory */
} aur_bytes;

static inline void aur_bytes_put(aur_bytes *bytes, size_t size, const void *data) {
    if (size == 0 || bytes->failed)
        return;
    bytes->failed = !aur_array_reserve(&bytes->data, &bytes->capacity, bytes->size + size, 1);
    if (bytes->failed)
        return;
    memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
}

static inline void aur_bytes_release(aur_bytes *bytes) {
    free(bytes->data);
    *bytes = (aur_bytes){0};
}

/* Reading: a call beyond the end returns zeros and sets `failed`. */
typedef struct aur_bytes_reader {
    const unsigned char *at, *end;
    bool failed;
} aur_bytes_reader;

static inline void aur_bytes_get(aur_bytes_reader *reader, size_t size, void *data) {
    reader->failed = reader->failed || (size_t)(reader->end - reader->at) < size;
    if (size == 0)
        return;
    if (reader->failed) {
        memset(data, 0, size);
        return;
    }
    memcpy(data, reader->at, size);
    reader->at += size;
}
