/* Radiance's scene descriptions, the plain subset of them. */
#pragma once

#include <stdbool.h>

#include "points/base/arena.h"
#include "points/base/error.h"

/* Whether a scene's file is one, by its name: .rad. */
bool aur_rad_is_name(const char *path);

/* What the files of one scene share: the materials so far, in the order in which they are read. */
typedef struct aur_rad_material aur_rad_material;
typedef struct aur_rad_scene {
    aur_arena *arena; /* of names */
    size_t material_count, material_capacity, bsdf_count;
    aur_rad_material *materials;
    const aur_warnings *warnings;
    aur_error *left_out; /* the last thing that is not read; those before it have been warned of */
} aur_rad_scene;

void aur_rad_scene_release(aur_rad_scene *scene);

/* One file that becomes XML. */
typedef struct aur_rad aur_rad;

/* `path` and `error` must last until it is closed. Errors: MEMORY. */
aur_result aur_rad_open(aur_rad_scene *scene, const char *path, size_t size, const char *data, aur_rad **rad,
                        aur_error *error);
/* The next piece of an XML scene in which every object stands on the line of its primitive; it is the
 * reader's. A piece ends behind the <include> elements of a command that includes files, so that these are
 * read before what comes after them and may use their materials; one of 0 bytes is none: the file has ended.
 * Known are the surfaces polygon, sphere, bubble, cylinder, tube, ring, mesh (of an OBJ file) and source, the
 * materials plastic and metal without specularity, glass, light and glow, aliases, and the commands cat and
 * xform where they do nothing but include. Errors: FORMAT and UNSUPPORTED with the line of whatever is wrong;
 * NAME for a modifier that is not defined above; MEMORY. What is well-formed and not known is noted in the
 * scene's `left_out` instead, so that all of it can be said at once; a material that no surface uses may be
 * of any kind. */
aur_result aur_rad_next(aur_rad *rad, const char **xml, size_t *size);
void aur_rad_close(aur_rad *rad); /* NULL is allowed */
