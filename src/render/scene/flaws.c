/* Warnings about flawed faces of a scene. */
#include "render/scene/scene_data.h"

static void warn_of_file(const aur_shape *shape, aur_face_flaw flaw, const aur_warnings *warnings) {
    const aur_face_flaws *const f = &shape->flaws;
    if (f->counts[flaw] > 0)
        aur_warn_at(warnings, (aur_location){shape->file, f->lines[flaw], 0},
                    "%zu of %zu faces %s (face %zu is the first)", f->counts[flaw], f->face_count,
                    aur_face_flaw_text(flaw), f->first[flaw]);
}

void aur_scene_warn_of_faces(const aur_scene *scene, const aur_warnings *warnings) {
    for (aur_face_flaw flaw = AUR_FACE_GOOD + 1; flaw < AUR_FACE_FLAW_COUNT; ++flaw) {
        size_t count = 0, all = 0;
        aur_location first = {0};
        for (size_t i = 0; i < scene->shape_count; ++i) {
            const aur_shape *const shape = scene->shapes[i];
            if (shape->file != NULL) {
                warn_of_file(shape, flaw, warnings);
                continue;
            }
            if (count == 0 && shape->flaws.counts[flaw] > 0)
                first = shape->location;
            count += shape->flaws.counts[flaw];
            all += shape->flaws.face_count;
        }
        if (count > 0)
            aur_warn_at(warnings, first, "%zu of %zu polygons %s (the first is here)", count, all,
                        aur_face_flaw_text(flaw));
    }
}
