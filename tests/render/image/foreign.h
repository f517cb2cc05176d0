/* EXR files as other programs write them, generated with OpenEXR: tiles, windows, every type and compression.
 */
#pragma once

#include <math.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file as other programs write them, by OpenEXR itself. */
typedef struct foreign_file {
    exr_storage_t storage;
    exr_compression_t compression;
    size_t width, height;
    int left, top; /* of the data window */
    int tile;
} foreign_file;

/* Channels in OpenEXR's order: half, half, float, uint. */
static const char *const foreign_names[] = {"B", "id.number", "R", "depth.Z"};
static const exr_pixel_type_t foreign_types[] = {EXR_PIXEL_HALF, EXR_PIXEL_UINT, EXR_PIXEL_HALF,
                                                 EXR_PIXEL_FLOAT};

/* Exact in every type: multiples of 1/8 below 256, whole for uint. Smooth, so that lossy codecs stay close.
 */
static inline float foreign_value(size_t channel, size_t x, size_t y) {
    const float value = (float)((3 * x + 2 * y + 16 * channel) % 1024) / 8.0f;
    return foreign_types[channel] == EXR_PIXEL_UINT ? floorf(value) : value;
}

static inline void must(exr_result_t code) {
    if (code == EXR_ERR_SUCCESS)
        return;
    fprintf(stderr, "OpenEXR: %s\n", exr_get_default_error_message(code));
    abort();
}

static inline void encode_chunk(exr_context_t context, const exr_chunk_info_t *chunk, size_t left,
                                size_t top) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    const size_t width = (size_t)chunk->width, height = (size_t)chunk->height;
    must(exr_encoding_initialize(context, 0, chunk, &pipeline));
    uint32_t *const planes = malloc(4 * width * height * sizeof *planes);
    must(planes != NULL ? EXR_ERR_SUCCESS : EXR_ERR_OUT_OF_MEMORY);
    for (int i = 0; i < pipeline.channel_count; ++i) {
        exr_coding_channel_info_t *const channel = &pipeline.channels[i];
        size_t c = 0;
        while (strcmp(foreign_names[c], channel->channel_name) != 0)
            ++c;
        uint32_t *const plane = planes + c * width * height;
        const int is_uint = foreign_types[c] == EXR_PIXEL_UINT;
        for (size_t y = 0; y < height; ++y) {
            for (size_t x = 0; x < width; ++x) {
                const float value = foreign_value(c, left + x, top + y);
                const uint32_t whole = (uint32_t)value;
                memcpy(&plane[y * width + x], is_uint ? (const void *)&whole : (const void *)&value, 4);
            }
        }
        channel->encode_from_ptr = (const uint8_t *)plane;
        channel->user_bytes_per_element = 4;
        channel->user_data_type = is_uint ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = 4;
        channel->user_line_stride = (int32_t)(4 * width);
    }
    must(exr_encoding_choose_default_routines(context, 0, &pipeline));
    must(exr_encoding_run(context, 0, &pipeline));
    exr_encoding_destroy(context, &pipeline);
    free(planes);
}

static inline void write_foreign(const char *path, const foreign_file *file) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context;
    int part;
    must(exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &setup));
    must(exr_add_part(context, NULL, file->storage, &part));
    exr_attr_box2i_t window;
    window.min.x = file->left;
    window.min.y = file->top;
    window.max.x = file->left + (int)file->width - 1;
    window.max.y = file->top + (int)file->height - 1;
    const exr_attr_v2f_t center = {.x = 0.0f, .y = 0.0f};
    must(exr_initialize_required_attr(context, part, &window, &window, 1.0f, &center, 1.0f,
                                      EXR_LINEORDER_INCREASING_Y, file->compression));
    if (file->storage == EXR_STORAGE_TILED)
        must(exr_set_tile_descriptor(context, part, (uint32_t)file->tile, (uint32_t)file->tile,
                                     EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN));
    for (size_t c = 0; c < 4; ++c)
        must(exr_add_channel(context, part, foreign_names[c], foreign_types[c], EXR_PERCEPTUALLY_LOGARITHMIC,
                             1, 1));
    must(exr_write_header(context));
    exr_chunk_info_t chunk;
    if (file->storage == EXR_STORAGE_TILED) {
        for (size_t y = 0; y < file->height; y += (size_t)file->tile) {
            for (size_t x = 0; x < file->width; x += (size_t)file->tile) {
                must(exr_write_tile_chunk_info(context, 0, (int)x / file->tile, (int)y / file->tile, 0, 0,
                                               &chunk));
                encode_chunk(context, &chunk, x, y);
            }
        }
    } else {
        int32_t lines;
        must(exr_get_scanlines_per_chunk(context, 0, &lines));
        for (size_t y = 0; y < file->height; y += (size_t)lines) {
            must(exr_write_scanline_chunk_info(context, 0, file->top + (int)y, &chunk));
            encode_chunk(context, &chunk, 0, y);
        }
    }
    must(exr_finish(&context));
}
