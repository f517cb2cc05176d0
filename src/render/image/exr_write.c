/* Writing EXR with OpenEXR Core: scan lines, ZIP. The file is put together in memory, since its chunk table
 * is filled in last and standard output cannot go back. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "render/image/exr.h"

static int64_t write_bytes(exr_const_context_t context, void *user, const void *buffer, uint64_t count,
                           uint64_t offset, exr_stream_error_func_ptr_t fail) {
    aur_exr_stream *const stream = user;
    const size_t end = (size_t)(offset + count);
    const size_t before = stream->capacity;
    if (!aur_array_reserve(&stream->output, &stream->capacity, end, 1)) {
        fail(context, EXR_ERR_OUT_OF_MEMORY, "out of memory");
        return -1;
    }
    memset(stream->output + before, 0, stream->capacity - before);
    memcpy(stream->output + offset, buffer, count);
    if (end > stream->size)
        stream->size = end;
    return (int64_t)count;
}

static aur_result check_names(const aur_image *image, aur_error *error) {
    for (size_t c = 0; c < image->channel_count; ++c) {
        const char *const name = image->channel_names[c];
        if (name[0] == '\0')
            return aur_fail(error, AUR_ERROR_ARGUMENT, "channel %zu has no name, which EXR needs", c);
        if (aur_image_find_channel(image, name) != c)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "two channels are named '%s'", name);
    }
    if (!aur_exr_rows_fit(image->width, image->channel_count) || image->height > INT32_MAX)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rows of %zu pixels with %zu channels are too long for EXR", image->width,
                        image->channel_count);
    return AUR_OK;
}

/* Whether a channel's name exceeds the 31 bytes of the original EXR format. */
static bool has_long_name(const aur_image *image) {
    for (size_t c = 0; c < image->channel_count; ++c)
        if (strlen(image->channel_names[c]) > 31)
            return true;
    return false;
}

static exr_result_t write_header(exr_context_t context, const aur_image *image, bool half) {
    int part;
    exr_result_t code = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS)
        code = exr_initialize_required_attr_simple(context, part, (int32_t)image->width,
                                                   (int32_t)image->height, EXR_COMPRESSION_ZIP);
    for (size_t c = 0; code == EXR_ERR_SUCCESS && c < image->channel_count; ++c)
        code = exr_add_channel(context, part, image->channel_names[c],
                               half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return code == EXR_ERR_SUCCESS ? exr_write_header(context) : code;
}

/* Clamps to the range of a half; infinities and NaN are unchanged. */
static float half_value(float value) {
    const float largest = 65504.0f;
    return isfinite(value) ? fmaxf(-largest, fminf(value, largest)) : value;
}

/* The library's chunk writer, which write_chunk replaces and calls. */
typedef struct chunk_writer {
    exr_result_t (*write)(exr_encode_pipeline_t *pipeline);
} chunk_writer;

/* Readers take a chunk as uncompressed if it is as long as its uncompressed data, but up to 3.4 the library
 * writes the compressed bytes anyway (OpenEXR issue 2306). Writes the uncompressed data instead. */
static exr_result_t write_chunk(exr_encode_pipeline_t *pipeline) {
    const chunk_writer *const library = pipeline->encoding_user_data;
    if (pipeline->compressed_bytes == pipeline->packed_bytes && pipeline->compressed_buffer != NULL &&
        pipeline->compressed_buffer != pipeline->packed_buffer)
        memcpy(pipeline->compressed_buffer, pipeline->packed_buffer, pipeline->packed_bytes);
    return library->write(pipeline);
}

static exr_result_t write_chunks(exr_context_t context, const aur_image *image, bool half, float *rows,
                                 int32_t lines) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    chunk_writer library = {NULL};
    const size_t row_values = image->width * image->channel_count;
    exr_result_t code = EXR_ERR_SUCCESS;
    for (size_t y = 0; code == EXR_ERR_SUCCESS && y < image->height; y += (size_t)lines) {
        exr_chunk_info_t chunk;
        code = exr_write_scanline_chunk_info(context, 0, (int)y, &chunk);
        if (code == EXR_ERR_SUCCESS)
            code = y == 0 ? exr_encoding_initialize(context, 0, &chunk, &pipeline)
                          : exr_encoding_update(context, 0, &chunk, &pipeline);
        if (code != EXR_ERR_SUCCESS)
            break;
        const size_t count = (size_t)chunk.height * row_values;
        for (size_t i = 0; i < count; ++i) {
            const float value = image->data[y * row_values + i];
            rows[i] = half ? half_value(value) : value;
        }
        for (int c = 0; c < pipeline.channel_count; ++c) {
            exr_coding_channel_info_t *const channel = &pipeline.channels[c];
            const size_t index = aur_image_find_channel(image, channel->channel_name);
            channel->encode_from_ptr = (const uint8_t *)(rows + index);
            channel->user_bytes_per_element = sizeof(float);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            channel->user_pixel_stride = (int32_t)(image->channel_count * sizeof(float));
            channel->user_line_stride = (int32_t)(row_values * sizeof(float));
        }
        code = exr_encoding_choose_default_routines(context, 0, &pipeline);
        if (pipeline.write_fn != write_chunk) {
            library.write = pipeline.write_fn;
            pipeline.encoding_user_data = &library;
            pipeline.write_fn = write_chunk;
        }
        if (code == EXR_ERR_SUCCESS)
            code = exr_encoding_run(context, 0, &pipeline);
    }
    exr_encoding_destroy(context, &pipeline);
    return code;
}

static exr_result_t write_pixels(exr_context_t context, const aur_image *image, bool half) {
    int32_t lines;
    const exr_result_t code = exr_get_scanlines_per_chunk(context, 0, &lines);
    if (code != EXR_ERR_SUCCESS)
        return code;
    float *const rows = malloc((size_t)lines * image->width * image->channel_count * sizeof *rows);
    if (rows == NULL)
        return EXR_ERR_OUT_OF_MEMORY;
    const exr_result_t written = write_chunks(context, image, half, rows, lines);
    free(rows);
    return written;
}

aur_result aur_image_write_exr(const aur_image_target *target, const aur_image *image, aur_error *error) {
    aur_result result = check_names(image, error);
    if (result != AUR_OK)
        return result;
    aur_exr_stream stream = {.error = error};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = aur_exr_note;
    setup.user_data = &stream;
    setup.write_fn = write_bytes;
    exr_context_t context = NULL;
    aur_exr_listen(&stream);
    exr_result_t code = exr_start_write(&context, target->name, EXR_WRITE_FILE_DIRECTLY, &setup);
    if (code == EXR_ERR_SUCCESS) {
        /* A mark in the file that only files with such names need. */
        code = exr_set_longname_support(context, has_long_name(image));
        if (code == EXR_ERR_SUCCESS)
            code = write_header(context, image, target->options.half);
        if (code == EXR_ERR_SUCCESS)
            code = write_pixels(context, image, target->options.half);
        const exr_result_t finished = exr_finish(&context);
        if (code == EXR_ERR_SUCCESS)
            code = finished;
    }
    aur_exr_listen(NULL);
    if (code == EXR_ERR_SUCCESS)
        fwrite(stream.output, 1, stream.size, target->stream);
    else
        result = aur_exr_fail(&stream, code);
    free(stream.output);
    return result;
}
