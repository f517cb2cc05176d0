/* Material libraries of OBJ (.mtl). Source: Wavefront, "The Advanced Visualizer Manual", appendix B1, and the
 * extension of 2013 by Exocortex for physically based materials. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"

/* Images of a material. */
typedef enum aur_mtl_map {
    AUR_MTL_DIFFUSE,   /* map_Kd */
    AUR_MTL_EMISSION,  /* map_Ke */
    AUR_MTL_OPACITY,   /* map_d */
    AUR_MTL_ROUGHNESS, /* map_Pr */
    AUR_MTL_METAL,     /* map_Pm */
    AUR_MTL_NORMAL,    /* norm, map_Kn */
    AUR_MTL_MAP_COUNT
} aur_mtl_map;

typedef struct aur_mtl_image {
    char *name; /* with forward slashes; NULL: none */
    bool clamped;
} aur_mtl_image;

/* NAN: unspecified. */
typedef struct aur_mtl_material {
    char *name;
    double diffuse[3], specular[3], emission[3];
    double shininess, opacity, roughness, metal;
    aur_mtl_image images[AUR_MTL_MAP_COUNT];
} aur_mtl_material;

typedef struct aur_mtl_library {
    size_t count, capacity;
    aur_mtl_material *materials;
} aur_mtl_library;

/* Adds the materials of a file; unrecognised and malformed lines are skipped. The text ends with a zero byte.
 * Errors: MEMORY. */
aur_result aur_mtl_read(aur_mtl_library *library, size_t size, const char *text, aur_error *error);
/* A default material that belongs to no file, or NULL if out of memory. */
aur_mtl_material *aur_mtl_add(aur_mtl_library *library, const char *name, size_t length);
/* The first material of that name, or NULL. */
aur_mtl_material *aur_mtl_find(const aur_mtl_library *library, const char *name);
void aur_mtl_release(aur_mtl_library *library);
