/* What reading and writing EXR share. */
#pragma once

#include <openexr.h>

#include "render/image/format.h"

/* What a context of OpenEXR Core carries for its callbacks. */
typedef struct aur_exr_stream {
    aur_result result; /* of the first message */
    aur_error *error;
    const unsigned char *input; /* reading */
    size_t size;                /* of input or output */
    unsigned char *output;      /* writing */
    size_t capacity;
} aur_exr_stream;

/* Rows of an image whose strides OpenEXR can count. */
static inline bool aur_exr_rows_fit(size_t width, size_t channel_count) {
    return width <= INT32_MAX / sizeof(float) / channel_count;
}

/* The stream whose calls of OpenEXR this thread makes, or NULL: what aur_exr_note writes to. OpenEXR gives
 * its handler of messages a context only, and holds a lock meanwhile that asking the context for its user
 * data would wait for without end. */
void aur_exr_listen(aur_exr_stream *stream);

/* The handler of messages: keeps the first one in the stream's error. */
void aur_exr_note(exr_const_context_t context, exr_result_t code, const char *message);

/* The result of a failed call: what was noted, or else the code's own text. */
aur_result aur_exr_fail(const aur_exr_stream *stream, exr_result_t code);
