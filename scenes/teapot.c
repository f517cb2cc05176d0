/* teapot OUT.obj [N]: the Utah teapot as a mesh, N by N quads a patch (8 unless told otherwise), z up.
 *
 * The original has no closed surface, and neither has the mesh: it ends at the inner edge of the rim, at the
 * lid's edge, and at both ends of handle and spout; everywhere else neighbours share their vertices. */
#include <stdbool.h>
#include <stdlib.h>

#include "make/sheet.h"
#include "make/teapot_patches.h"

enum { SUBDIVISIONS_MAXIMUM = 128 };

typedef struct mesh {
    size_t vertex_count, triangle_count;
    vec *vertices, *normals; /* normals: sums over the patches that meet */
    size_t (*triangles)[3];
} mesh;

static bool same_place(vec a, vec b) {
    return fabs(a.x - b.x) < 1e-9 && fabs(a.y - b.y) < 1e-9 && fabs(a.z - b.z) < 1e-9;
}

/* The vertex at `position`, a new one where there is none yet. Patches meet at their edges only. */
static size_t add_vertex(mesh *teapot, vec position, vec normal, bool may_be_shared) {
    size_t index = may_be_shared ? 0 : teapot->vertex_count;
    while (index < teapot->vertex_count && !same_place(teapot->vertices[index], position))
        ++index;
    if (index == teapot->vertex_count) {
        teapot->vertices[index] = position;
        teapot->normals[index] = (vec){0};
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

static void add_patch(mesh *teapot, const teapot_patch *source, size_t n) {
    size_t grid[SUBDIVISIONS_MAXIMUM + 1][SUBDIVISIONS_MAXIMUM + 1];
    for (size_t i = 0; i <= n; ++i)
        for (size_t j = 0; j <= n; ++j) {
            vec position, normal;
            teapot_evaluate(source, (double)i / (double)n, (double)j / (double)n, &position, &normal);
            grid[i][j] = add_vertex(teapot, position, normal, i == 0 || i == n || j == 0 || j == n);
        }
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j) {
            add_triangle(teapot, grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]);
            add_triangle(teapot, grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]);
        }
}

/* At the two poles, on the axis, the patches have no normal: up above, down below. */
static vec unit_normal(const mesh *teapot, size_t index) {
    const double size = length(teapot->normals[index]);
    if (size > 0.0)
        return add_scaled((vec){0}, 1.0 / size, teapot->normals[index]);
    return (vec){0.0, 0.0, teapot->vertices[index].z > 1.0 ? 1.0 : -1.0};
}

static aur_result write_mesh(const mesh *teapot, const char *path, aur_error *error) {
    sheet file;
    const aur_result result = sheet_open(&file, error);
    if (result != AUR_OK)
        return result;
    fprintf(file.stream, "# The Utah teapot (Martin Newell 1975), made by scenes/teapot.c. z up.\n");
    for (size_t i = 0; i < teapot->vertex_count; ++i) {
        const vec p = teapot->vertices[i];
        fprintf(file.stream, "v %.6g %.6g %.6g\n", p.x + 0.0, p.y + 0.0, p.z + 0.0);
    }
    for (size_t i = 0; i < teapot->vertex_count; ++i) {
        const vec n = unit_normal(teapot, i);
        fprintf(file.stream, "vn %.4f %.4f %.4f\n", n.x, n.y, n.z);
    }
    for (size_t i = 0; i < teapot->triangle_count; ++i) {
        const size_t *const t = teapot->triangles[i];
        fprintf(file.stream, "f %zu//%zu %zu//%zu %zu//%zu\n", t[0] + 1, t[0] + 1, t[1] + 1, t[1] + 1,
                t[2] + 1, t[2] + 1);
    }
    return sheet_write(&file, path, error);
}

static int fail(const aur_error *error) {
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    aur_error_format(error, sizeof text, text);
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
    const size_t vertices = TEAPOT_PATCH_COUNT * (n + 1) * (n + 1),
                 triangles = 2 * TEAPOT_PATCH_COUNT * n * n;
    mesh teapot = {.vertices = malloc(vertices * sizeof *teapot.vertices),
                   .normals = malloc(vertices * sizeof *teapot.normals),
                   .triangles = malloc(triangles * sizeof *teapot.triangles)};
    aur_error error = {.result = AUR_ERROR_MEMORY, .message = "out of memory"};
    aur_result result = AUR_ERROR_MEMORY;
    if (teapot.vertices != NULL && teapot.normals != NULL && teapot.triangles != NULL) {
        teapot_patch patches[TEAPOT_PATCH_COUNT];
        teapot_patches(patches);
        for (size_t i = 0; i < TEAPOT_PATCH_COUNT; ++i)
            add_patch(&teapot, &patches[i], n);
        result = write_mesh(&teapot, argv[1], &error);
    }
    free(teapot.vertices);
    free(teapot.normals);
    free(teapot.triangles);
    return result == AUR_OK ? 0 : fail(&error);
}
