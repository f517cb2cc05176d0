/* A constant volume. */
#include "render/scene/volume.h"

typedef struct same {
    aur_vector value;
    aur_transform to_world; /* has no effect */
} same;

static const aur_key keys[] = {
    {AUR_KEY_OF_VECTOR(same, "value", value, 0.0, 1e30, "1", "a number or a colour")},
    {AUR_KEY_OF_TRANSFORM(same, "to_world", to_world, "accepted; it changes nothing")},
};

static aur_result create(aur_parameters *parameters, aur_volume *volume, aur_error *error) {
    (void)parameters, (void)error;
    const aur_vector value = ((const same *)volume->data)->value;
    volume->constant = true;
    volume->maximum = aur_vector_max(value);
    volume->minimum = aur_smaller(value.x, aur_smaller(value.y, value.z));
    return AUR_OK;
}

static aur_vector evaluate(const aur_volume *volume, aur_vector position) {
    (void)position;
    return ((const same *)volume->data)->value;
}

const aur_volume_descriptor aur_volume_constvolume = {
    .row = {.name = "constvolume",
            .summary = "the same everywhere",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(same),
    .create = create,
    .evaluate = evaluate,
};
