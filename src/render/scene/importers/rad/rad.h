/* Radiance's scene descriptions. */
#pragma once

#include <stdbool.h>

#include "render/scene/importers/nodes/node.h"

/* Whether a scene's file is one by its name: .rad, .mat, .sky. */
bool aur_rad_is_name(const char *path);
/* Whether text is one by its content: after comments, it begins with a command or a primitive. */
bool aur_rad_is_text(size_t size, const char *data);

/* What the files of one scene share: the materials so far, in the order in which they are read. */
typedef struct aur_rad_material aur_rad_material;
typedef struct aur_rad_pose aur_rad_pose;
typedef struct aur_rad_scene {
    aur_arena *arena; /* of names */
    size_t material_count, material_capacity;
    aur_rad_material *materials;
    const aur_rad_pose *pose; /* of the file that is opened next; NULL: where its coordinates say */
    aur_xml_node *sky;        /* the last one, whose ground a further source may be */
    bool diffuse;             /* materials that are not supported become their diffuse part */
    size_t diffuse_count;     /* how many have */
    const aur_warnings *warnings;
    aur_error *left_out; /* the last thing that is not read; those before it have been warned of */
    /* Finds a file that a scene names; *path is the caller's to free. NULL: no files. */
    aur_result (*find)(void *context, aur_location location, const char *name, char **path, aur_error *error);
    void *context;
} aur_rad_scene;

void aur_rad_scene_release(aur_rad_scene *scene);

/* One file whose elements are added to a tree. */
typedef struct aur_rad aur_rad;

/* Elements go to the end of `parent`; `nodes` must last until the file is closed, and its location names the
 * file. Errors: MEMORY. */
aur_result aur_rad_open(aur_rad_scene *scene, aur_nodes *nodes, aur_xml_node *parent, size_t size,
                        const char *data, aur_rad **rad);
/* Adds elements, each at the line of its primitive, up to the next file that is to be included, at
 * nodes->location: *included is its name, in the scene's arena, and NULL at the end of this file. What is
 * included must be read before the next call, which may use its materials.
 * Known are the surfaces and materials of the two tables of rad_reader.h, aliases, and the commands cat,
 * xform with all of its options but files of them, genbox, genprism and genrev, in pipes too; no process is
 * started.
 * Errors: FORMAT and UNSUPPORTED with the line of whatever is wrong; NAME for a modifier that is not defined
 * above; MEMORY. What is well-formed and not known is noted in the scene's `left_out` instead, so that all of
 * it can be said at once; a material that no surface uses may be of any kind. */
aur_result aur_rad_next(aur_rad *rad, const char **included);
void aur_rad_close(aur_rad *rad); /* NULL is allowed */

/* Whether text is a view file: after comments it begins with VIEW=, rvu, rview, rpict or -vt. */
bool aur_rad_is_view(size_t size, const char *data);
/* Adds the camera of a view file, 768 pixels along the longer side: -vtv with -vp, -vd, -vu, -vh, -vv, -vo
 * and -va. Errors: FORMAT; UNSUPPORTED for other projections and shifted views; MEMORY. */
aur_result aur_rad_read_view(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data);
