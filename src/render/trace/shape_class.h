/* What is known of each shape before a ray meets it, so that most hits need no look at their surface. */
#pragma once

#include "render/scene/scene.h"

typedef struct aur_shape_class {
    bool curved; /* not a mesh */
    bool emits;
    /* A mesh with nothing but diffuse reflection, alike at all its points, and no light. */
    bool plain;
    bool plain_flat; /* plain, and without normals at its vertices */
    /* The same but for a reflectance that is not alike at all points. */
    bool textured_flat;
    /* Reflectance of plain shapes seen from the side of the normal, and from behind: RGB, and over pi. */
    aur_vector albedo[2], albedo_on_pi[2];
} aur_shape_class;

/* One class a shape of the scene; to be freed by the caller. Errors: MEMORY. */
aur_result aur_shape_classes_create(const aur_scene *scene, aur_shape_class **classes, aur_error *error);
