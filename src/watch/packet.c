#include "watch/packet.h"

#include <stdlib.h>
#include <string.h>

/* Kinds of packets. */
enum { CLOSE_IMAGE = 2, CREATE_IMAGE = 4, UPDATE_IMAGE_3 = 6 };

static void put(watch_packet *packet, size_t size, const void *data) {
    if (packet->size + size > packet->capacity && !packet->failed) {
        const size_t capacity = 2 * (packet->size + size);
        unsigned char *const bytes = realloc(packet->bytes, capacity);
        packet->failed = bytes == NULL;
        packet->bytes = packet->failed ? packet->bytes : bytes;
        packet->capacity = packet->failed ? packet->capacity : capacity;
    }
    if (packet->failed)
        return;
    memcpy(packet->bytes + packet->size, data, size);
    packet->size += size;
}

/* The lowest `count` bytes, the lowest one first. */
static void put_number(watch_packet *packet, size_t count, uint64_t value) {
    unsigned char bytes[8];
    for (size_t i = 0; i < count; ++i)
        bytes[i] = (unsigned char)(value >> 8 * i);
    put(packet, count, bytes);
}

static void put_text(watch_packet *packet, const char *text) {
    put(packet, strlen(text) + 1, text);
}

static void begin(watch_packet *packet, unsigned kind) {
    packet->size = 0;
    put_number(packet, 4, 0); /* the count comes in the end */
    put_number(packet, 1, kind);
}

static void end(watch_packet *packet) {
    const size_t size = packet->size;
    packet->size = 0;
    put_number(packet, 4, size);
    packet->size = size;
}

static void put_channels(watch_packet *packet, const aur_image *image) {
    const size_t channels = aur_image_channel_count(image);
    put_number(packet, 4, channels);
    for (size_t c = 0; c < channels; ++c)
        put_text(packet, aur_image_channel_name(image, c));
}

void watch_packet_create(watch_packet *packet, const char *name, const aur_image *image) {
    begin(packet, CREATE_IMAGE);
    put_number(packet, 1, 1); /* it is to be seen at once */
    put_text(packet, name);
    put_number(packet, 4, aur_image_width(image));
    put_number(packet, 4, aur_image_height(image));
    put_channels(packet, image);
    end(packet);
}

void watch_packet_update(watch_packet *packet, const char *name, const aur_image *image,
                         const watch_part *part) {
    const size_t channels = aur_image_channel_count(image);
    begin(packet, UPDATE_IMAGE_3);
    put_number(packet, 1, 0);
    put_text(packet, name);
    put_channels(packet, image);
    put_number(packet, 4, part->x);
    put_number(packet, 4, part->y);
    put_number(packet, 4, part->width);
    put_number(packet, 4, part->height);
    for (size_t c = 0; c < channels; ++c) /* where its first value is */
        put_number(packet, 8, c);
    for (size_t c = 0; c < channels; ++c) /* and how far its next one */
        put_number(packet, 8, channels);
    for (size_t y = part->y; y < part->y + part->height; ++y) {
        const float *const line = aur_image_data(image) + (y * aur_image_width(image) + part->x) * channels;
        for (size_t i = 0; i < part->width * channels; ++i) {
            uint32_t bits;
            memcpy(&bits, &line[i], sizeof bits);
            put_number(packet, 4, bits);
        }
    }
    end(packet);
}

void watch_packet_close(watch_packet *packet, const char *name) {
    begin(packet, CLOSE_IMAGE);
    put_text(packet, name);
    end(packet);
}
