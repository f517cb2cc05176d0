#include "mesh.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void mesh_release(mesh *m) {
    free(m->positions);
    free(m->normals);
    free(m->triangles);
    *m = (mesh){0};
}

/* Room for one more; false, and remembered, when there is no memory. */
static bool grow(mesh *m, size_t size, size_t capacity, void **elements) {
    void *const moved = realloc(*elements, size * capacity);
    if (moved != NULL)
        *elements = moved;
    else
        m->out_of_memory = true;
    return moved != NULL;
}

uint32_t mesh_vertex(mesh *m, vec position, vec normal) {
    if (m->vertex_count == m->vertex_capacity) {
        const size_t capacity = m->vertex_capacity == 0 ? 4096 : 2 * m->vertex_capacity;
        void *positions = m->positions, *normals = m->normals;
        const bool grown = grow(m, sizeof *m->positions, capacity, &positions) &&
                           grow(m, sizeof *m->normals, capacity, &normals);
        m->positions = positions;
        m->normals = normals;
        if (!grown)
            return 0;
        m->vertex_capacity = capacity;
    }
    m->positions[m->vertex_count] = position;
    m->normals[m->vertex_count] = normal;
    return (uint32_t)m->vertex_count++;
}

void mesh_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c) {
    if (a == b || b == c || c == a)
        return;
    if (m->triangle_count == m->triangle_capacity) {
        const size_t capacity = m->triangle_capacity == 0 ? 8192 : 2 * m->triangle_capacity;
        void *triangles = m->triangles;
        if (!grow(m, sizeof *m->triangles, capacity, &triangles))
            return;
        m->triangles = triangles;
        m->triangle_capacity = capacity;
    }
    uint32_t *const corners = m->triangles[m->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

void mesh_smooth(mesh *m, size_t first, size_t first_triangle) {
    if (m->out_of_memory)
        return;
    for (size_t i = first; i < m->vertex_count; ++i)
        m->normals[i] = (vec){0};
    for (size_t i = first_triangle; i < m->triangle_count; ++i) {
        const uint32_t *const t = m->triangles[i];
        const vec a = m->positions[t[0]];
        const vec weighted = cross(subtract(m->positions[t[1]], a), subtract(m->positions[t[2]], a));
        for (size_t k = 0; k < 3; ++k)
            m->normals[t[k]] = add(m->normals[t[k]], weighted);
    }
    for (size_t i = first; i < m->vertex_count; ++i)
        m->normals[i] = normalize(m->normals[i]);
}

/* --- grids */

typedef struct grid_ids {
    size_t rows, columns; /* vertices */
    uint32_t *id;
} grid_ids;

static bool is_point(const grid *size, surface_function function, const void *context, bool along_v,
                     double at) {
    if (along_v ? size->wraps_u : size->wraps_v)
        return false;
    const vec start = along_v ? function(context, at, 0.0) : function(context, 0.0, at);
    for (size_t i = 1; i <= 3; ++i) {
        const double t = 0.31 * (double)i;
        const vec p = along_v ? function(context, at, t) : function(context, t, at);
        if (length(subtract(p, start)) > 1e-9)
            return false;
    }
    return true;
}

static void fill_ids(mesh *m, const grid *size, surface_function function, const void *context,
                     const grid_ids *ids) {
    const bool point_u[2] = {is_point(size, function, context, true, 0.0),
                             is_point(size, function, context, true, 1.0)};
    const bool point_v[2] = {is_point(size, function, context, false, 0.0),
                             is_point(size, function, context, false, 1.0)};
    for (size_t i = 0; i < ids->rows; ++i)
        for (size_t j = 0; j < ids->columns; ++j) {
            uint32_t *const id = &ids->id[i * ids->columns + j];
            const bool same_row = j > 0 && ((i == 0 && point_u[0]) || (i + 1 == ids->rows && point_u[1]));
            const bool same_column =
                i > 0 && ((j == 0 && point_v[0]) || (j + 1 == ids->columns && point_v[1]));
            if (same_row)
                *id = id[-1];
            else if (same_column)
                *id = *(id - ids->columns);
            else
                *id = mesh_vertex(
                    m, function(context, (double)i / (double)size->rows, (double)j / (double)size->columns),
                    (vec){0});
        }
}

void mesh_grid(mesh *m, const grid *size, surface_function function, const void *context) {
    const size_t first = m->vertex_count, first_triangle = m->triangle_count;
    grid_ids ids = {.rows = size->rows + !size->wraps_u, .columns = size->columns + !size->wraps_v};
    ids.id = calloc(ids.rows * ids.columns, sizeof *ids.id);
    if (ids.id == NULL) {
        m->out_of_memory = true;
        return;
    }
    fill_ids(m, size, function, context, &ids);
    for (size_t i = 0; i < size->rows; ++i)
        for (size_t j = 0; j < size->columns; ++j) {
            const size_t below = i * ids.columns, above = (i + 1) % ids.rows * ids.columns;
            const size_t right = (j + 1) % ids.columns;
            const uint32_t a = ids.id[below + j], b = ids.id[above + j];
            const uint32_t c = ids.id[above + right], d = ids.id[below + right];
            mesh_triangle(m, a, b, c);
            mesh_triangle(m, a, c, d);
        }
    free(ids.id);
    mesh_smooth(m, first, first_triangle);
}

/* --- surfaces of revolution */

void profile_at(const profile *shape, double u, double point[2]) {
    /* The end points stand there three times. */
    const double at = clamp(u, 0.0, 1.0) * (double)(shape->count + 1);
    const size_t segment = at < (double)shape->count ? (size_t)at : shape->count;
    const double t = at - (double)segment, s = 1.0 - t;
    const double weight[4] = {s * s * s / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
                              (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0, t * t * t / 6.0};
    point[0] = point[1] = 0.0;
    for (size_t k = 0; k < 4; ++k) {
        const size_t index = segment + k < 2 ? 0 : segment + k - 2;
        const double *const control = shape->points[index < shape->count ? index : shape->count - 1];
        point[0] += weight[k] * control[0];
        point[1] += weight[k] * control[1];
    }
    if (u <= 0.0 || u >= 1.0) { /* to the last bit, so that poles are one point */
        const double *const end = shape->points[u <= 0.0 ? 0 : shape->count - 1];
        point[0] = end[0];
        point[1] = end[1];
    }
}

static vec revolved(const void *context, double u, double v) {
    double point[2];
    profile_at(context, u, point);
    const double angle = 2.0 * PI * v;
    return (vec){point[0] * cos(angle), point[1], point[0] * sin(angle)};
}

void mesh_revolve(mesh *m, const profile *shape, size_t rows, size_t columns) {
    const grid size = {.rows = rows, .columns = columns, .wraps_v = true};
    mesh_grid(m, &size, revolved, shape);
}

/* --- tubes */

static vec tangent_at(const tube *shape, double u) {
    const double step = 1e-4;
    double before = u - step, after = u + step;
    if (!shape->closed) {
        before = fmax(before, 0.0);
        after = fmin(after, 1.0);
    }
    return normalize(subtract(shape->curve(shape->context, after), shape->curve(shape->context, before)));
}

/* The part of `a` that is perpendicular to the unit vector `t`, unit. */
static vec perpendicular(vec a, vec t) {
    return normalize(add_scaled(a, -dot(a, t), t));
}

typedef struct ring {
    vec center, side, up;
    double radius;
} ring;

static void tube_rings(const tube *shape, size_t count, ring *rings) {
    vec tangent = tangent_at(shape, 0.0);
    const vec start = fabs(tangent.y) < 0.9 ? (vec){0.0, 1.0, 0.0} : (vec){1.0, 0.0, 0.0};
    vec side = perpendicular(start, tangent);
    for (size_t i = 0; i < count; ++i) {
        const double u = (double)i / (double)shape->rows;
        tangent = tangent_at(shape, u);
        side = perpendicular(side, tangent);
        rings[i] = (ring){shape->curve(shape->context, u), side, cross(tangent, side),
                          shape->radius(shape->context, u)};
    }
    if (!shape->closed)
        return;
    /* The frame comes back turned; the turn is spread over all rings. */
    tangent = tangent_at(shape, 0.0);
    side = perpendicular(side, tangent);
    const double twist = atan2(dot(side, rings[0].up), dot(side, rings[0].side));
    for (size_t i = 0; i < count; ++i) {
        const double angle = -twist * (double)i / (double)shape->rows;
        const vec turned = add_scaled(scale(rings[i].side, cos(angle)), sin(angle), rings[i].up);
        rings[i].up = add_scaled(scale(rings[i].up, cos(angle)), -sin(angle), rings[i].side);
        rings[i].side = turned;
    }
}

enum { CAP_ROWS = 8 };

typedef struct tube_surface {
    size_t ring_count;
    const ring *rings;
    bool closed;
} tube_surface;

/* Row i of the rings, with a hemisphere of CAP_ROWS rows before and after those of an open tube. */
static vec tube_point(const void *context, double u, double v) {
    const tube_surface *const s = context;
    const size_t rows = s->closed ? s->ring_count : s->ring_count - 1 + 2 * CAP_ROWS;
    const size_t row = (size_t)(u * (double)rows + 0.5);
    const double angle = -2.0 * PI * v;
    double ahead = 0.0, shrink = 1.0;
    size_t index = row % s->ring_count;
    if (!s->closed) {
        const bool before = row<CAP_ROWS, after = row> CAP_ROWS + s->ring_count - 1;
        index = before ? 0 : after ? s->ring_count - 1 : row - CAP_ROWS;
        const size_t left = before ? CAP_ROWS - row : after ? row - (CAP_ROWS + s->ring_count - 1) : 0;
        const double bend = 0.5 * PI * (double)left / CAP_ROWS;
        shrink = left == CAP_ROWS ? 0.0 : cos(bend);
        ahead = (before ? -1.0 : 1.0) * sin(bend);
    }
    const ring *const r = &s->rings[index];
    const vec out = add_scaled(scale(r->side, cos(angle)), sin(angle), r->up);
    return add_scaled(add_scaled(r->center, shrink * r->radius, out), ahead * r->radius,
                      cross(r->side, r->up));
}

void mesh_tube(mesh *m, const tube *shape) {
    const size_t count = shape->rows + !shape->closed;
    ring *const rings = malloc(count * sizeof *rings);
    if (rings == NULL) {
        m->out_of_memory = true;
        return;
    }
    tube_rings(shape, count, rings);
    const tube_surface around = {count, rings, shape->closed};
    const grid size = {.rows = shape->closed ? count : count - 1 + 2 * CAP_ROWS,
                       .columns = shape->columns,
                       .wraps_u = shape->closed,
                       .wraps_v = true};
    mesh_grid(m, &size, tube_point, &around);
    free(rings);
}

void mesh_place(mesh *m, size_t first, double size, double angle, vec move) {
    for (size_t i = first; i < m->vertex_count; ++i) {
        m->positions[i] = add(turn_y(scale(m->positions[i], size), angle), move);
        m->normals[i] = turn_y(m->normals[i], angle);
    }
}

/* --- the file */

static char *put_vec(char *at, vec v) {
    const float values[3] = {(float)v.x, (float)v.y, (float)v.z};
    memcpy(at, values, sizeof values);
    return at + sizeof values;
}

aur_result mesh_write(const mesh *m, const char *path, aur_error *error) {
    char head[512];
    const int head_size = snprintf(
        head, sizeof head,
        "ply\nformat binary_little_endian 1.0\ncomment made by aureole-scenes\nelement vertex %zu\n"
        "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
        "property float nz\nelement face %zu\nproperty list uchar int vertex_index\nend_header\n",
        m->vertex_count, m->triangle_count);
    const size_t size = (size_t)head_size + m->vertex_count * 6 * sizeof(float) +
                        m->triangle_count * (1 + 3 * sizeof(uint32_t));
    char *const data = m->out_of_memory ? NULL : malloc(size);
    if (data == NULL) {
        if (error != NULL) {
            *error = (aur_error){.result = AUR_ERROR_MEMORY};
            snprintf(error->file, sizeof error->file, "%s", path);
            snprintf(error->message, sizeof error->message, "out of memory for a mesh");
        }
        return AUR_ERROR_MEMORY;
    }
    memcpy(data, head, (size_t)head_size);
    char *at = data + head_size;
    for (size_t i = 0; i < m->vertex_count; ++i)
        at = put_vec(put_vec(at, m->positions[i]), m->normals[i]);
    for (size_t i = 0; i < m->triangle_count; ++i) {
        *at++ = 3;
        memcpy(at, m->triangles[i], sizeof m->triangles[i]);
        at += sizeof m->triangles[i];
    }
    const aur_result result = aur_file_write(path, size, data, error);
    free(data);
    return result;
}
