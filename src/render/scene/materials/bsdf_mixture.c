/* Materials that combine two others. mask: a partly present surface, the nested BSDF with weight `opacity`;
 * the rest is transmitted unscattered. blendbsdf: the first nested BSDF, and the second with weight `weight`.
 * twosided: one nested BSDF for both sides of a surface, or a second one for the back. */
#include "render/scene/materials/texture.h"

typedef struct mixture {
    const aur_bsdf *part[2]; /* part[1] may be NULL if it never has weight */
    bool by_side;            /* part[0] is for the front, part[1], mirrored, for the back; else: */
    aur_color weight;        /* weight of part[heavy]; the other part has the rest */
    size_t heavy;
    size_t number[2][AUR_BSDF_LOBE_CAPACITY]; /* indices of the parts' lobes in the mixture */
} mixture;

/* --- lobes: lobes of the parts that differ only in coefficient and side are merged */

static bool are_mergeable(const aur_bsdf_lobe *a, const aur_bsdf_lobe *b) {
    if (a->shape == AUR_LOBE_SHAPE_SPECULAR && a->way == AUR_LOBE_WAY_SEPARATE)
        return false;
    return a->shape == b->shape && a->way == b->way && a->diffuse == b->diffuse &&
           a->times_cosine == b->times_cosine && a->exponent == b->exponent && a->factor == b->factor &&
           a->factor_data == b->factor_data;
}

static size_t join_lobe(aur_bsdf *bsdf, const aur_bsdf_lobe *lobe) {
    for (size_t i = 0; i < bsdf->lobe_count && i < AUR_BSDF_LOBE_CAPACITY; ++i) {
        aur_bsdf_lobe *const existing = &bsdf->lobes[i];
        if (!are_mergeable(existing, lobe))
            continue;
        existing->sides |= lobe->sides;
        existing->ggx_alpha = existing->ggx_alpha == lobe->ggx_alpha ? lobe->ggx_alpha : 0.0f;
        existing->transmits = existing->transmits || lobe->transmits;
        return i;
    }
    return aur_bsdf_add_lobe(bsdf, lobe);
}

static void join_lobes(aur_bsdf *bsdf) {
    mixture *const self = bsdf->data;
    for (size_t k = 0; k < 2; ++k) {
        for (size_t i = 0; self->part[k] != NULL && i < self->part[k]->lobe_count; ++i) {
            aur_bsdf_lobe lobe = self->part[k]->lobes[i];
            if (self->by_side && (lobe.sides & AUR_SIDE_FRONT) == 0)
                continue;
            if (self->by_side)
                lobe.sides = k == 0 ? AUR_SIDE_FRONT : AUR_SIDE_BACK;
            self->number[k][i] = join_lobe(bsdf, &lobe);
        }
    }
}

/* --- queries of a mixture: the sum over its parts */

static bool has_any(const aur_bsdf *bsdf, unsigned kinds) {
    return bsdf != NULL && ((bsdf->scatters[0] | bsdf->scatters[1]) & kinds) != 0;
}

/* The weights of the parts at a point, seen from a side; 0 if a part lacks the requested lobes. Returns their
 * sum. A sampled lobe of a part with weight 1/2 is sampled with the full probability. */
static float weigh_parts(const mixture *self, aur_bsdf_part part, aur_bsdf_point point, float side,
                         float weights[2]) {
    if (self->by_side) {
        weights[0] = side < 0.0f ? 0.0f : 1.0f;
    } else {
        const float weight = fminf(aur_color_number_at(&self->weight, point), 1.0f);
        weights[0] = self->heavy == 0 ? weight : 1.0f - weight;
    }
    weights[1] = 1.0f - weights[0];
    if (part == AUR_BSDF_WHOLE)
        return 1.0f;
    for (size_t k = 0; k < 2; ++k)
        if (!has_any(self->part[k], AUR_SCATTERS_SAMPLED))
            weights[k] = 0.0f;
    return weights[0] + weights[1];
}

/* A direction in the frame of part k: for the back, mirrored in the tangent plane. */
static aur_vector turned(const mixture *self, size_t k, aur_vector direction) {
    return self->by_side && k == 1 ? (aur_vector){direction.x, direction.y, -direction.z} : direction;
}

static void weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const mixture *const self = bsdf->data;
    float weights[2];
    weigh_parts(self, AUR_BSDF_WHOLE, point, view.z, weights);
    for (size_t k = 0; k < 2; ++k) {
        if (!(weights[k] > 0.0f))
            continue;
        aur_bsdf_lobe found[AUR_BSDF_LOBE_CAPACITY];
        const size_t count = aur_bsdf_lobes(self->part[k], point, turned(self, k, view), found);
        for (size_t i = 0; i < count; ++i) {
            if (aur_vector_is_zero(found[i].coefficient))
                continue;
            aur_bsdf_lobe *const lobe = &lobes[self->number[k][i]];
            lobe->axis = turned(self, k, found[i].axis);
            lobe->ior_squared = found[i].ior_squared;
            lobe->coefficient = aur_vector_add_scaled(lobe->coefficient, weights[k], found[i].coefficient);
        }
    }
}

/* The single part visible from a side, which needs no weighting. */
static size_t part_seen(aur_vector view) {
    return view.z < 0.0f ? 1 : 0;
}

static bool has_part(const mixture *self, aur_bsdf_part part, size_t k) {
    return part == AUR_BSDF_WHOLE || has_any(self->part[k], AUR_SCATTERS_SAMPLED);
}

static aur_vector evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                           aur_vector light, float *pdf) {
    const mixture *const self = bsdf->data;
    *pdf = 0.0f;
    if (self->by_side) {
        const size_t k = part_seen(view);
        return has_part(self, part, k) ? aur_bsdf_evaluate(self->part[k], part, point, turned(self, k, view),
                                                           turned(self, k, light), pdf)
                                       : (aur_vector){0};
    }
    float weights[2];
    const float total = weigh_parts(self, part, point, view.z, weights);
    aur_vector sum = {0};
    for (size_t k = 0; k < 2; ++k) {
        if (!(weights[k] > 0.0f))
            continue;
        float density;
        const aur_vector value = aur_bsdf_evaluate(self->part[k], part, point, view, light, &density);
        sum = aur_vector_add_scaled(sum, weights[k], value);
        *pdf += weights[k] / total * density;
    }
    return sum;
}

static bool sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                   const float u[3], aur_bsdf_sample *drawn) {
    const mixture *const self = bsdf->data;
    if (self->by_side) {
        const size_t k = part_seen(view);
        if (!has_part(self, part, k) ||
            !aur_bsdf_draw(self->part[k], part, point, turned(self, k, view), u, drawn))
            return false;
        drawn->light = turned(self, k, drawn->light);
        return true;
    }
    float weights[2];
    const float total = weigh_parts(self, part, point, view.z, weights);
    if (!(total > 0.0f))
        return false;
    const float first = weights[0] / total;
    const size_t k = u[0] < first ? 0 : 1;
    const float probability = weights[k] / total;
    const float rest = (k == 0 ? u[0] : u[0] - first) / probability;
    const float numbers[3] = {fminf(rest, 0x1.fffffep-1f), u[1], u[2]};
    if (!aur_bsdf_draw(self->part[k], part, point, view, numbers, drawn))
        return false;
    drawn->pdf *= probability;
    drawn->weight = aur_vector_scale(drawn->weight, total);
    if (drawn->specular || !(weights[1 - k] > 0.0f) ||
        !has_any(self->part[1 - k], ~(unsigned)AUR_SCATTERS_SPECULAR))
        return true;
    /* The other part scatters there too. */
    const aur_vector value = evaluate(bsdf, part, point, view, drawn->light, &drawn->pdf);
    drawn->weight = aur_vector_scale(value, 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

static aur_vector diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const mixture *const self = bsdf->data;
    float weights[2];
    weigh_parts(self, AUR_BSDF_WHOLE, point, side, weights);
    aur_vector sum = {0};
    for (size_t k = 0; k < 2; ++k)
        if (weights[k] > 0.0f)
            sum = aur_vector_add_scaled(
                sum, weights[k],
                aur_bsdf_diffuse_albedo(self->part[k], point, self->by_side ? fabsf(side) : side));
    return sum;
}

#define MIXTURE                                                                                              \
    .size = sizeof(mixture), .weigh = weigh, .evaluate = evaluate, .sample = sample,                         \
    .diffuse_albedo = diffuse_albedo

/* --- mask */

static const aur_key mask_keys[] = {
    {AUR_KEY_OF_COLOR(mixture, "opacity", weight, 1.0, "0.5",
                      "share of light that interacts with the nested bsdf")},
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "nested bsdf; must be given"),
};

static aur_result create_mask(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    mixture *const self = bsdf->data;
    const aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->part[0], error);
    if (result != AUR_OK)
        return result;
    if (self->part[0] == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT, "bsdf 'mask' needs a nested bsdf");
    const aur_vector opacity = self->weight.constant;
    if (self->weight.texture != NULL || fminf(fminf(opacity.x, opacity.y), opacity.z) < 1.0f)
        self->part[1] = &aur_bsdf_nothing;
    join_lobes(bsdf);
    return AUR_OK;
}

const aur_bsdf_descriptor aur_bsdf_mask = {
    .row = {.name = "mask",
            .summary = "the nested bsdf with an opacity",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(mask_keys)},
    .create = create_mask,
    MIXTURE,
};

/* --- blendbsdf */

static const aur_key blend_keys[] = {
    {AUR_KEY_OF_COLOR(mixture, "weight", weight, 1.0, "0.5", "share of the second")},
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "the first; must be given"),
    AUR_NESTED_BSDF_KEY("bsdf2", NULL, "the second; must be given"),
};

static aur_result create_blend(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    mixture *const self = bsdf->data;
    self->heavy = 1;
    aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->part[0], error);
    if (result == AUR_OK)
        result = aur_parameters_nested_bsdf(parameters, "bsdf2", &self->part[1], error);
    if (result != AUR_OK)
        return result;
    if (self->part[0] == NULL || self->part[1] == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'blendbsdf' needs two nested bsdfs");
    join_lobes(bsdf);
    return AUR_OK;
}

const aur_bsdf_descriptor aur_bsdf_blendbsdf = {
    .row = {.name = "blendbsdf",
            .summary = "two nested bsdfs, mixed",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(blend_keys)},
    .create = create_blend,
    MIXTURE,
};

/* --- twosided */

static const aur_key twosided_keys[] = {
    AUR_NESTED_BSDF_KEY("bsdf", NULL, "the front, and the back if bsdf2 is not given"),
    AUR_NESTED_BSDF_KEY("bsdf2", "bsdf", "the back"),
};

static aur_result create_twosided(aur_parameters *parameters, aur_bsdf *bsdf, aur_error *error) {
    mixture *const self = bsdf->data;
    self->by_side = true;
    aur_result result = aur_parameters_nested_bsdf(parameters, "bsdf", &self->part[0], error);
    self->part[1] = self->part[0];
    if (result == AUR_OK)
        result = aur_parameters_nested_bsdf(parameters, "bsdf2", &self->part[1], error);
    if (result != AUR_OK)
        return result;
    if (self->part[0] == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided' needs one or two nested bsdfs");
    if (self->part[0]->transmits || self->part[1]->transmits)
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "bsdf 'twosided': a nested bsdf that lets light through already has two sides");
    join_lobes(bsdf);
    return AUR_OK;
}

const aur_bsdf_descriptor aur_bsdf_twosided = {
    .row = {.name = "twosided",
            .summary = "the nested bsdf on both sides, or a second one behind",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(twosided_keys)},
    .create = create_twosided,
    MIXTURE,
};
