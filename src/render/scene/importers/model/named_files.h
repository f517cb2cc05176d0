/* Files that a model names: they are found, noted and confined as all that a scene names, under names that
 * are forgiven. What is missing is reported in one warning a kind. */
#pragma once

#include "render/scene/importers/model/model.h"

/* Names for one warning: the first ones, and how many there are. */
typedef struct aur_name_list {
    size_t count;
    char text[500];
} aur_name_list;

typedef struct aur_named_files {
    const aur_model_source *source;
    aur_name_list renamed, missing;                   /* files */
    aur_name_list missing_pictures, unknown_pictures; /* of textures */
} aur_named_files;

/* The bytes of a file, *data NULL where there is none, and the name under which it was found. Both are
 * malloc'ed, *used also after errors. Errors: OPEN for one that may not be read, MEMORY. */
aur_result aur_named_read(aur_named_files *self, const char *name, char **used, size_t *size, char **data,
                          aur_error *error);
/* The same of one that the model can do without. */
aur_result aur_named_read_part(aur_named_files *self, const char *name, char **used, size_t *size,
                               char **data, aur_error *error);
/* The name under which a picture can be read, NULL for none. */
aur_result aur_named_find_picture(aur_named_files *self, const char *name, char **used, aur_error *error);
/* Whether the bytes are a picture of a known format; if not, it is reported under this name. */
bool aur_named_is_picture(aur_named_files *self, const char *name, size_t size, const char *data);
void aur_named_warn(const aur_named_files *self);
