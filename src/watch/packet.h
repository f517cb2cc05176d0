/* Packets of tev's protocol (see display.h): CreateImage, the third version of UpdateImage, CloseImage. */
#pragma once

#include <aureole/image.h>

/* Start with zeros; each of the functions below writes another packet in the same memory, `bytes`, which is
 * the caller's to free. */
typedef struct watch_packet {
    size_t size, capacity;
    unsigned char *bytes;
    bool failed; /* out of memory */
} watch_packet;

typedef struct watch_part {
    size_t x, y, width, height; /* in pixels of the picture */
} watch_part;

/* A black picture with the size and the channels of `image`. */
void watch_packet_create(watch_packet *packet, const char *name, const aur_image *image);
/* A part of the picture, all its channels pixel by pixel. */
void watch_packet_update(watch_packet *packet, const char *name, const aur_image *image,
                         const watch_part *part);
/* Takes the picture away. */
void watch_packet_close(watch_packet *packet, const char *name);
