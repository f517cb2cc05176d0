/* Radiance scene descriptions. */
#pragma once

#include <stdbool.h>

#include "render/scene/importers/nodes/node.h"

/* Whether the extension is one of Radiance's: .rad, .mat, .sky. */
bool aur_rad_is_name(const char *path);
/* Whether text is a Radiance file: after comments, it begins with a command or a primitive. */
bool aur_rad_is_text(size_t size, const char *data);

/* State shared by the files of a scene: the materials so far, in file order. */
typedef struct aur_rad_material aur_rad_material;
typedef struct aur_rad_pose aur_rad_pose;
typedef struct aur_rad_scene {
    aur_arena *arena; /* arena of names */
    size_t material_count, material_capacity;
    aur_rad_material *materials;
    const aur_rad_pose *pose; /* pose of the next file opened; NULL: identity */
    aur_xml_node *sky;        /* the last sky; a second source may be its ground */
    const char *light;        /* only sources of this material emit; NULL: all */
    bool has_light;           /* there is such a source */
    bool diffuse;             /* replace unsupported materials by their diffuse part */
    size_t diffuse_count;     /* number of replaced materials */
    const aur_warnings *warnings;
    aur_error *left_out; /* the last ignored primitive; earlier ones have been reported as warnings */
    /* Resolves a file name; the caller frees *path. NULL: no files. */
    aur_result (*find)(void *context, aur_location location, const char *name, char **path, aur_error *error);
    void *context;
} aur_rad_scene;

void aur_rad_scene_release(aur_rad_scene *scene);

/* One file whose elements are added to a tree. */
typedef struct aur_rad aur_rad;

/* Elements are appended to `parent`. `nodes` must outlive the reader; its location names the file. Errors:
 * MEMORY. */
aur_result aur_rad_open(aur_rad_scene *scene, aur_nodes *nodes, aur_xml_node *parent, size_t size,
                        const char *data, aur_rad **rad);
/* Adds elements, each with the line of its primitive, until the next file to include, which is at
 * nodes->location. *included is its name in the scene's arena, and NULL at the end of this file. The included
 * file must be read before the next call, which may use its materials.
 * Supported are the surfaces and materials of the two tables of rad_reader.h, aliases, and the commands cat,
 * xform (all options but option files), genbox, genprism and genrev, also in pipes. No process is started.
 * Errors: FORMAT and UNSUPPORTED with the line; NAME for an undefined modifier; MEMORY. Well-formed
 * unsupported primitives are recorded in the scene's `left_out`, so that all can be reported together.
 * Unsupported materials are errors only if used. */
aur_result aur_rad_next(aur_rad *rad, const char **included);
void aur_rad_close(aur_rad *rad); /* NULL is allowed */

/* Whether text is a view file: after comments it begins with VIEW=, rvu, rview, rpict or -vt. */
bool aur_rad_is_view(size_t size, const char *data);
/* Adds the camera of a view file, 768 pixels along the longer side. Supports -vtv with -vp, -vd, -vu, -vh,
 * -vv, -vo and -va. Errors: FORMAT; UNSUPPORTED for other projections and shifted views; MEMORY. */
aur_result aur_rad_read_view(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data);
