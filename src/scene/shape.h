/* Shapes. One plugin a file (shape_*.c), with one line in the table of shape.c. */
#ifndef AUR_SCENE_SHAPE_H
#define AUR_SCENE_SHAPE_H

#include "scene/mesh.h"
#include "scene/scene.h"
#include "scene/xml.h"

typedef struct aur_shape_descriptor aur_shape_descriptor;

typedef struct aur_shape {
    const aur_shape_descriptor *descriptor;
    aur_location location;
    aur_mesh mesh;
    bool
        parallelogram; /* two triangles that are sampled by one continuous map: corners 0, 1, 2, 3 in order */
    double area;
    const aur_bsdf *bsdf;
    uint32_t emitter; /* or AUR_NO_EMITTER */
} aur_shape;

/* What every shape is made from. */
typedef struct aur_shape_input {
    aur_parameters *parameters;
    const aur_xml_document *document; /* finds assets */
    const aur_warnings *warnings;
    aur_transform to_world, to_local; /* affine */
    bool flip_normals;
} aur_shape_input;

struct aur_shape_descriptor {
    const char *name;
    const char *summary;
    /* Reads its own parameters and makes the shape in world coordinates (flips included). */
    aur_result (*create)(const aur_shape_input *input, aur_shape *shape, aur_error *error);
};

/* The table; NULL beyond it. */
const aur_shape_descriptor *aur_shape_descriptor_at(size_t index);

/* Builds the shape that parameters->plugin names; the loader gives it a BSDF and an emitter. */
aur_result aur_shape_create(aur_parameters *parameters, const aur_xml_document *document,
                            const aur_warnings *warnings, aur_shape **shape, aur_error *error);
void aur_shape_destroy(aur_shape *shape);

/* For shapes made in local coordinates: moves the mesh into the world and flips it where asked. */
void aur_shape_place(const aur_shape_input *input, aur_shape *shape);

/* The path of the file that the parameter `filename` names (malloc'ed). */
aur_result aur_shape_filename(const aur_shape_input *input, char **path, aur_error *error);

#endif
