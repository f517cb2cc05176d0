/* Reading EXR with OpenEXR Core: chunk by chunk, each channel directly into its position in the image. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render/image/exr.h"

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

/* The destination of a file's channel. */
typedef struct channel_order {
    char name[AUR_CHANNEL_NAME_CAPACITY];
    size_t in_file;
} channel_order;

/* A subsampled channel of a file, as stored; `values` is NULL for a full-resolution one. */
typedef struct channel_plane {
    float *values;
    size_t width, height;
} channel_plane;

/* The contents of the image's R, G and B before conversion to RGB. */
typedef enum color_form {
    FORM_RGB,
    FORM_CHROMA, /* RY, Y and BY */
    FORM_XYZ
} color_form;

/* Colours first within a layer. */
static int color_rank(const char *name) {
    const aur_channel_role role = aur_channel_role_of(name);
    return (int)(role < AUR_CHANNEL_OTHER ? role : AUR_CHANNEL_OTHER);
}

static int compare_channels(const void *left, const void *right) {
    const char *const a = ((const channel_order *)left)->name;
    const char *const b = ((const channel_order *)right)->name;
    const size_t layer_a = aur_channel_layer(a), layer_b = aur_channel_layer(b);
    const size_t shorter = layer_a < layer_b ? layer_a : layer_b;
    const int by_layer = strncmp(a, b, shorter);
    if (by_layer != 0 && shorter > 0)
        return by_layer;
    if (layer_a != layer_b)
        return layer_a < layer_b ? -1 : 1;
    const int by_color = color_rank(a) - color_rank(b);
    return by_color != 0 ? by_color : strcmp(a, b);
}

/* A file that is being decoded. */
typedef struct exr_reader {
    aur_exr_stream stream;
    exr_context_t context;
    const exr_attr_chlist_t *channels;
    exr_attr_box2i_t window;
    exr_decode_pipeline_t pipeline;
    bool started;          /* the pipeline has been initialised */
    size_t *channel_index; /* of each channel of the file in the image */
    channel_plane *planes;
    bool subsampled; /* a channel is */
    color_form form;
    aur_image *image;
} exr_reader;

static float half_to_float(uint32_t bits) {
    const uint32_t mantissa = bits & 1023, exponent = bits >> 10 & 31;
    const float size = exponent == 31  ? (mantissa == 0 ? INFINITY : NAN)
                       : exponent == 0 ? ldexpf((float)mantissa, -24)
                                       : ldexpf((float)(1024 + mantissa), (int)exponent - 25);
    return bits >> 15 != 0 ? -size : size;
}

static float value_at(const uint8_t *bytes, exr_pixel_type_t type) {
    const uint32_t low = bytes[0] | (uint32_t)bytes[1] << 8;
    if (type == EXR_PIXEL_HALF)
        return half_to_float(low);
    const uint32_t bits = low | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return type == EXR_PIXEL_UINT ? (float)bits : value;
}

/* Replaces OpenEXR's unpacking for subsampled channels: version 3.1 writes such lines beyond their chunk. A
 * chunk is stored line by line, and a line channel by channel. */
static exr_result_t unpack_chunk(exr_decode_pipeline_t *pipeline) {
    const uint8_t *from = pipeline->unpacked_buffer;
    size_t left = pipeline->chunk.unpacked_size;
    for (int y = 0; y < pipeline->chunk.height; ++y) {
        for (int c = 0; c < pipeline->channel_count; ++c) {
            const exr_coding_channel_info_t *const channel = &pipeline->channels[c];
            if ((pipeline->chunk.start_y + y) % channel->y_samples != 0)
                continue;
            const exr_pixel_type_t type = (exr_pixel_type_t)channel->data_type;
            const size_t width = (size_t)channel->width, size = type == EXR_PIXEL_HALF ? 2 : 4;
            if (width * size > left)
                return EXR_ERR_CORRUPT_CHUNK;
            uint8_t *const line =
                channel->decode_to_ptr + (size_t)(y / channel->y_samples) * (size_t)channel->user_line_stride;
            for (size_t x = 0; x < width; ++x) {
                const float value = value_at(from + x * size, type);
                memcpy(line + x * (size_t)channel->user_pixel_stride, &value, sizeof value);
            }
            from += width * size;
            left -= width * size;
        }
    }
    return EXR_ERR_SUCCESS;
}

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
        const channel_plane *const plane = &reader->planes[c];
        if (plane->values != NULL) {
            const size_t step = (size_t)channel->y_samples, first = (top + step - 1) / step;
            if (channel->width < 0 || channel->height < 0 || (size_t)channel->width > plane->width ||
                first + (size_t)channel->height > plane->height)
                return EXR_ERR_CORRUPT_CHUNK;
            channel->decode_to_ptr = (uint8_t *)(plane->values + first * plane->width);
            channel->user_bytes_per_element = sizeof(float);
            channel->user_data_type = EXR_PIXEL_FLOAT;
            channel->user_pixel_stride = sizeof(float);
            channel->user_line_stride = (int32_t)(plane->width * sizeof(float));
            continue;
        }
        channel->decode_to_ptr = (uint8_t *)(corner + reader->channel_index[c]);
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = (int32_t)(image->channel_count * sizeof(float));
        channel->user_line_stride = (int32_t)(image->width * image->channel_count * sizeof(float));
    }
    code = exr_decoding_choose_default_routines(reader->context, 0, pipeline);
    if (reader->subsampled)
        pipeline->unpack_and_convert_fn = unpack_chunk;
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

/* Forces OpenEXR to read the chunk table, so that a header with excessive claims is refused before memory is
 * allocated. */
static exr_result_t check_chunk_table(exr_reader *reader, exr_storage_t storage) {
    exr_chunk_info_t chunk;
    if (storage == EXR_STORAGE_TILED)
        return exr_read_tile_chunk_info(reader->context, 0, 0, 0, 0, 0, &chunk);
    return exr_read_scanline_chunk_info(reader->context, 0, reader->window.min.y, &chunk);
}

/* The roles of the channels from which R, G and B are converted, or NULL if no conversion is needed. */
static const aur_channel_role *find_form(exr_reader *reader) {
    static const aur_channel_role roles[][3] = {
        [FORM_RGB] = {AUR_CHANNEL_RED, AUR_CHANNEL_GREEN, AUR_CHANNEL_BLUE},
        [FORM_CHROMA] = {AUR_CHANNEL_RY, AUR_CHANNEL_Y, AUR_CHANNEL_BY},
        [FORM_XYZ] = {AUR_CHANNEL_X, AUR_CHANNEL_Y, AUR_CHANNEL_Z}};
    for (color_form form = FORM_RGB; form <= FORM_XYZ; ++form) {
        size_t found = 0;
        for (size_t i = 0; i < 3; ++i)
            found += aur_image_find_role(reader->image, "", roles[form][i]) != SIZE_MAX;
        if (found == 0 || (form != FORM_RGB && found < 3))
            continue;
        reader->form = form;
        return form == FORM_RGB ? NULL : roles[form];
    }
    return NULL;
}

/* Planes for the subsampled channels. */
static aur_result create_planes(exr_reader *reader, aur_error *error) {
    const size_t count = (size_t)reader->channels->num_channels;
    reader->planes = calloc(count, sizeof *reader->planes);
    if (reader->planes == NULL)
        return aur_fail_memory(error);
    for (size_t c = 0; c < count; ++c) {
        const exr_attr_chlist_entry_t *const entry = &reader->channels->entries[c];
        channel_plane *const plane = &reader->planes[c];
        if (entry->x_sampling == 1 && entry->y_sampling == 1)
            continue;
        const size_t x = (size_t)entry->x_sampling, y = (size_t)entry->y_sampling;
        reader->subsampled = true;
        plane->width = (reader->image->width + x - 1) / x;
        plane->height = (reader->image->height + y - 1) / y;
        plane->values = calloc(plane->width * plane->height, sizeof *plane->values);
        if (plane->values == NULL)
            return aur_fail_memory(error);
    }
    return AUR_OK;
}

/* Creates the image with named channels and determines their positions. */
static aur_result create_image(exr_reader *reader, aur_error *error) {
    const size_t count = (size_t)reader->channels->num_channels;
    const size_t width = (size_t)((int64_t)reader->window.max.x - reader->window.min.x + 1);
    const size_t height = (size_t)((int64_t)reader->window.max.y - reader->window.min.y + 1);
    aur_result result = aur_image_create(width, height, count, &reader->image, error);
    if (result != AUR_OK)
        return result;
    channel_order *const order = calloc(count, sizeof *order);
    reader->channel_index = calloc(count, sizeof *reader->channel_index);
    if (order == NULL || reader->channel_index == NULL) {
        free(order);
        return aur_fail_memory(error);
    }
    for (size_t c = 0; c < count && result == AUR_OK; ++c) {
        const char *const name = reader->channels->entries[c].name.str;
        order[c].in_file = c;
        if (strlen(name) >= AUR_CHANNEL_NAME_CAPACITY)
            result = aur_fail(error, AUR_ERROR_FORMAT, "broken EXR: a channel name of more than %d bytes",
                              AUR_CHANNEL_NAME_CAPACITY - 1);
        else
            strcpy(order[c].name, name);
        strcpy(reader->image->channel_names[c], order[c].name);
    }
    const aur_channel_role *const roles = result == AUR_OK ? find_form(reader) : NULL;
    for (size_t c = 0; roles != NULL && c < count; ++c)
        for (size_t i = 0; i < 3; ++i)
            if (aur_image_find_role(reader->image, "", roles[i]) == c)
                strcpy(order[c].name, (const char *const[]){"R", "G", "B"}[i]);
    if (result == AUR_OK)
        qsort(order, count, sizeof *order, compare_channels);
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        reader->channel_index[order[i].in_file] = i;
        strcpy(reader->image->channel_names[i], order[i].name);
    }
    free(order);
    return result;
}

/* Value `at` of a line of `count` samples, one per `sampling` pixels. Chroma between two samples is
 * interpolated as in OpenEXR's RgbaInputFile (ImfRgbaYca.cpp); other values are repeated until the next
 * sample. */
static float between(const float *samples, size_t count, size_t stride, size_t at, size_t sampling,
                     bool smooth) {
    static const float taps[7] = {0.627123f, -0.186077f, 0.087929f, -0.043159f,
                                  0.019597f, -0.007540f, 0.002128f};
    const size_t k = at / sampling, last = count - 1;
    if (!smooth || at % sampling == 0)
        return samples[(k < last ? k : last) * stride];
    if (sampling != 2) {
        const float part = (float)(at % sampling) / (float)sampling;
        return (1.0f - part) * samples[k * stride] + part * samples[(k < last ? k + 1 : k) * stride];
    }
    float sum = 0.0f;
    for (size_t j = 0; j < 7; ++j) {
        const size_t left = k > j ? k - j : 0, right = k + 1 + j < last ? k + 1 + j : last;
        sum += taps[j] * (samples[left * stride] + samples[right * stride]);
    }
    return sum;
}

/* Expands a subsampled channel to full resolution: rows first. */
static aur_result spread_channel(const exr_reader *reader, size_t c, aur_error *error) {
    const exr_attr_chlist_entry_t *const entry = &reader->channels->entries[c];
    const channel_plane *const plane = &reader->planes[c];
    const aur_image *const image = reader->image;
    const aur_channel_role role = aur_channel_role_of(entry->name.str);
    const bool smooth = role == AUR_CHANNEL_RY || role == AUR_CHANNEL_BY;
    float *const rows = malloc(image->width * plane->height * sizeof *rows);
    if (rows == NULL)
        return aur_fail_memory(error);
    for (size_t y = 0; y < plane->height; ++y)
        for (size_t x = 0; x < image->width; ++x)
            rows[y * image->width + x] = between(plane->values + y * plane->width, plane->width, 1, x,
                                                 (size_t)entry->x_sampling, smooth);
    for (size_t y = 0; y < image->height; ++y)
        for (size_t x = 0; x < image->width; ++x)
            image->data[(y * image->width + x) * image->channel_count + reader->channel_index[c]] =
                between(rows + x, plane->height, image->width, y, (size_t)entry->y_sampling, smooth);
    free(rows);
    return AUR_OK;
}

/* Converts the channels stored in R, G and B to RGB. */
static void make_colors(const exr_reader *reader) {
    static const float red = 0.212639f, green = 0.7151687f, blue = 0.0721923f; /* of Y */
    static const float of_xyz[3][3] = {{3.240970f, -1.537383f, -0.498611f},
                                       {-0.969244f, 1.875968f, 0.041555f},
                                       {0.055630f, -0.203977f, 1.056972f}};
    aur_image *const image = reader->image;
    for (size_t i = 0; i < image->width * image->height; ++i) {
        float *const rgb = image->data + i * image->channel_count; /* colours come first */
        const float a = rgb[0], b = rgb[1], c = rgb[2];
        if (reader->form == FORM_CHROMA) {
            rgb[0] = (a + 1.0f) * b;
            rgb[2] = (c + 1.0f) * b;
            rgb[1] = (b - red * rgb[0] - blue * rgb[2]) / green;
        }
        for (size_t k = 0; reader->form == FORM_XYZ && k < 3; ++k)
            rgb[k] = of_xyz[k][0] * a + of_xyz[k][1] * b + of_xyz[k][2] * c;
    }
    if (reader->form == FORM_XYZ)
        aur_image_note(image, "its X, Y, Z are read as CIE XYZ and became R, G, B");
}

/* Notes how to interpret the values. */
static void add_notes(const exr_reader *reader) {
    static const float usual[8] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
    exr_attr_chromaticities_t c;
    int parts = 1;
    if (exr_get_count(reader->context, &parts) == EXR_ERR_SUCCESS && parts > 1)
        aur_image_note(reader->image, "of its %d parts the first is read", parts);
    if (reader->form == FORM_XYZ ||
        exr_attr_get_chromaticities(reader->context, 0, "chromaticities", &c) != EXR_ERR_SUCCESS)
        return;
    const float there[8] = {c.red_x, c.red_y, c.green_x, c.green_y, c.blue_x, c.blue_y, c.white_x, c.white_y};
    bool other = false;
    for (size_t i = 0; i < 8; ++i)
        other = other || !(fabsf(there[i] - usual[i]) < 2e-3f);
    if (other)
        aur_image_note(reader->image,
                       "its chromaticities are not those of Rec. 709: colours are read as if they were");
}

/* The most bytes of pixels that one byte of a chunk can expand to: deflate's limit with a margin; lossy DWA
 * may exceed it by its blocks. */
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

/* Refuses a header that claims more pixels than the file can hold, before memory is allocated. */
static aur_result check_length(const exr_reader *reader, uint64_t pixels, aur_error *error) {
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    exr_get_compression(reader->context, 0, &compression);
    uint64_t bytes = 0;
    for (int c = 0; c < reader->channels->num_channels; ++c) {
        const exr_attr_chlist_entry_t *const entry = &reader->channels->entries[c];
        const uint64_t values = pixels / (uint64_t)entry->x_sampling / (uint64_t)entry->y_sampling;
        bytes += entry->pixel_type == EXR_PIXEL_HALF ? values * 2 : values * 4;
    }
    if (bytes / largest_ratio(compression) <= reader->stream.size)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_FORMAT,
                    "broken EXR: %zu bytes cannot hold the %llu pixels that it claims", reader->stream.size,
                    (unsigned long long)pixels);
}

static aur_result check_header(exr_reader *reader, exr_storage_t storage, aur_error *error) {
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a deep EXR: only flat images can be read");
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
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    exr_get_compression(reader->context, 0, &compression);
    const bool is_b44 = compression == EXR_COMPRESSION_B44 || compression == EXR_COMPRESSION_B44A;
    int halves = 0;
    for (int c = 0; c < count; ++c) {
        const exr_attr_chlist_entry_t *const entry = &reader->channels->entries[c];
        halves += entry->pixel_type == EXR_PIXEL_HALF;
        if (entry->x_sampling < 1 || entry->y_sampling < 1)
            return aur_fail(error, AUR_ERROR_FORMAT, "broken EXR: channel %s is sampled every %d x %d pixels",
                            entry->name.str, (int)entry->x_sampling, (int)entry->y_sampling);
    }
    if (is_b44 && halves == 0 && count > 1)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "an EXR of compression B44 without channels of 16 bits, which OpenEXR's C library mixes up");
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
    if (result == AUR_OK)
        result = create_planes(reader, error);
    if (result != AUR_OK)
        return result;
    code = storage == EXR_STORAGE_TILED ? decode_tiles(reader) : decode_lines(reader);
    if (code != EXR_ERR_SUCCESS)
        return aur_exr_fail(&reader->stream, code);
    for (size_t c = 0; c < (size_t)reader->channels->num_channels && result == AUR_OK; ++c)
        if (reader->planes[c].values != NULL)
            result = spread_channel(reader, c, error);
    if (result == AUR_OK && reader->form != FORM_RGB)
        make_colors(reader);
    if (result == AUR_OK)
        add_notes(reader);
    return result;
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
    for (int c = 0; reader.planes != NULL && c < reader.channels->num_channels; ++c)
        free(reader.planes[c].values);
    if (reader.started)
        exr_decoding_destroy(reader.context, &reader.pipeline);
    if (code == EXR_ERR_SUCCESS)
        exr_finish(&reader.context);
    aur_exr_listen(NULL);
    free(reader.planes);
    free(reader.channel_index);
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
