/* Sharp edges of meshes without normals: vertices are duplicated where the triangles around them meet at a
 * larger angle, so that vertex normals average only over smooth fans. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/mesh.h"

/* An edge of a triangle at the vertex being processed. */
typedef struct side {
    uint32_t other;  /* the vertex at its other end */
    uint32_t corner; /* index of the triangle among those at the vertex */
} side;

typedef struct creases {
    const aur_mesh *mesh;
    float least_cosine;
    float *normals;    /* 3 * triangle_count; zero for degenerate triangles */
    size_t *firsts;    /* first of each vertex in `corners` */
    uint32_t *corners; /* 3 * triangle + k, sorted by vertex */
    side *sides;       /* two for each corner at one vertex */
    uint32_t *parents; /* union-find over the corners at one vertex: those of a smooth fan share a root */
    uint32_t *fans;    /* the new index of the root's fan */
    size_t copies;     /* number of added vertices */
    uint32_t *copied;  /* of each added vertex: the original */
    uint32_t *indices; /* 3 * triangle_count, the new indices */
} creases;

static int compare_sides(const void *a, const void *b) {
    const side *const s = a, *const t = b;
    if (s->other != t->other)
        return s->other < t->other ? -1 : 1;
    return s->corner < t->corner ? -1 : s->corner > t->corner;
}

static uint32_t root_of(creases *self, uint32_t corner) {
    while (self->parents[corner] != corner) {
        self->parents[corner] = self->parents[self->parents[corner]];
        corner = self->parents[corner];
    }
    return corner;
}

static void find_normals(creases *self) {
    const aur_mesh *const mesh = self->mesh;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const double *corner[3];
        for (size_t k = 0; k < 3; ++k)
            corner[k] = &mesh->points[3 * (size_t)mesh->indices[3 * i + k]];
        double a[3], b[3], normal[3];
        for (size_t d = 0; d < 3; ++d) {
            a[d] = corner[1][d] - corner[0][d];
            b[d] = corner[2][d] - corner[0][d];
        }
        aur_cross3(a, b, normal);
        const double length = sqrt(aur_dot3(normal, normal));
        for (size_t d = 0; d < 3; ++d)
            self->normals[3 * i + d] = length > 0.0 ? (float)(normal[d] / length) : 0.0f;
    }
}

/* Sorts corners by vertex. Returns the largest number of corners at one vertex. */
static size_t sort_corners(creases *self) {
    const aur_mesh *const mesh = self->mesh;
    size_t most = 0;
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i)
        ++self->firsts[mesh->indices[i] + 1];
    for (size_t v = 0; v < mesh->vertex_count; ++v) {
        most = self->firsts[v + 1] > most ? self->firsts[v + 1] : most;
        self->firsts[v + 1] += self->firsts[v];
    }
    for (size_t i = 3 * mesh->triangle_count;
         i-- > 0;) /* in reverse, so that the order at each vertex is stable */
        self->corners[--self->firsts[mesh->indices[i] + 1]] = (uint32_t)i;
    /* Ends have become beginnings: shift by one. */
    memmove(self->firsts, self->firsts + 1, mesh->vertex_count * sizeof *self->firsts);
    self->firsts[mesh->vertex_count] = 3 * mesh->triangle_count;
    return most;
}

static bool is_smooth(const creases *self, uint32_t a, uint32_t b) {
    const float *const m = &self->normals[3 * (size_t)(a / 3)], *const n =
                                                                    &self->normals[3 * (size_t)(b / 3)];
    return m[0] * n[0] + m[1] * n[1] + m[2] * n[2] >= self->least_cosine;
}

/* Unites the corners at a vertex whose triangles share a smooth edge, and gives each fan but the first a copy
 * of the vertex. */
static void divide_vertex(creases *self, uint32_t vertex) {
    const uint32_t *const at = &self->corners[self->firsts[vertex]];
    const uint32_t count = (uint32_t)(self->firsts[vertex + 1] - self->firsts[vertex]);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t first = at[i] - at[i] % 3, k = at[i] % 3;
        self->sides[2 * i] = (side){self->mesh->indices[first + (k + 1) % 3], i};
        self->sides[2 * i + 1] = (side){self->mesh->indices[first + (k + 2) % 3], i};
        self->parents[i] = i;
    }
    qsort(self->sides, 2 * (size_t)count, sizeof *self->sides, compare_sides);
    for (uint32_t i = 1; i < 2 * count; ++i) {
        const side *const s = &self->sides[i - 1], *const t = &self->sides[i];
        if (s->other != t->other || !is_smooth(self, at[s->corner], at[t->corner]))
            continue;
        const uint32_t a = root_of(self, s->corner), b = root_of(self, t->corner);
        self->parents[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t root = root_of(self, i); /* the fan's first corner */
        if (root == i && i > 0)
            self->copied[self->copies++] = vertex;
        if (root == i)
            self->fans[i] = i == 0 ? vertex : (uint32_t)(self->mesh->vertex_count + self->copies - 1);
        self->indices[at[i]] = self->fans[root];
    }
}

static bool copy_values(float **values, size_t width, const creases *self) {
    if (*values == NULL)
        return true;
    const size_t count = self->mesh->vertex_count;
    float *const grown = realloc(*values, (width * (count + self->copies) + 1) * sizeof(float));
    if (grown == NULL)
        return false;
    *values = grown;
    for (size_t i = 0; i < self->copies; ++i)
        memcpy(&grown[width * (count + i)], &grown[width * (size_t)self->copied[i]], width * sizeof(float));
    return true;
}

/* Applies copies and indices to the mesh. False: out of memory; the mesh is then unchanged up to capacity. */
static bool take(creases *self, aur_mesh *mesh) {
    const size_t count = mesh->vertex_count;
    double *const points = realloc(mesh->points, (3 * (count + self->copies) + 1) * sizeof(double));
    if (points == NULL)
        return false;
    mesh->points = points;
    if (!copy_values(&mesh->uvs, 2, self) || !copy_values(&mesh->vertex_colors, 3, self))
        return false;
    for (size_t i = 0; i < self->copies; ++i)
        memcpy(&points[3 * (count + i)], &points[3 * (size_t)self->copied[i]], 3 * sizeof(double));
    mesh->vertex_count += self->copies;
    aur_mesh_take_indices(mesh, 3 * mesh->triangle_count, &self->indices);
    return true;
}

static void release(creases *self) {
    free(self->normals);
    free(self->firsts);
    free(self->corners);
    free(self->sides);
    free(self->parents);
    free(self->fans);
    free(self->copied);
    free(self->indices);
}

aur_result aur_mesh_split_creases(aur_mesh *mesh, double degrees, aur_location location, aur_error *error) {
    const double pi = 3.14159265358979323846;
    const size_t corners = 3 * mesh->triangle_count;
    if (mesh->vertex_count + corners > UINT32_MAX) /* index overflow if all were copied */
        return AUR_OK;
    creases self = {.mesh = mesh,
                    .least_cosine = (float)cos(degrees * pi / 180.0),
                    .normals = malloc((corners + 1) * sizeof *self.normals),
                    .firsts = calloc(mesh->vertex_count + 2, sizeof *self.firsts),
                    .corners = malloc((corners + 1) * sizeof *self.corners),
                    .copied = malloc((corners + 1) * sizeof *self.copied),
                    .indices = malloc((corners + 1) * sizeof *self.indices)};
    bool good = self.normals != NULL && self.firsts != NULL && self.corners != NULL && self.copied != NULL &&
                self.indices != NULL;
    if (good) {
        find_normals(&self);
        const size_t most = sort_corners(&self);
        self.sides = malloc((2 * most + 1) * sizeof *self.sides);
        self.parents = malloc((most + 1) * sizeof *self.parents);
        self.fans = malloc((most + 1) * sizeof *self.fans);
        good = self.sides != NULL && self.parents != NULL && self.fans != NULL;
    }
    for (size_t v = 0; v < mesh->vertex_count && good; ++v)
        divide_vertex(&self, (uint32_t)v);
    good = good && (self.copies == 0 || take(&self, mesh));
    release(&self);
    return good ? AUR_OK : aur_fail_memory_at(error, location);
}
