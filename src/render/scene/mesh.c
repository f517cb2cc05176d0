#include "render/scene/mesh.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

aur_result aur_mesh_allocate(aur_mesh *mesh, size_t vertex_count, size_t triangle_count, unsigned parts,
                             aur_location location, aur_error *error) {
    *mesh = (aur_mesh){0};
    if (vertex_count > UINT32_MAX - 1 || triangle_count > UINT32_MAX - 1)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "a mesh of %zu vertices and %zu triangles is too large: the limit is 2^32 - 2",
                           vertex_count, triangle_count);
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->points = calloc(3 * vertex_count + 1, sizeof(double));
    mesh->indices = calloc(3 * triangle_count + 1, sizeof(uint32_t));
    if (parts & AUR_MESH_NORMALS)
        mesh->normals = calloc(3 * vertex_count + 1, sizeof(float));
    if (parts & AUR_MESH_UVS)
        mesh->uvs = calloc(2 * vertex_count + 1, sizeof(float));
    if (parts & AUR_MESH_VERTEX_COLORS)
        mesh->vertex_colors = calloc(3 * vertex_count + 1, sizeof(float));
    if (mesh->points != NULL && mesh->indices != NULL &&
        (mesh->normals != NULL || !(parts & AUR_MESH_NORMALS)) &&
        (mesh->uvs != NULL || !(parts & AUR_MESH_UVS)) &&
        (mesh->vertex_colors != NULL || !(parts & AUR_MESH_VERTEX_COLORS)))
        return AUR_OK;
    aur_mesh_release(mesh);
    return aur_fail_at(error, location, AUR_ERROR_MEMORY, "out of memory for %zu vertices and %zu triangles",
                       vertex_count, triangle_count);
}

void aur_mesh_release(aur_mesh *mesh) {
    free(mesh->points);
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->indices);
    free(mesh->sources);
    free(mesh->vertex_colors);
    free(mesh->face_colors);
    *mesh = (aur_mesh){0};
}

void aur_mesh_take_indices(aur_mesh *mesh, size_t count, uint32_t **indices) {
    free(mesh->indices);
    mesh->indices = *indices;
    mesh->triangle_count = count / 3;
    *indices = NULL;
}

static aur_vector vector_at(const float *values) {
    return (aur_vector){values[0], values[1], values[2]};
}

static void put(float *values, aur_vector v) {
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

static void turn_winding(aur_mesh *mesh) {
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t second = mesh->indices[3 * i + 1];
        mesh->indices[3 * i + 1] = mesh->indices[3 * i + 2];
        mesh->indices[3 * i + 2] = second;
    }
}

void aur_mesh_transform(aur_mesh *mesh, const aur_transform *to_world, const aur_transform *to_local) {
    static const double identity[12] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0};
    if (mesh->normals == NULL && memcmp(to_world->m, identity, sizeof identity) == 0) {
        for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
            mesh->points[i] += 0.0; /* as the map does: -0 becomes 0 */
        return;
    }
    for (size_t i = 0; i < 3 * mesh->vertex_count; i += 3) {
        const double local[3] = {mesh->points[i], mesh->points[i + 1], mesh->points[i + 2]};
        aur_transform_point(to_world, local, &mesh->points[i]);
        if (mesh->normals != NULL)
            put(&mesh->normals[i],
                aur_vector_normalize(aur_transform_normal_f(to_local, vector_at(&mesh->normals[i]))));
    }
    if (aur_transform_determinant(to_world) < 0.0)
        turn_winding(mesh);
}

/* Larger meshes store their points in doubles, 24 bytes each, only on request. */
enum { EXACT_VERTICES = 1 << 16 };

aur_result aur_mesh_recenter(aur_mesh *mesh, const double origin[3], bool with_points, aur_location location,
                             aur_error *error) {
    mesh->positions = malloc((3 * mesh->vertex_count + 1) * sizeof(float));
    if (mesh->positions == NULL)
        return aur_fail_memory_at(error, location);
    /* Four vertices at a time fill whole vectors of coordinates. */
    enum { STEP = 12 };
    double origins[STEP];
    size_t i = 0;
    for (size_t k = 0; k < STEP; ++k)
        origins[k] = origin[k % 3];
    for (; i + STEP <= 3 * mesh->vertex_count; i += STEP)
        for (size_t k = 0; k < STEP; ++k)
            mesh->positions[i + k] = (float)(mesh->points[i + k] - origins[k]);
    for (size_t k = 0; i < 3 * mesh->vertex_count; ++i, ++k)
        mesh->positions[i] = (float)(mesh->points[i] - origins[k]);
    mesh->positions[3 * mesh->vertex_count] = 0.0f;
    if (with_points || mesh->vertex_count <= EXACT_VERTICES)
        return AUR_OK;
    free(mesh->points);
    mesh->points = NULL;
    return AUR_OK;
}

void aur_mesh_flip(aur_mesh *mesh) {
    turn_winding(mesh);
    for (size_t i = 0; mesh->normals != NULL && i < 3 * mesh->vertex_count; ++i)
        mesh->normals[i] = -mesh->normals[i];
}

/* The angle between two edges, accurate for thin triangles (Kahan's formula). */
static float angle_between(aur_vector a, aur_vector b) {
    a = aur_vector_normalize(a);
    b = aur_vector_normalize(b);
    return 2.0f *
           atan2f(aur_vector_length(aur_vector_subtract(a, b)), aur_vector_length(aur_vector_add(a, b)));
}

aur_result aur_mesh_smooth(aur_mesh *mesh, aur_location location, aur_error *error) {
    free(mesh->normals);
    mesh->normals = calloc(3 * mesh->vertex_count + 1, sizeof(float));
    if (mesh->normals == NULL)
        return aur_fail_memory_at(error, location);
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        aur_vector corner[3];
        aur_mesh_corners(mesh, i, corner);
        const aur_vector normal = aur_triangle_normal(corner);
        for (size_t k = 0; k < 3; ++k) {
            const aur_vector here = corner[k];
            const float angle = angle_between(aur_vector_subtract(corner[(k + 1) % 3], here),
                                              aur_vector_subtract(corner[(k + 2) % 3], here));
            float *const sum = &mesh->normals[3 * (size_t)mesh->indices[3 * i + k]];
            put(sum, aur_vector_add_scaled(vector_at(sum), angle, normal));
        }
    }
    for (size_t i = 0; i < 3 * mesh->vertex_count; i += 3)
        put(&mesh->normals[i], aur_vector_normalize(vector_at(&mesh->normals[i])));
    return AUR_OK;
}

/* Normals are rounded to floats, and so are cross products: 1e-6 is about ten times that. */
static bool is_flat(const aur_mesh *mesh) {
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        aur_vector corner[3];
        aur_mesh_corners(mesh, i, corner);
        const aur_vector normal = aur_triangle_normal(corner);
        for (size_t k = 0; k < 3 && !aur_vector_is_zero(normal); ++k) {
            const aur_vector here = vector_at(&mesh->normals[3 * (size_t)mesh->indices[3 * i + k]]);
            if (!(aur_vector_length(aur_vector_subtract(here, normal)) <= 1e-6f))
                return false;
        }
    }
    return true;
}

void aur_mesh_drop_flat_normals(aur_mesh *mesh) {
    if (mesh->normals == NULL || !is_flat(mesh))
        return;
    free(mesh->normals);
    mesh->normals = NULL;
}

aur_result aur_mesh_check(const aur_mesh *mesh, aur_location location, aur_error *error) {
    if (mesh->triangle_count > UINT32_MAX - 1)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "%zu triangles are too many: the limit is 2^32 - 2", mesh->triangle_count);
    uint64_t endless = 0;
    uint32_t outside = 0;
    const uint32_t count = mesh->vertex_count < UINT32_MAX ? (uint32_t)mesh->vertex_count : UINT32_MAX;
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i)
        endless |= !(fabs(mesh->points[i]) <= (double)FLT_MAX);
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        outside |= mesh->indices[i] >= count;
    for (size_t i = 0; i < 3 * mesh->vertex_count && endless != 0; ++i)
        if (!(fabs(mesh->points[i]) <= (double)FLT_MAX))
            return aur_fail_at(error, location, AUR_ERROR_FORMAT, "vertex %zu is not finite", i / 3);
    for (size_t i = 0; i < 3 * mesh->triangle_count && outside != 0; ++i)
        if (mesh->indices[i] >= mesh->vertex_count)
            return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                               "triangle %zu: index %u is beyond the %zu vertices", i / 3,
                               (unsigned)mesh->indices[i], mesh->vertex_count);
    return AUR_OK;
}

aur_vector aur_extreme_triangle_normal(aur_vector a, aur_vector b, double *doubled_area) {
    /* Scales by a power of two, which is exact, to edges of about 1. */
    const float largest = fmaxf(fmaxf(fmaxf(fabsf(a.x), fabsf(a.y)), fmaxf(fabsf(a.z), fabsf(b.x))),
                                fmaxf(fabsf(b.y), fabsf(b.z)));
    int exponent = 0;
    frexpf(largest, &exponent);
    const float scale = ldexpf(1.0f, -exponent);
    const aur_vector cross = aur_vector_cross(aur_vector_scale(a, scale), aur_vector_scale(b, scale));
    const float length = aur_vector_length(cross);
    if (doubled_area != NULL)
        *doubled_area = ldexp((double)length, 2 * exponent);
    return length > 0.0f && isfinite(length) ? aur_vector_scale(cross, 1.0f / length) : (aur_vector){0};
}
