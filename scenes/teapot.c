/* teapot OUT.obj [N]: the Utah teapot as a mesh, N by N quads a patch (8 unless told otherwise).
 *
 * Martin Newell's 32 bicubic Bezier patches of 1975, z up. Twenty-four of them are quarters of surfaces of
 * revolution, so six profiles say the same as their control points; handle and spout are four patches each,
 * of which two mirror the others in y. The original has no closed surface, and neither has the mesh: it ends
 * at the inner edge of the rim, at the lid's edge, and at both ends of handle and spout; everywhere else
 * neighbours share their vertices. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "core/file.h"

typedef struct point {
    double x, y, z;
} point;

typedef struct patch {
    point control[4][4]; /* [u][v] */
} patch;

/* One ring of control points: a quarter circle of radius r is (r, 0), (r, k r), (k r, r), (0, r). */
typedef struct ring {
    double r, z, k;
} ring;

enum { PROFILE_COUNT = 6, PATCH_COUNT = 32, SUBDIVISIONS_MAXIMUM = 128 };

/* Each runs outwards and down, so that all normals point out of the pot. */
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
static const patch tubes[TUBE_COUNT] = {
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

/* --- patches --- */

static point add_scaled(point a, double s, point b) {
    return (point){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length(point a) {
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

/* The quarter of a profile's surface that is turned by `quarter` right angles. */
static patch quarter_patch(const ring profile[4], size_t quarter) {
    patch result;
    for (size_t u = 0; u < 4; ++u) {
        const double r = profile[u].r, kr = profile[u].k * profile[u].r;
        const double x[4] = {r, r, kr, 0.0}, y[4] = {0.0, kr, r, 0.0};
        for (size_t v = 0; v < 4; ++v) {
            point p = {x[v], v == 3 ? r : y[v], profile[u].z};
            for (size_t turn = 0; turn < quarter; ++turn)
                p = (point){-p.y, p.x, p.z};
            result.control[u][v] = p;
        }
    }
    return result;
}

/* Mirrored in y; v runs backwards, so that the normals still point outwards. */
static patch mirrored(const patch *source) {
    patch result;
    for (size_t u = 0; u < 4; ++u)
        for (size_t v = 0; v < 4; ++v) {
            const point p = source->control[u][3 - v];
            result.control[u][v] = (point){p.x, -p.y, p.z};
        }
    return result;
}

static void make_patches(patch patches[PATCH_COUNT]) {
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

/* Position and outward normal (zero at the poles, where the patch has none). */
static void evaluate(const patch *source, double u, double v, point *position, point *normal) {
    double bu[4], du[4], bv[4], dv[4];
    bernstein(u, bu, du);
    bernstein(v, bv, dv);
    point p = {0}, along_u = {0}, along_v = {0};
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j) {
            const point c = source->control[i][j];
            p = add_scaled(p, bu[i] * bv[j], c);
            along_u = add_scaled(along_u, du[i] * bv[j], c);
            along_v = add_scaled(along_v, bu[i] * dv[j], c);
        }
    *position = p;
    *normal = cross(along_u, along_v);
    const double size = length(*normal);
    *normal = size > 1e-9 ? add_scaled((point){0}, 1.0 / size, *normal) : (point){0};
}

/* --- the mesh --- */

typedef struct mesh {
    size_t vertex_count, triangle_count;
    point *vertices, *normals; /* normals: sums over the patches that meet */
    size_t (*triangles)[3];
} mesh;

static bool same_place(point a, point b) {
    return fabs(a.x - b.x) < 1e-9 && fabs(a.y - b.y) < 1e-9 && fabs(a.z - b.z) < 1e-9;
}

/* The vertex at `position`, a new one where there is none yet. Patches meet at their edges only. */
static size_t add_vertex(mesh *teapot, point position, point normal, bool may_be_shared) {
    size_t index = may_be_shared ? 0 : teapot->vertex_count;
    while (index < teapot->vertex_count && !same_place(teapot->vertices[index], position))
        ++index;
    if (index == teapot->vertex_count) {
        teapot->vertices[index] = position;
        teapot->normals[index] = (point){0};
        ++teapot->vertex_count;
    }
    teapot->normals[index] = add_scaled(teapot->normals[index], 1.0, normal);
    return index;
}

/* At a pole two corners of a quad are one vertex and one of its triangles is nothing. */
static void add_triangle(mesh *teapot, size_t a, size_t b, size_t c) {
    if (a == b || b == c || c == a)
        return;
    size_t *const corners = teapot->triangles[teapot->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

static void add_patch(mesh *teapot, const patch *source, size_t n) {
    size_t grid[SUBDIVISIONS_MAXIMUM + 1][SUBDIVISIONS_MAXIMUM + 1];
    for (size_t i = 0; i <= n; ++i)
        for (size_t j = 0; j <= n; ++j) {
            point position, normal;
            evaluate(source, (double)i / (double)n, (double)j / (double)n, &position, &normal);
            grid[i][j] = add_vertex(teapot, position, normal, i == 0 || i == n || j == 0 || j == n);
        }
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            add_triangle(teapot, grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]);
            add_triangle(teapot, grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]);
        }
}

/* At the two poles, on the axis, the patches have no normal: up above, down below. */
static point unit_normal(const mesh *teapot, size_t index) {
    const double size = length(teapot->normals[index]);
    if (size > 0.0)
        return add_scaled((point){0}, 1.0 / size, teapot->normals[index]);
    return (point){0.0, 0.0, teapot->vertices[index].z > 1.0 ? 1.0 : -1.0};
}

static aur_result write_mesh(const mesh *teapot, const char *path, aur_error *error) {
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK)
        return result;
    fprintf(writer.stream, "# The Utah teapot (Martin Newell 1975), made by scenes/teapot.c. z up.\n");
    for (size_t i = 0; i < teapot->vertex_count; ++i) {
        const point p = teapot->vertices[i];
        fprintf(writer.stream, "v %.6g %.6g %.6g\n", p.x + 0.0, p.y + 0.0, p.z + 0.0);
    }
    for (size_t i = 0; i < teapot->vertex_count; ++i) {
        const point n = unit_normal(teapot, i);
        fprintf(writer.stream, "vn %.4f %.4f %.4f\n", n.x, n.y, n.z);
    }
    for (size_t i = 0; i < teapot->triangle_count; ++i) {
        const size_t *const t = teapot->triangles[i];
        fprintf(writer.stream, "f %zu//%zu %zu//%zu %zu//%zu\n", t[0] + 1, t[0] + 1, t[1] + 1, t[1] + 1,
                t[2] + 1, t[2] + 1);
    }
    return aur_file_commit(&writer, error);
}

static int fail(const aur_error *error) {
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    aur_error_format(error, text, sizeof text);
    fprintf(stderr, "teapot: %s\n", text);
    return 3;
}

int main(int argc, char **argv) {
    char *end = NULL;
    const unsigned long n = argc > 2 ? strtoul(argv[2], &end, 10) : 8;
    if (argc < 2 || argc > 3 || (end != NULL && *end != '\0') || n < 1 || n > SUBDIVISIONS_MAXIMUM) {
        fprintf(stderr, "usage: teapot OUT.obj [N]   N quads along a patch's edge, 1 to %d\n",
                SUBDIVISIONS_MAXIMUM);
        return 2;
    }
    const size_t vertices = PATCH_COUNT * (n + 1) * (n + 1), triangles = 2 * PATCH_COUNT * n * n;
    mesh teapot = {.vertices = malloc(vertices * sizeof *teapot.vertices),
                   .normals = malloc(vertices * sizeof *teapot.normals),
                   .triangles = malloc(triangles * sizeof *teapot.triangles)};
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    aur_result result = AUR_ERROR_MEMORY;
    if (teapot.vertices != NULL && teapot.normals != NULL && teapot.triangles != NULL) {
        patch patches[PATCH_COUNT];
        make_patches(patches);
        for (size_t i = 0; i < PATCH_COUNT; ++i)
            add_patch(&teapot, &patches[i], n);
        result = write_mesh(&teapot, argv[1], &error);
    }
    free(teapot.vertices);
    free(teapot.normals);
    free(teapot.triangles);
    return result == AUR_OK ? 0 : fail(&error);
}
