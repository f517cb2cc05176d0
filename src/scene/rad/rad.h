/* Radiance's scene descriptions, the plain subset of them. */
#pragma once

#include <stdbool.h>

#include "core/error.h"

/* Whether a scene's file is one, by its name: .rad. */
bool aur_rad_is_name(const char *path);

/* Writes the description as an XML scene in which every object stands on the line of its primitive: *xml is
 * malloc'ed. Known are the surfaces polygon, sphere, bubble, cylinder, tube, ring, mesh (of an OBJ file) and
 * source, the materials plastic and metal without specularity, glass, light and glow, and aliases. Errors:
 * FORMAT and UNSUPPORTED with the line of whatever is wrong or not known; NAME for a modifier that is not
 * defined above; MEMORY. */
aur_result aur_rad_to_xml(const char *path, size_t size, const char *data, char **xml, size_t *xml_size,
                          aur_error *error);
