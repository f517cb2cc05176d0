#include "render/radiosity/walk.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"

enum { BLOCK = AUR_RADIOSITY_BLOCK };

/* A quantum is 2^-42 of the greatest initial power of a path. Uniform angles multiply it by up to pi/2 per
 * flight, so sums have a margin of 2^20; larger terms are clipped, counted and reported. */
static const double QUANTA = 0x1p42, MOST_QUANTA = 0x1p62;

/* --- lights */

static aur_result choose_lights(aur_radiosity_walk *walk, aur_error *error) {
    const aur_radiosity_options *const options = walk->options;
    const aur_radiosity_scene *const scene = walk->scene;
    walk->lights = malloc(scene->triangle_count * sizeof *walk->lights);
    walk->start = malloc(scene->triangle_count * sizeof *walk->start);
    double *const weights = malloc(scene->triangle_count * sizeof *weights);
    aur_result result = AUR_OK;
    if (walk->lights == NULL || walk->start == NULL || weights == NULL)
        result = aur_fail_memory(error);
    for (size_t i = 0; i < scene->triangle_count && result == AUR_OK; ++i)
        if ((scene->triangles[i].flags & AUR_RADIOSITY_GLOWS) != 0 && scene->areas[i] > 0.0)
            walk->lights[walk->light_count++] = (uint32_t)i;
    if (result == AUR_OK && options->variant != 0)
        aur_shuffle(walk->light_count, walk->lights, options->variant);
    for (size_t i = 0; i < walk->light_count && result == AUR_OK; ++i) {
        const uint32_t light = walk->lights[i];
        const aur_vector radiance = scene->emission[light];
        const double mean = ((double)radiance.x + (double)radiance.y + (double)radiance.z) / 3.0;
        weights[i] = scene->areas[light] * (options->emission == AUR_RADIOSITY_BY_POWER ? mean : 1.0);
    }
    if (result == AUR_OK)
        result = aur_distribution_create(&walk->choice, walk->light_count, weights, error);
    free(weights);
    return result;
}

/* L0 A pi / probability, for the lights' mean radiance. A light with less than 2^-53 of the total weight is
 * lost to rounding: it is never chosen and starts no path. */
static void find_start(aur_radiosity_walk *walk) {
    double greatest = 0.0;
    for (size_t i = 0; i < walk->light_count; ++i) {
        const uint32_t light = walk->lights[i];
        const double probability = aur_distribution_probability(&walk->choice, i);
        const double scale = probability > 0.0 ? AUR_PI * walk->scene->areas[light] / probability : 0.0;
        aur_vector_to_doubles(walk->scene->emission[light], walk->start[i]);
        for (size_t c = 0; c < 3; ++c) {
            walk->start[i][c] *= scale;
            greatest = fmax(greatest, walk->start[i][c]);
        }
    }
    int exponent;
    frexp(greatest, &exponent);
    walk->quantum = ldexp(1.0, exponent) / QUANTA;
    for (size_t i = 0; i < walk->light_count; ++i)
        for (size_t c = 0; c < 3; ++c)
            walk->start[i][c] /= walk->quantum;
}

aur_result aur_radiosity_walk_create(const aur_radiosity_scene *scene, const aur_radiosity_options *options,
                                     aur_radiosity_walk *walk, aur_error *error) {
    *walk = (aur_radiosity_walk){.scene = scene, .options = options};
    const aur_result result = choose_lights(walk, error);
    if (result != AUR_OK) {
        aur_radiosity_walk_release(walk);
        return result;
    }
    find_start(walk);
    return AUR_OK;
}

void aur_radiosity_walk_release(aur_radiosity_walk *walk) {
    free(walk->lights);
    free(walk->start);
    aur_distribution_release(&walk->choice);
    *walk = (aur_radiosity_walk){0};
}

/* --- particles */

typedef struct particle {
    aur_vector position;
    uint32_t triangle; /* or AUR_NO_PATCH: the path has ended */
    float side;        /* 1 on its front, -1 on its back */
    double power[3];   /* quanta */
} particle;

typedef struct block {
    const aur_radiosity_walk *walk;
    const aur_pointset *set;
    uint64_t key, first;
    size_t count;
    aur_radiosity_tally *tally;
    particle particles[BLOCK];
    _Alignas(64) double u[2 * BLOCK];                /* two coordinates, one array after the other */
    _Alignas(64) float x[BLOCK], y[BLOCK], z[BLOCK]; /* local directions */
    _Alignas(64) float factor[BLOCK];                /* of the power, for uniform angles */
} block;

/* Two coordinates of the block's points, from `dimension` on. This cannot fail: the range and the buffer are
 * right by construction. */
static void fill_coordinates(block *b, size_t dimension) {
    const aur_output output = {
        .layout = AUR_LAYOUT_ARRAYS, .stride = BLOCK, .capacity = 2 * BLOCK, .doubles = b->u};
    aur_pointset_coordinates(b->set, dimension, 2, b->first, b->count, &output, NULL);
}

static void leave_lights(block *b) {
    const aur_radiosity_walk *const walk = b->walk;
    const aur_radiosity_scene *const scene = walk->scene;
    for (size_t i = 0; i < b->count; ++i) {
        particle *const p = &b->particles[i];
        double choice = b->u[i];
        const size_t chosen = aur_distribution_choose_double(&walk->choice, &choice);
        const uint32_t light = walk->lights[chosen];
        const float root = sqrtf((float)choice);
        const float v = root * (float)b->u[BLOCK + i];
        const aur_radiosity_triangle *const triangle = &scene->triangles[light];
        p->position = aur_radiosity_point(triangle, root - v, v);
        p->triangle = light;
        p->side = 1.0f;
        memcpy(p->power, walk->start[chosen], sizeof p->power);
        if ((triangle->flags & AUR_RADIOSITY_TEXTURED_LIGHT) == 0)
            continue;
        const aur_vector here = aur_radiosity_emitted(scene, light, root - v, v),
                         mean = scene->emission[light];
        p->power[0] *= mean.x > 0.0f ? (double)here.x / (double)mean.x : 0.0;
        p->power[1] *= mean.y > 0.0f ? (double)here.y / (double)mean.y : 0.0;
        p->power[2] *= mean.z > 0.0f ? (double)here.z / (double)mean.z : 0.0;
    }
}

/* Sine and cosine of a part of a turn in [0,1], to 1e-7, without a branch. */
static inline void sine_cosine(float turn, float *sine, float *cosine) {
    const int quarter = (int)(4.0f * turn + 0.5f);
    const float a = (4.0f * turn - (float)quarter) * (AUR_PI_F / 2.0f), aa = a * a;
    const float s = a * (1.0f + aa * (-0.166666546f + aa * (0.00833216087f + aa * -0.000195152959f)));
    const float c =
        1.0f + aa * (-0.5f + aa * (0.0416666456f + aa * (-0.00138873162f + aa * 0.0000244331571f)));
    const float major = (quarter & 1) != 0 ? c : s, minor = (quarter & 1) != 0 ? s : c;
    *sine = (quarter & 2) != 0 ? -major : major;
    *cosine = ((quarter + 1) & 2) != 0 ? -minor : minor;
}

/* The least cosine of a direction with the normal: a ray along the surface would hit the surface itself. */
static const float LEAST_COSINE = 1e-6f;

static void make_directions(block *b) {
    const bool uniform = b->walk->options->directions == AUR_RADIOSITY_UNIFORM_ANGLE;
    const double *const u = b->u, *const v = b->u + BLOCK;
    /* The loops process whole blocks, so that their length is a compile-time constant; values beyond the
     * count are not used. */
    for (size_t i = 0; i < BLOCK; ++i) {
        const float radius = sqrtf((float)u[i]), height = sqrtf((float)(1.0 - u[i]));
        float sine, cosine;
        sine_cosine((float)v[i], &sine, &cosine);
        b->x[i] = radius * cosine;
        b->y[i] = radius * sine;
        b->z[i] = height > LEAST_COSINE ? height : LEAST_COSINE;
    }
    if (!uniform)
        return;
    for (size_t i = 0; i < BLOCK; ++i) {
        float radius, height, sine, cosine;
        sine_cosine(0.25f * (float)u[i], &radius, &height);
        sine_cosine((float)v[i], &sine, &cosine);
        b->x[i] = radius * cosine;
        b->y[i] = radius * sine;
        b->z[i] = height > LEAST_COSINE ? height : LEAST_COSINE;
        b->factor[i] = AUR_PI_F * radius * height;
    }
}

static inline uint64_t quanta(double power, aur_radiosity_tally *tally) {
    if (power < MOST_QUANTA)
        return (uint64_t)(int64_t)(power + 0.5);
    ++tally->cut;
    tally->not_finite |= !isfinite(power);
    return (uint64_t)MOST_QUANTA;
}

static inline void multiply(double power[3], aur_vector throughput) {
    power[0] *= (double)throughput.x;
    power[1] *= (double)throughput.y;
    power[2] *= (double)throughput.z;
}

static uint64_t channels(const double power[3], aur_radiosity_tally *tally) {
    return quanta(power[0], tally) + quanta(power[1], tally) + quanta(power[2], tally);
}

/* The particle's hash for what mirrors and glass choose. */
static uint64_t path_hash(const block *b, size_t index, size_t flight) {
    return aur_hash4(b->walk->options->seed, b->key, b->first + index, flight);
}

static inline aur_ray departure(const block *b, size_t i, const aur_radiosity_triangle *from) {
    const particle *const p = &b->particles[i];
    const aur_vector n = from->frame.z;
    aur_vector direction = aur_vector_scale(from->frame.x, b->x[i]);
    direction = aur_vector_add_scaled(direction, b->y[i], from->frame.y);
    direction = aur_vector_add_scaled(direction, p->side * b->z[i], n);
    return (aur_ray){aur_vector_add_scaled(p->position, p->side * from->offset, n), 0.0f, direction,
                     INFINITY};
}

/* Traces a particle's ray, through mirrors, to the surface that receives it. False if the path has ended. */
static bool trace_to_patch(block *b, size_t i, size_t flight, aur_ray *ray, aur_hit *hit) {
    particle *const p = &b->particles[i];
    if (!aur_scene_intersect(b->walk->scene->scene, ray, hit)) {
        ++b->tally->lost;
        return false;
    }
    const aur_radiosity_scene *const scene = b->walk->scene;
    if ((scene->triangles[aur_radiosity_triangle_at(scene, hit)].flags & AUR_RADIOSITY_MIRROR) == 0)
        return true;
    aur_vector throughput = {1.0f, 1.0f, 1.0f};
    const aur_radiosity_end end =
        aur_radiosity_reflect(scene, true, path_hash(b, i, flight), ray, hit, &throughput);
    if (end != AUR_RADIOSITY_HIT) {
        ++*(end == AUR_RADIOSITY_NONE ? &b->tally->lost : &b->tally->trapped);
        return false;
    }
    multiply(p->power, throughput);
    return true;
}

/* One flight of one particle; false if its path has ended. */
static bool fly(block *b, size_t i, size_t flight) {
    const aur_radiosity_walk *const walk = b->walk;
    const aur_radiosity_scene *const scene = walk->scene;
    aur_radiosity_tally *const tally = b->tally;
    particle *const p = &b->particles[i];
    aur_ray ray = departure(b, i, &scene->triangles[p->triangle]);
    aur_hit hit;
    if (!trace_to_patch(b, i, flight, &ray, &hit))
        return false;
    const uint32_t index = aur_radiosity_triangle_at(scene, &hit);
    const aur_radiosity_triangle *const hit_triangle = &scene->triangles[index];
    const bool front = aur_vector_dot(ray.direction, hit_triangle->frame.z) < 0.0f;
    const uint32_t patch = front ? index : hit_triangle->back;
    if (patch == AUR_NO_PATCH) {
        ++tally->behind;
        return false;
    }
    if (walk->options->directions == AUR_RADIOSITY_UNIFORM_ANGLE)
        for (size_t c = 0; c < 3; ++c)
            p->power[c] *= (double)b->factor[i];
    for (size_t c = 0; c < 3; ++c)
        aur_exact_add(&tally->power[patch][c], quanta(p->power[c], tally));
    const bool is_last = flight == walk->options->bounces;
    if (is_last)
        aur_exact_add(&tally->last, channels(p->power, tally));
    const aur_vector albedo = aur_radiosity_albedo(scene, index, front, &ray, &hit);
    multiply(p->power, albedo);
    if (is_last)
        aur_exact_add(&tally->rest, channels(p->power, tally));
    p->position = aur_radiosity_point(hit_triangle, hit.u, hit.v);
    p->triangle = index;
    p->side = front ? 1.0f : -1.0f;
    return !aur_vector_is_zero(albedo);
}

void aur_radiosity_walk_block(const aur_radiosity_walk *walk, const aur_pointset *set, uint64_t key,
                              uint64_t first, size_t count, aur_radiosity_tally *tally) {
    block b = {.walk = walk, .set = set, .key = key, .first = first, .count = count, .tally = tally};
    fill_coordinates(&b, 0);
    leave_lights(&b);
    for (size_t flight = 0; flight <= walk->options->bounces; ++flight) {
        fill_coordinates(&b, 2 * flight + 2);
        make_directions(&b);
        for (size_t i = 0; i < count; ++i)
            if (b.particles[i].triangle != AUR_NO_PATCH && !fly(&b, i, flight))
                b.particles[i].triangle = AUR_NO_PATCH;
    }
}
