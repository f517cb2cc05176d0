/* What reading and writing EXR share. */
#ifndef AUR_IMAGE_EXR_H
#define AUR_IMAGE_EXR_H

#include <openexr.h>

#include "image/format.h"

/* What a context of OpenEXR Core carries for its callbacks. */
typedef struct aur_exr_stream {
    const char *name;
    aur_result result; /* of the first message */
    aur_error *error;
    const unsigned char *input; /* reading */
    size_t size;                /* of input or output */
    unsigned char *output;      /* writing */
    size_t capacity;
} aur_exr_stream;

/* Keeps the first message in the stream's error. */
void aur_exr_note(exr_const_context_t context, exr_result_t code, const char *message);

/* The result of a failed call: what was noted, or else the code's own text. */
aur_result aur_exr_fail(const aur_exr_stream *stream, exr_result_t code);

#endif
