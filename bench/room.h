/* Rooms generated from seeds: walls, six boxes, and one to sixteen light sources or a window. */
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct bench_room {
    char text[16384]; /* the scene, `used` characters */
    size_t used;
    uint64_t seed, drawn;
} bench_room;

void bench_room_make(uint64_t seed, bench_room *self);
