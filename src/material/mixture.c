#include "material/mixture.h"

static bool are_alike(const aur_bsdf_lobe *a, const aur_bsdf_lobe *b) {
    return a->shape == b->shape && a->diffuse == b->diffuse && a->times_cosine == b->times_cosine &&
           a->exponent == b->exponent && a->factor == b->factor && a->factor_data == b->factor_data;
}

static size_t join_lobe(aur_bsdf *bsdf, const aur_bsdf_lobe *lobe) {
    const size_t count =
        bsdf->lobe_count < AUR_BSDF_LOBE_CAPACITY ? bsdf->lobe_count : AUR_BSDF_LOBE_CAPACITY;
    for (size_t i = 0; i < count; ++i) {
        aur_bsdf_lobe *const known = &bsdf->lobes[i];
        if (!are_alike(known, lobe))
            continue;
        known->sides |= lobe->sides;
        known->transmits = known->transmits || lobe->transmits;
        return i;
    }
    return aur_bsdf_add_lobe(bsdf, lobe);
}

void aur_mixture_join(aur_bsdf *bsdf) {
    aur_mixture *const self = bsdf->data;
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

/* What the parts weigh at a point; 1 together. */
static void weights_at(const aur_mixture *self, aur_bsdf_point point, float side, float weights[2]) {
    if (self->by_side) {
        weights[0] = side < 0.0f ? 0.0f : 1.0f;
    } else {
        const aur_vector color = aur_color_at(&self->weight, point);
        weights[0] = fminf((color.x + color.y + color.z) / 3.0f, 1.0f);
    }
    weights[1] = 1.0f - weights[0];
}

/* Which of the parts have what is asked for; their weights in sum. A sampled lobe of a part that is half
 * there is drawn as often as if it were all there. */
static float asked_weights(const aur_mixture *self, aur_bsdf_part part, aur_bsdf_point point, float side,
                           float weights[2]) {
    weights_at(self, point, side, weights);
    if (part == AUR_BSDF_WHOLE)
        return 1.0f;
    for (size_t k = 0; k < 2; ++k)
        if (self->part[k] == NULL ||
            ((self->part[k]->scatters[0] | self->part[k]->scatters[1]) & AUR_SCATTERS_SAMPLED) == 0)
            weights[k] = 0.0f;
    return weights[0] + weights[1];
}

/* A direction in the frame of part k: seen from behind, the frame is mirrored in its tangent plane. */
static aur_vector turned(const aur_mixture *self, size_t k, aur_vector direction) {
    return self->by_side && k == 1 ? (aur_vector){direction.x, direction.y, -direction.z} : direction;
}

/* Of a mixture by sides, the part that alone answers for what is seen from a side; NULL: it has not what is
 * asked for. */
static const aur_bsdf *part_of_side(const aur_mixture *self, size_t k, aur_bsdf_part part) {
    const aur_bsdf *const own = self->part[k];
    const bool has =
        part == AUR_BSDF_WHOLE || ((own->scatters[0] | own->scatters[1]) & AUR_SCATTERS_SAMPLED) != 0;
    return has ? own : NULL;
}

void aur_mixture_weigh(const aur_bsdf *bsdf, aur_bsdf_point point, aur_vector view, aur_bsdf_lobe *lobes) {
    const aur_mixture *const self = bsdf->data;
    float weights[2];
    weights_at(self, point, view.z, weights);
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
            lobe->coefficient = aur_vector_add_scaled(lobe->coefficient, weights[k], found[i].coefficient);
        }
    }
}

aur_vector aur_mixture_evaluate(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                aur_vector view, aur_vector light) {
    const aur_mixture *const self = bsdf->data;
    if (self->by_side) {
        const size_t k = view.z < 0.0f;
        const aur_bsdf *const own = part_of_side(self, k, part);
        return own != NULL
                   ? aur_bsdf_evaluate(own, part, point, turned(self, k, view), turned(self, k, light))
                   : (aur_vector){0};
    }
    float weights[2];
    asked_weights(self, part, point, view.z, weights);
    aur_vector sum = {0};
    for (size_t k = 0; k < 2; ++k)
        if (weights[k] > 0.0f)
            sum = aur_vector_add_scaled(
                sum, weights[k],
                aur_bsdf_evaluate(self->part[k], part, point, turned(self, k, view), turned(self, k, light)));
    return sum;
}

aur_vector aur_mixture_evaluate_with_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point,
                                         aur_vector view, aur_vector light, float *pdf) {
    const aur_mixture *const self = bsdf->data;
    const size_t k = view.z < 0.0f;
    const aur_bsdf *const own = self->by_side ? part_of_side(self, k, part) : NULL;
    if (own != NULL)
        return aur_bsdf_evaluate_with_pdf(own, part, point, turned(self, k, view), turned(self, k, light),
                                          pdf);
    *pdf = aur_mixture_pdf(bsdf, part, point, view, light);
    return aur_mixture_evaluate(bsdf, part, point, view, light);
}

float aur_mixture_pdf(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                      aur_vector light) {
    const aur_mixture *const self = bsdf->data;
    if (self->by_side) {
        const size_t k = view.z < 0.0f;
        const aur_bsdf *const own = part_of_side(self, k, part);
        return own != NULL ? aur_bsdf_pdf(own, part, point, turned(self, k, view), turned(self, k, light))
                           : 0.0f;
    }
    float weights[2];
    const float total = asked_weights(self, part, point, view.z, weights);
    float sum = 0.0f;
    for (size_t k = 0; k < 2; ++k)
        if (weights[k] > 0.0f)
            sum += weights[k] / total *
                   aur_bsdf_pdf(self->part[k], part, point, turned(self, k, view), turned(self, k, light));
    return sum;
}

static bool scatters_widely(const aur_bsdf *bsdf) {
    return ((bsdf->scatters[0] | bsdf->scatters[1]) & ~(unsigned)AUR_SCATTERS_SPECULAR) != 0;
}

bool aur_mixture_sample(const aur_bsdf *bsdf, aur_bsdf_part part, aur_bsdf_point point, aur_vector view,
                        const float u[3], aur_bsdf_sample *drawn) {
    const aur_mixture *const self = bsdf->data;
    if (self->by_side) {
        const size_t side = view.z < 0.0f;
        const aur_bsdf *const own = part_of_side(self, side, part);
        if (own == NULL || !aur_bsdf_draw(own, part, point, turned(self, side, view), u, drawn))
            return false;
        drawn->light = turned(self, side, drawn->light);
        return true;
    }
    float weights[2];
    const float total = asked_weights(self, part, point, view.z, weights);
    if (!(total > 0.0f))
        return false;
    const float first = weights[0] / total;
    const size_t k = u[0] < first ? 0 : 1;
    const float chance = weights[k] / total;
    const float rest = (k == 0 ? u[0] : u[0] - first) / chance;
    const float own[3] = {fminf(rest, 0x1.fffffep-1f), u[1], u[2]};
    if (!aur_bsdf_draw(self->part[k], part, point, turned(self, k, view), own, drawn))
        return false;
    drawn->light = turned(self, k, drawn->light);
    drawn->pdf *= chance;
    drawn->weight = aur_vector_scale(drawn->weight, total);
    if (drawn->specular || !(weights[1 - k] > 0.0f) || !scatters_widely(self->part[1 - k]))
        return true;
    /* The other part scatters there too. */
    drawn->pdf = aur_mixture_pdf(bsdf, part, point, view, drawn->light);
    drawn->weight =
        aur_vector_scale(aur_mixture_evaluate(bsdf, part, point, view, drawn->light), 1.0f / drawn->pdf);
    return drawn->pdf > 0.0f;
}

aur_vector aur_mixture_diffuse_albedo(const aur_bsdf *bsdf, aur_bsdf_point point, float side) {
    const aur_mixture *const self = bsdf->data;
    float weights[2];
    weights_at(self, point, side, weights);
    aur_vector sum = {0};
    for (size_t k = 0; k < 2; ++k)
        if (weights[k] > 0.0f)
            sum = aur_vector_add_scaled(
                sum, weights[k],
                aur_bsdf_diffuse_albedo(self->part[k], point, self->by_side ? fabsf(side) : side));
    return sum;
}
