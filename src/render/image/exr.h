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

/* Whether the strides of an image's rows fit OpenEXR's types. */
static inline bool aur_exr_rows_fit(size_t width, size_t channel_count) {
    return width <= INT32_MAX / sizeof(float) / channel_count;
}

/* Sets the stream for OpenEXR calls of this thread, or NULL: aur_exr_note writes to it. OpenEXR passes its
 * message handler only a context, and holds a lock during the call: asking the context for its user data
 * would deadlock. */
void aur_exr_listen(aur_exr_stream *stream);

/* The message handler: stores the first message in the stream's error. */
void aur_exr_note(exr_const_context_t context, exr_result_t code, const char *message);

/* The result of a failed call: the stored message, or else the text of the code. */
aur_result aur_exr_fail(const aur_exr_stream *stream, exr_result_t code);
