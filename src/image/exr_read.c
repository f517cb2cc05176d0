/* Reading EXR with OpenEXR Core: chunk by chunk, each channel straight into its place in the image. */
#include <stdlib.h>
#include <string.h>

#include "image/exr.h"

static bool recognize(const aur_image_source *source) {
    return aur_image_begins(source, "\x76\x2f\x31\x01", 4);
}

static int64_t read_bytes(exr_const_context_t context, void *user, void *buffer, uint64_t count,
                          uint64_t offset, exr_stream_error_func_ptr_t fail) {
    (void)context;
    (void)fail;
    const aur_exr_stream *const stream = user;
    if (offset >= stream->size)
        return 0;
    const uint64_t left = stream->size - offset;
    const uint64_t taken = count < left ? count : left;
    memcpy(buffer, stream->input + offset, taken);
    return (int64_t)taken;
}

static int64_t stream_size(exr_const_context_t context, void *user) {
    (void)context;
    return (int64_t)((const aur_exr_stream *)user)->size;
}

/* Where a channel of the file goes. */
typedef struct channel_order {
    const char *name;
    size_t in_file;
} channel_order;

/* R, G, B, Y, A within a layer, before its other channels; X and Z stand about Y, which is then no luminance.
 */
static int color_rank(const char *name) {
    const char *const colors = "RGBXYAZ";
    const char *const found = name[0] != '\0' && name[1] == '\0' ? strchr(colors, name[0]) : NULL;
    return found != NULL ? (int)(found - colors) : 7;
}

static const char *after_layer(const char *name) {
    const char *const dot = strrchr(name, '.');
    return dot != NULL ? dot + 1 : name;
}

static int compare_channels(const void *left, const void *right) {
    const char *const a = ((const channel_order *)left)->name;
    const char *const b = ((const channel_order *)right)->name;
    const size_t layer_a = (size_t)(after_layer(a) - a), layer_b = (size_t)(after_layer(b) - b);
    const size_t shorter = layer_a < layer_b ? layer_a : layer_b;
    const int by_layer = strncmp(a, b, shorter);
    if (by_layer != 0 && shorter > 0)
        return by_layer;
    if (layer_a != layer_b)
        return layer_a < layer_b ? -1 : 1;
    const int by_color = color_rank(a + layer_a) - color_rank(b + layer_b);
    return by_color != 0 ? by_color : strcmp(a, b);
}

/* A file that is being decoded. */
typedef struct exr_reader {
    aur_exr_stream stream;
    exr_context_t context;
    const exr_attr_chlist_t *channels;
    exr_attr_box2i_t window;
    exr_decode_pipeline_t pipeline;
    bool started;  /* the pipeline has been initialised */
    size_t *place; /* of each channel of the file in the image */
    aur_image *image;
} exr_reader;

static exr_result_t decode_chunk(exr_reader *reader, const exr_chunk_info_t *chunk, size_t left, size_t top) {
    const aur_image *const image = reader->image;
    if (chunk->width < 0 || chunk->height < 0 || left + (size_t)chunk->width > image->width ||
        top + (size_t)chunk->height > image->height)
        return EXR_ERR_CORRUPT_CHUNK;
    exr_decode_pipeline_t *const pipeline = &reader->pipeline;
    exr_result_t code = reader->started ? exr_decoding_update(reader->context, 0, chunk, pipeline)
                                        : exr_decoding_initialize(reader->context, 0, chunk, pipeline);
    if (code != EXR_ERR_SUCCESS)
        return code;
    reader->started = true;
    float *const corner = image->data + (top * image->width + left) * image->channel_count;
    for (int c = 0; c < pipeline->channel_count; ++c) {
        exr_coding_channel_info_t *const channel = &pipeline->channels[c];
        channel->decode_to_ptr = (uint8_t *)(corner + reader->place[c]);
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = (int32_t)(image->channel_count * sizeof(float));
        channel->user_line_stride = (int32_t)(image->width * image->channel_count * sizeof(float));
    }
    code = exr_decoding_choose_default_routines(reader->context, 0, pipeline);
    return code == EXR_ERR_SUCCESS ? exr_decoding_run(reader->context, 0, pipeline) : code;
}

static exr_result_t decode_lines(exr_reader *reader) {
    int32_t lines;
    exr_result_t code = exr_get_scanlines_per_chunk(reader->context, 0, &lines);
    if (code == EXR_ERR_SUCCESS && lines < 1)
        code = EXR_ERR_INVALID_ATTR;
    for (int64_t y = reader->window.min.y; code == EXR_ERR_SUCCESS && y <= reader->window.max.y; y += lines) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(reader->context, 0, (int)y, &chunk);
        if (code == EXR_ERR_SUCCESS)
            code = decode_chunk(reader, &chunk, 0, (size_t)(y - reader->window.min.y));
    }
    return code;
}

static exr_result_t decode_tiles(exr_reader *reader) {
    int32_t width, height;
    exr_result_t code = exr_get_tile_sizes(reader->context, 0, 0, 0, &width, &height);
    if (code == EXR_ERR_SUCCESS && (width < 1 || height < 1))
        code = EXR_ERR_INVALID_ATTR;
    for (size_t top = 0; code == EXR_ERR_SUCCESS && top < reader->image->height; top += (size_t)height) {
        for (size_t left = 0; code == EXR_ERR_SUCCESS && left < reader->image->width; left += (size_t)width) {
            exr_chunk_info_t chunk;
            code = exr_read_tile_chunk_info(reader->context, 0, (int)(left / (size_t)width),
                                            (int)(top / (size_t)height), 0, 0, &chunk);
            if (code == EXR_ERR_SUCCESS)
                code = decode_chunk(reader, &chunk, left, top);
        }
    }
    return code;
}

/* Forces the chunk table to be read, so that a header that claims more than there is costs no memory. */
static exr_result_t check_chunk_table(exr_reader *reader, exr_storage_t storage) {
    exr_chunk_info_t chunk;
    if (storage == EXR_STORAGE_TILED)
        return exr_read_tile_chunk_info(reader->context, 0, 0, 0, 0, 0, &chunk);
    return exr_read_scanline_chunk_info(reader->context, 0, reader->window.min.y, &chunk);
}

/* The image, with its channels named and their places known. */
static aur_result create_image(exr_reader *reader, aur_error *error) {
    const size_t count = (size_t)reader->channels->num_channels;
    const size_t width = (size_t)((int64_t)reader->window.max.x - reader->window.min.x + 1);
    const size_t height = (size_t)((int64_t)reader->window.max.y - reader->window.min.y + 1);
    aur_result result = aur_image_create(width, height, count, &reader->image, error);
    if (result != AUR_OK)
        return result;
    channel_order *const order = calloc(count, sizeof *order);
    reader->place = calloc(count, sizeof *reader->place);
    if (order == NULL || reader->place == NULL) {
        free(order);
        return aur_fail_memory(error);
    }
    for (size_t c = 0; c < count; ++c)
        order[c] = (channel_order){.name = reader->channels->entries[c].name.str, .in_file = c};
    qsort(order, count, sizeof *order, compare_channels);
    for (size_t i = 0; i < count; ++i) {
        reader->place[order[i].in_file] = i;
        if (strlen(order[i].name) >= AUR_CHANNEL_NAME_CAPACITY)
            result = aur_fail(error, AUR_ERROR_FORMAT, "broken EXR: a channel name of more than %d bytes",
                              AUR_CHANNEL_NAME_CAPACITY - 1);
        else
            strcpy(reader->image->channel_names[i], order[i].name);
    }
    free(order);
    return result;
}

/* How many bytes of pixels one byte of a chunk can become at most: deflate's limit, with room; lossy DWA may
 * do better by its blocks. */
static uint64_t largest_ratio(exr_compression_t compression) {
    switch (compression) {
    case EXR_COMPRESSION_NONE:
        return 1;
    case EXR_COMPRESSION_DWAA:
    case EXR_COMPRESSION_DWAB:
        return 1 << 16;
    default:
        return 1 << 11;
    }
}

/* Refuses a header that claims more pixels than the file can hold, before memory is taken for them. */
static aur_result check_length(const exr_reader *reader, uint64_t pixels, aur_error *error) {
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    exr_get_compression(reader->context, 0, &compression);
    uint64_t bytes = 0;
    for (int c = 0; c < reader->channels->num_channels; ++c)
        bytes += reader->channels->entries[c].pixel_type == EXR_PIXEL_HALF ? pixels * 2 : pixels * 4;
    if (bytes / largest_ratio(compression) <= reader->stream.size)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_FORMAT,
                    "broken EXR: %zu bytes cannot hold the %llu pixels that it claims", reader->stream.size,
                    (unsigned long long)pixels);
}

static aur_result check_header(exr_reader *reader, exr_storage_t storage, aur_error *error) {
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a deep EXR: only flat pictures can be read");
    const int64_t width = (int64_t)reader->window.max.x - reader->window.min.x + 1;
    const int64_t height = (int64_t)reader->window.max.y - reader->window.min.y + 1;
    const int count = reader->channels->num_channels;
    const aur_result result = aur_image_check_size(width > 0 ? (size_t)width : 0,
                                                   height > 0 ? (size_t)height : 0, (size_t)count, error);
    if (result != AUR_OK)
        return result;
    if (!aur_exr_rows_fit((size_t)width, (size_t)count))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rows of %lld pixels with %d channels are too long for EXR", (long long)width, count);
    for (int c = 0; c < count; ++c) {
        const exr_attr_chlist_entry_t *const entry = &reader->channels->entries[c];
        if (entry->x_sampling != 1 || entry->y_sampling != 1)
            return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                            "the EXR's channel %s is subsampled: only full channels can be read",
                            entry->name.str);
    }
    return check_length(reader, (uint64_t)width * (uint64_t)height, error);
}

static aur_result read_part(exr_reader *reader) {
    aur_error *const error = reader->stream.error;
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    exr_result_t code = exr_get_storage(reader->context, 0, &storage);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_data_window(reader->context, 0, &reader->window);
    if (code == EXR_ERR_SUCCESS)
        code = exr_get_channels(reader->context, 0, &reader->channels);
    if (code != EXR_ERR_SUCCESS)
        return aur_exr_fail(&reader->stream, code);
    aur_result result = check_header(reader, storage, error);
    if (result != AUR_OK)
        return result;
    code = check_chunk_table(reader, storage);
    if (code != EXR_ERR_SUCCESS)
        return aur_exr_fail(&reader->stream, code);
    result = create_image(reader, error);
    if (result != AUR_OK)
        return result;
    code = storage == EXR_STORAGE_TILED ? decode_tiles(reader) : decode_lines(reader);
    return code == EXR_ERR_SUCCESS ? AUR_OK : aur_exr_fail(&reader->stream, code);
}

static aur_result read_exr(const aur_image_source *source, aur_image **image, aur_error *error) {
    exr_reader reader = {.stream = {.error = error, .input = source->data, .size = source->size},
                         .pipeline = EXR_DECODE_PIPELINE_INITIALIZER};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = aur_exr_note;
    setup.user_data = &reader.stream;
    setup.read_fn = read_bytes;
    setup.size_fn = stream_size;
    setup.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    aur_exr_listen(&reader.stream);
    const exr_result_t code = exr_start_read(&reader.context, source->name, &setup);
    const aur_result result =
        code == EXR_ERR_SUCCESS ? read_part(&reader) : aur_exr_fail(&reader.stream, code);
    if (reader.started)
        exr_decoding_destroy(reader.context, &reader.pipeline);
    if (code == EXR_ERR_SUCCESS)
        exr_finish(&reader.context);
    aur_exr_listen(NULL);
    free(reader.place);
    *image = reader.image;
    return result;
}

static const aur_key keys[] = {
    {AUR_KEY_OF_BOOLEAN(aur_image_write_options, "half", half, "false",
                        "write floats of 16 bits, not of 32")},
};

const aur_image_format aur_image_format_exr = {
    .row = {.name = "exr",
            .summary = "OpenEXR: any channels, floats of 32 or 16 bits; flat, with scan lines or tiles",
            .source = "",
            AUR_ROW_KEYS(keys)},
    .name = "EXR",
    .every_channel = true,
    .recognize = recognize,
    .read = read_exr,
    .write = aur_image_write_exr};
