/* Converts OpenEXR's errors to those of the library. */
#include "render/image/exr.h"

static aur_result result_of(exr_result_t code) {
    switch (code) {
    case EXR_ERR_OUT_OF_MEMORY:
        return AUR_ERROR_MEMORY;
    case EXR_ERR_FEATURE_NOT_IMPLEMENTED:
        return AUR_ERROR_UNSUPPORTED;
    default:
        return AUR_ERROR_FORMAT;
    }
}

static aur_result fail_with(const aur_exr_stream *stream, exr_result_t code, const char *message) {
    const aur_result result = result_of(code);
    return aur_fail(stream->error, result, "%s: %s", result == AUR_ERROR_FORMAT ? "broken EXR" : "EXR",
                    message);
}

static _Thread_local aur_exr_stream *listening;

void aur_exr_listen(aur_exr_stream *stream) {
    listening = stream;
}

void aur_exr_note(exr_const_context_t context, exr_result_t code, const char *message) {
    (void)context;
    if (listening != NULL && listening->result == AUR_OK)
        listening->result = fail_with(listening, code, message);
}

aur_result aur_exr_fail(const aur_exr_stream *stream, exr_result_t code) {
    if (stream->result != AUR_OK)
        return stream->result;
    return fail_with(stream, code, exr_get_default_error_message(code));
}
