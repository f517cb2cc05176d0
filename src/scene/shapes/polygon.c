/* A plane polygon, cut into triangles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "core/vector3d.h"
#include "scene/shape.h"

typedef struct polygon_keys {
    const char *vertices;
} polygon_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(polygon_keys, "vertices", vertices, NULL,
                     "x y z of each corner, counter-clockwise seen from the front; must be given")},
};

/* Corners in the polygon's plane, and the list of those that are not cut off yet. */
typedef struct outline {
    size_t count;
    const double *corners; /* [count][3] */
    double x[3], y[3];     /* axes of the plane */
    uint32_t *left;
    size_t left_count;
} outline;

static void place(const outline *self, uint32_t corner, double p[2]) {
    p[0] = aur_dot3(&self->corners[3 * (size_t)corner], self->x);
    p[1] = aur_dot3(&self->corners[3 * (size_t)corner], self->y);
}

/* Twice the area of a triangle, positive when it turns to the left. */
static double turn(const double a[2], const double b[2], const double c[2]) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Whether the triangle at place i of the list can be cut off: it turns to the left, and no other corner is in
 * it, but for corners that lie on its own, as those of seams to holes do. */
static bool is_ear(const outline *self, size_t i, double *area) {
    const size_t count = self->left_count;
    double a[2], b[2], c[2], p[2];
    place(self, self->left[(i + count - 1) % count], a);
    place(self, self->left[i], b);
    place(self, self->left[(i + 1) % count], c);
    *area = turn(a, b, c);
    if (!(*area > 0.0))
        return false;
    for (size_t k = 2; k + 1 < count; ++k) {
        place(self, self->left[(i + k) % count], p);
        const bool shared = (p[0] == a[0] && p[1] == a[1]) || (p[0] == b[0] && p[1] == b[1]) ||
                            (p[0] == c[0] && p[1] == c[1]);
        if (!shared && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0)
            return false;
    }
    return true;
}

/* Cuts ears off (Meisters 1975), each time the next one that there is. Corners on a line leave without a
 * triangle. Fills indices[3 (count - 2)] and returns the number of triangles, 0 for outlines that cross
 * themselves. */
static size_t cut_ears(outline *self, double total, uint32_t *indices) {
    size_t triangles = 0;
    for (size_t i = 0, tried = 0; self->left_count >= 3;) {
        double area;
        const size_t count = self->left_count;
        const bool ear = is_ear(self, i, &area), flat = fabs(area) <= 1e-14 * total;
        if (!ear && !flat) {
            if (++tried > count)
                return 0;
            i = (i + 1) % count;
            continue;
        }
        if (!flat) {
            indices[3 * triangles] = self->left[(i + count - 1) % count];
            indices[3 * triangles + 1] = self->left[i];
            indices[3 * triangles++ + 2] = self->left[(i + 1) % count];
        }
        memmove(self->left + i, self->left + i + 1, (count - i - 1) * sizeof *self->left);
        --self->left_count;
        /* The neighbours' turn: the next corner has moved to place i. */
        i = self->left_count > 0 ? (i + 1) % self->left_count : 0;
        tried = 0;
    }
    return triangles;
}

static bool is_parallelogram(const double *v) {
    double gap = 0.0, size = 0.0;
    for (size_t d = 0; d < 3; ++d) {
        gap += fabs(v[d] - v[3 + d] + v[6 + d] - v[9 + d]);
        size += fabs(v[6 + d] - v[d]);
    }
    return gap <= 1e-7 * size;
}

static aur_result make_mesh(const aur_shape_input *input, outline *self, aur_shape *shape, aur_error *error) {
    double normal[3] = {0.0, 0.0, 0.0}, size = 0.0;
    for (size_t i = 0; i < self->count; ++i) {
        /* Newell's normal, about the first corner. */
        double a[3], b[3], c[3];
        for (size_t d = 0; d < 3; ++d) {
            a[d] = self->corners[3 * i + d] - self->corners[d];
            b[d] = self->corners[3 * ((i + 1) % self->count) + d] - self->corners[d];
            size = fmax(size, fabs(a[d]));
        }
        aur_cross3(a, b, c);
        for (size_t d = 0; d < 3; ++d)
            normal[d] += c[d];
    }
    const double total = aur_normalize3(normal);
    if (!(total > 0.0) || !isfinite(total))
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "it has no area");
    for (size_t i = 0; i < self->count; ++i) {
        double way[3];
        for (size_t d = 0; d < 3; ++d)
            way[d] = self->corners[3 * i + d] - self->corners[d];
        if (fabs(aur_dot3(way, normal)) > 1e-3 * size)
            return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT,
                                       "corner %zu is %g off the plane of the others", i + 1,
                                       fabs(aur_dot3(way, normal)));
    }
    aur_frame3(normal, self->x, self->y);
    for (size_t i = 0; i < self->count; ++i)
        self->left[i] = (uint32_t)i;
    self->left_count = self->count;
    shape->parallelogram = self->count == 4 && is_parallelogram(self->corners);
    static const uint32_t halves[6] = {0, 1, 2, 0, 2, 3};
    uint32_t *const indices = self->left + self->count;
    const size_t triangles = shape->parallelogram ? 2 : cut_ears(self, total, indices);
    if (triangles == 0)
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "its outline crosses itself");
    const aur_result result = aur_mesh_allocate(&shape->mesh, self->count, triangles, AUR_MESH_POSITIONS_ONLY,
                                                input->parameters->location, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < 3 * self->count; ++i)
        shape->mesh.positions[i] = (float)self->corners[i];
    memcpy(shape->mesh.indices, shape->parallelogram ? halves : indices, 3 * triangles * sizeof *indices);
    aur_shape_place(input, shape);
    return AUR_OK;
}

static aur_result create(const aur_shape_input *input, aur_shape *shape, aur_error *error) {
    polygon_keys p = {.vertices = NULL};
    const aur_result result = aur_row_read(&shape->descriptor->row, input->parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (p.vertices == NULL)
        return aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT, "it needs 'vertices'");
    /* A number takes two characters at least. */
    const size_t capacity = strlen(p.vertices) / 2 + 1;
    double *const corners = malloc(capacity * sizeof *corners);
    uint32_t *const lists = malloc(2 * capacity * sizeof *lists); /* the list and the triangles */
    aur_result made = corners != NULL && lists != NULL ? AUR_OK : aur_fail_memory(error);
    if (made == AUR_OK) {
        const size_t numbers = aur_parse_doubles(p.vertices, corners, capacity);
        outline self = {.count = numbers / 3, .corners = corners, .left = lists};
        bool finite = numbers != SIZE_MAX && numbers >= 9 && numbers % 3 == 0;
        for (size_t i = 0; finite && i < numbers; ++i)
            finite = fabs(corners[i]) <= AUR_REACH;
        made = finite ? make_mesh(input, &self, shape, error)
                      : aur_parameters_fail(input->parameters, error, AUR_ERROR_FORMAT,
                                            "'vertices' must be three numbers a corner, within %g, of three "
                                            "corners or more",
                                            AUR_REACH);
    }
    free(corners);
    free(lists);
    return made;
}

const aur_shape_descriptor aur_shape_polygon = {
    .row = {.name = "polygon", .summary = "a plane polygon of any outline", AUR_ROW_KEYS(keys)},
    .create = create};
