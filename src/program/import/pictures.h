/* Pictures of materials as <texture>s. */
#pragma once

#include <assimp/material.h>

#include "program/import/writer.h"

/* A material's texture, by assimp's kind and number. */
typedef struct slot {
    enum aiTextureType type;
    unsigned index;
} slot;

/* How a texture's picture becomes a <texture>. */
typedef struct picture_use {
    slot from;
    const char *name, *channel;
    bool raw;
    float factor[3], cutoff;
} picture_use;

/* Whether there is one that can be read. */
bool picture_exists(writer *self, const struct aiMaterial *material, slot from);
/* As a <texture>; there must be one. */
void picture_put(writer *self, const struct aiMaterial *material, const picture_use *use);
/* A share of the surface's light: a channel of a texture times a number, or that number. */
void picture_put_share(writer *self, const struct aiMaterial *material, const picture_use *use);
