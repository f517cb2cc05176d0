/* EXR files put together by hand, without compression: names and samplings that no library writes. */
#pragma once

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct hand_channel {
    const char *name; /* in the order of the alphabet */
    int type;         /* 0: uint, 1: half, 2: float */
    size_t step[2];   /* samplings in x and y */
    float (*value)(size_t x, size_t y);
} hand_channel;

typedef struct hand_file {
    unsigned char *bytes;
    size_t size;
} hand_file;

static inline void hand_put(hand_file *file, const void *bytes, size_t size) {
    file->bytes = realloc(file->bytes, file->size + size);
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
}

static inline void hand_integer(hand_file *file, uint64_t value, size_t size) {
    for (size_t i = 0; i < size; ++i)
        hand_put(file, &(unsigned char){(unsigned char)(value >> (8 * i))}, 1);
}

static inline void hand_number(hand_file *file, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    hand_integer(file, bits, 4);
}

static inline void hand_attribute(hand_file *file, const char *name, const char *type, size_t size) {
    hand_put(file, name, strlen(name) + 1);
    hand_put(file, type, strlen(type) + 1);
    hand_integer(file, size, 4);
}

/* Of values that half holds exactly, from 2^-14 up. */
static inline uint32_t hand_half(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return value == 0.0f ? 0
                         : (bits >> 16 & 0x8000) | (((bits >> 23 & 255) - 112) << 10) | (bits >> 13 & 1023);
}

static inline void hand_header(hand_file *file, size_t width, size_t height, size_t count,
                               const hand_channel *channels) {
    hand_put(file, "\x76\x2f\x31\x01\2\0\0\0", 8);
    size_t size = 1;
    for (size_t c = 0; c < count; ++c)
        size += strlen(channels[c].name) + 17;
    hand_attribute(file, "channels", "chlist", size);
    for (size_t c = 0; c < count; ++c) {
        hand_put(file, channels[c].name, strlen(channels[c].name) + 1);
        hand_integer(file, (uint64_t)channels[c].type, 4);
        hand_integer(file, 0, 4);
        hand_integer(file, channels[c].step[0], 4);
        hand_integer(file, channels[c].step[1], 4);
    }
    hand_integer(file, 0, 1);
    hand_attribute(file, "compression", "compression", 1);
    hand_integer(file, 0, 1);
    for (size_t i = 0; i < 2; ++i) {
        hand_attribute(file, i == 0 ? "dataWindow" : "displayWindow", "box2i", 16);
        hand_integer(file, 0, 8);
        hand_integer(file, width - 1, 4);
        hand_integer(file, height - 1, 4);
    }
    hand_attribute(file, "lineOrder", "lineOrder", 1);
    hand_integer(file, 0, 1);
    hand_attribute(file, "pixelAspectRatio", "float", 4);
    hand_number(file, 1.0f);
    hand_attribute(file, "screenWindowCenter", "v2f", 8);
    hand_integer(file, 0, 8);
    hand_attribute(file, "screenWindowWidth", "float", 4);
    hand_number(file, 1.0f);
}

static inline void hand_line(hand_file *file, size_t width, size_t y, size_t count,
                             const hand_channel *channels) {
    for (size_t c = 0; c < count; ++c)
        for (size_t x = 0; y % channels[c].step[1] == 0 && x < width; x += channels[c].step[0]) {
            const float value = channels[c].value(x, y);
            if (channels[c].type == 2)
                hand_number(file, value);
            else
                hand_integer(file, channels[c].type == 1 ? hand_half(value) : (uint32_t)value,
                             channels[c].type == 1 ? 2 : 4);
        }
}

/* `bytes` is to be freed. */
static inline hand_file hand_exr(size_t width, size_t height, size_t count, const hand_channel *channels) {
    hand_file file = {NULL, 0};
    hand_header(&file, width, height, count, channels);
    hand_integer(&file, 0, 1);
    const size_t table = file.size;
    for (size_t y = 0; y < height; ++y)
        hand_integer(&file, 0, 8);
    for (size_t y = 0; y < height; ++y) {
        const uint64_t offset = file.size;
        for (size_t i = 0; i < 8; ++i)
            file.bytes[table + 8 * y + i] = (unsigned char)(offset >> (8 * i));
        hand_file line = {NULL, 0};
        hand_line(&line, width, y, count, channels);
        hand_integer(&file, y, 4);
        hand_integer(&file, line.size, 4);
        hand_put(&file, line.bytes, line.size);
        free(line.bytes);
    }
    return file;
}
