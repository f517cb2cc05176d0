/* Two phase functions, the second with weight `weight`. */
#include <string.h>

#include "render/scene/phase.h"
#include "render/scene/volume.h"

typedef struct blend {
    const aur_phase *part[2];
    aur_volume_value weight;
} blend;

static const aur_key keys[] = {
    {AUR_VOLUME_KEY("weight", NULL, "of the second phase function: from 0 to 1")},
    {AUR_KEY_READ_APART(AUR_KEY_ITEM, "phase", NULL, "the first"),
     .words = (const char *const[]){"phase", NULL}},
    {AUR_KEY_READ_APART(AUR_KEY_ITEM, "phase2", NULL, "the second"),
     .words = (const char *const[]){"phase", NULL}},
};

static aur_result create(aur_parameters *parameters, aur_phase *phase, aur_error *error) {
    blend *const self = phase->data;
    const aur_parameter *const items[2] = {aur_parameters_find(parameters, "phase"),
                                           aur_parameters_find(parameters, "phase2")};
    for (size_t k = 0; k < 2; ++k) {
        if (items[k] == NULL || items[k]->kind != AUR_PARAMETER_OBJECT ||
            strcmp(items[k]->object_kind, "phase") != 0)
            return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs two <phase>");
        self->part[k] = items[k]->object;
    }
    if (aur_parameters_find(parameters, "weight") == NULL)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT, "it needs a 'weight'");
    return aur_volume_value_read(parameters, "weight", 0.0f, 1.0f, &self->weight, error);
}

static float weight_at(const blend *self, aur_vector position) {
    return aur_volume_value_at(&self->weight, position).x;
}

static float evaluate(const aur_phase *phase, aur_vector position, float cosine) {
    const blend *const self = phase->data;
    const float weight = weight_at(self, position);
    return (1.0f - weight) * aur_phase_evaluate(self->part[0], position, cosine) +
           weight * aur_phase_evaluate(self->part[1], position, cosine);
}

static float draw(const aur_phase *phase, aur_vector position, float u) {
    const blend *const self = phase->data;
    const float weight = weight_at(self, position);
    /* The rest of u is uniform after the choice; rounding must not make it 1. */
    static const float most = 0x1.fffffep-1f;
    if (u < weight)
        return aur_phase_draw(self->part[1], position, aur_smaller(u / weight, most));
    return aur_phase_draw(self->part[0], position, aur_smaller((u - weight) / (1.0f - weight), most));
}

const aur_phase_descriptor aur_phase_blendphase = {
    .row = {.name = "blendphase",
            .summary = "two phase functions, one with a weight",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(blend),
    .create = create,
    .evaluate = evaluate,
    .draw = draw,
};
