/* Martin Newell's 32 bicubic Bezier patches of 1975, z up. Twenty-four of them are quarters of surfaces of
 * revolution, so six profiles say the same as their control points; handle and spout are four patches each,
 * of which two mirror the others in y. */
#include "teapot_patches.h"

#include <stddef.h>

/* One ring of control points: a quarter circle of radius r is (r, 0), (r, k r), (k r, r), (0, r). */
typedef struct ring {
    double r, z, k;
} ring;

enum { PROFILE_COUNT = 6 };

/* Each runs outwards and down, so that all normals vec out of the pot. */
static const ring profiles[PROFILE_COUNT][4] = {
    /* rim, upper body, lower body, bottom */
    {{1.4, 2.4, 0.56}, {1.3375, 2.53125, 0.56}, {1.4375, 2.53125, 0.56}, {1.5, 2.4, 0.56}},
    {{1.5, 2.4, 0.56}, {1.75, 1.875, 0.56}, {2.0, 1.35, 0.56}, {2.0, 0.9, 0.56}},
    {{2.0, 0.9, 0.56}, {2.0, 0.45, 0.56}, {1.5, 0.225, 0.56}, {1.5, 0.15, 0.56}},
    {{1.5, 0.15, 0.56}, {1.5, 0.075, 0.56}, {1.425, 0.0, 0.56}, {0.0, 0.0, 0.56}},
    /* knob, lid */
    {{0.0, 3.15, 0.56}, {0.8, 3.15, 0.5625}, {0.0, 2.85, 0.56}, {0.2, 2.7, 0.56}},
    {{0.2, 2.7, 0.56}, {0.4, 2.55, 0.56}, {1.3, 2.55, 0.56}, {1.3, 2.4, 0.56}},
};

/* The halves of handle and spout with y <= 0; v runs around the tube. */
enum { TUBE_COUNT = 4 };
static const teapot_patch tubes[TUBE_COUNT] = {
    /* handle, upper and lower */
    {{{{-1.5, 0.0, 2.25}, {-1.5, -0.3, 2.25}, {-1.6, -0.3, 2.025}, {-1.6, 0.0, 2.025}},
      {{-2.5, 0.0, 2.25}, {-2.5, -0.3, 2.25}, {-2.3, -0.3, 2.025}, {-2.3, 0.0, 2.025}},
      {{-3.0, 0.0, 2.25}, {-3.0, -0.3, 2.25}, {-2.7, -0.3, 2.025}, {-2.7, 0.0, 2.025}},
      {{-3.0, 0.0, 1.8}, {-3.0, -0.3, 1.8}, {-2.7, -0.3, 1.8}, {-2.7, 0.0, 1.8}}}},
    {{{{-3.0, 0.0, 1.8}, {-3.0, -0.3, 1.8}, {-2.7, -0.3, 1.8}, {-2.7, 0.0, 1.8}},
      {{-3.0, 0.0, 1.35}, {-3.0, -0.3, 1.35}, {-2.7, -0.3, 1.575}, {-2.7, 0.0, 1.575}},
      {{-2.65, 0.0, 0.9375}, {-2.65, -0.3, 0.9375}, {-2.5, -0.3, 1.125}, {-2.5, 0.0, 1.125}},
      {{-1.9, 0.0, 0.6}, {-1.9, -0.3, 0.6}, {-2.0, -0.3, 0.9}, {-2.0, 0.0, 0.9}}}},
    /* spout, lower and upper */
    {{{{1.7, 0.0, 0.6}, {1.7, -0.66, 0.6}, {1.7, -0.66, 1.425}, {1.7, 0.0, 1.425}},
      {{3.1, 0.0, 0.825}, {3.1, -0.66, 0.825}, {2.6, -0.66, 1.425}, {2.6, 0.0, 1.425}},
      {{2.4, 0.0, 2.025}, {2.4, -0.25, 2.025}, {2.3, -0.25, 2.1}, {2.3, 0.0, 2.1}},
      {{3.3, 0.0, 2.4}, {3.3, -0.25, 2.4}, {2.7, -0.25, 2.4}, {2.7, 0.0, 2.4}}}},
    {{{{3.3, 0.0, 2.4}, {3.3, -0.25, 2.4}, {2.7, -0.25, 2.4}, {2.7, 0.0, 2.4}},
      {{3.525, 0.0, 2.49375}, {3.525, -0.25, 2.49375}, {2.8, -0.25, 2.475}, {2.8, 0.0, 2.475}},
      {{3.45, 0.0, 2.5125}, {3.45, -0.15, 2.5125}, {2.9, -0.15, 2.475}, {2.9, 0.0, 2.475}},
      {{3.2, 0.0, 2.4}, {3.2, -0.15, 2.4}, {2.8, -0.15, 2.4}, {2.8, 0.0, 2.4}}}},
};

/* The quarter of a profile's surface that is turned by `quarter` right angles. */
static teapot_patch quarter_patch(const ring profile[4], size_t quarter) {
    teapot_patch result;
    for (size_t u = 0; u < 4; ++u) {
        const double r = profile[u].r, kr = profile[u].k * profile[u].r;
        const double x[4] = {r, r, kr, 0.0}, y[4] = {0.0, kr, r, 0.0};
        for (size_t v = 0; v < 4; ++v) {
            vec p = {x[v], v == 3 ? r : y[v], profile[u].z};
            for (size_t turn = 0; turn < quarter; ++turn)
                p = (vec){-p.y, p.x, p.z};
            result.control[u][v] = p;
        }
    }
    return result;
}

/* Mirrored in y; v runs backwards, so that the normals still vec outwards. */
static teapot_patch mirrored(const teapot_patch *source) {
    teapot_patch result;
    for (size_t u = 0; u < 4; ++u)
        for (size_t v = 0; v < 4; ++v) {
            const vec p = source->control[u][3 - v];
            result.control[u][v] = (vec){p.x, -p.y, p.z};
        }
    return result;
}

void teapot_patches(teapot_patch patches[TEAPOT_PATCH_COUNT]) {
    size_t count = 0;
    for (size_t i = 0; i < PROFILE_COUNT; ++i)
        for (size_t quarter = 0; quarter < 4; ++quarter)
            patches[count++] = quarter_patch(profiles[i], quarter);
    for (size_t i = 0; i < TUBE_COUNT; ++i) {
        patches[count++] = tubes[i];
        patches[count++] = mirrored(&tubes[i]);
    }
}

static void bernstein(double t, double value[4], double slope[4]) {
    const double s = 1.0 - t;
    value[0] = s * s * s;
    value[1] = 3.0 * s * s * t;
    value[2] = 3.0 * s * t * t;
    value[3] = t * t * t;
    slope[0] = -3.0 * s * s;
    slope[1] = 3.0 * s * (s - 2.0 * t);
    slope[2] = 3.0 * t * (2.0 * s - t);
    slope[3] = 3.0 * t * t;
}

void teapot_evaluate(const teapot_patch *source, double u, double v, vec *position, vec *normal) {
    double bu[4], du[4], bv[4], dv[4];
    bernstein(u, bu, du);
    bernstein(v, bv, dv);
    vec p = {0}, along_u = {0}, along_v = {0};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j) {
            const vec c = source->control[i][j];
            p = add_scaled(p, bu[i] * bv[j], c);
            along_u = add_scaled(along_u, du[i] * bv[j], c);
            along_v = add_scaled(along_v, bu[i] * dv[j], c);
        }
    *position = p;
    *normal = cross(along_u, along_v);
    const double size = length(*normal);
    *normal = size > 1e-9 ? add_scaled((vec){0}, 1.0 / size, *normal) : (vec){0};
}
