#include "surface_net.h"

#include <stdlib.h>

#include "points/base/parallel.h"

enum { BLOCK = 8, CHUNK = 512 };

typedef struct net {
    const solid_box *box;
    solid function;
    const void *context;
    size_t cells[3], blocks[3];
    signed char *block_state; /* 0: crossed by the skin, else the sign of the whole block */
    size_t plane;             /* being sampled */
    float *values[2];         /* corners of two planes, z after z */
    uint32_t *ids[2];         /* vertices of two layers of cells */
    mesh *surface;
} net;

static vec corner_at(const net *n, double i, double j, double k) {
    const double cell = n->box->cell;
    return add(n->box->lower, (vec){i * cell, j * cell, k * cell});
}

static aur_result sample_blocks(void *context, size_t k) {
    const net *const n = context;
    const double reach = 0.5 * sqrt(3.0) * BLOCK * n->box->cell + n->box->slack;
    for (size_t j = 0; j < n->blocks[1]; ++j)
        for (size_t i = 0; i < n->blocks[0]; ++i) {
            const double d =
                n->function(n->context, corner_at(n, BLOCK * ((double)i + 0.5), BLOCK * ((double)j + 0.5),
                                                  BLOCK * ((double)k + 0.5)));
            n->block_state[(k * n->blocks[1] + j) * n->blocks[0] + i] = fabs(d) < reach ? 0
                                                                        : d < 0.0       ? -1
                                                                                        : 1;
        }
    return AUR_OK;
}

/* The state of a corner: 0 when one of the blocks that it belongs to is crossed. */
static signed char corner_state(const net *n, const size_t at[3]) {
    size_t low[3], high[3];
    for (size_t a = 0; a < 3; ++a) {
        low[a] = at[a] > 0 ? (at[a] - 1) / BLOCK : 0;
        high[a] = at[a] / BLOCK < n->blocks[a] ? at[a] / BLOCK : n->blocks[a] - 1;
    }
    signed char state = 1;
    for (size_t k = low[2]; k <= high[2]; ++k)
        for (size_t j = low[1]; j <= high[1]; ++j)
            for (size_t i = low[0]; i <= high[0]; ++i) {
                state = n->block_state[(k * n->blocks[1] + j) * n->blocks[0] + i];
                if (state == 0)
                    return 0;
            }
    return state;
}

static aur_result sample_row(void *context, size_t j) {
    const net *const n = context;
    const size_t width = n->cells[0] + 1;
    float *const row = n->values[n->plane % 2] + j * width;
    for (size_t i = 0; i < width; ++i) {
        const signed char state = corner_state(n, (const size_t[3]){i, j, n->plane});
        row[i] = state != 0
                     ? (float)state
                     : (float)n->function(n->context, corner_at(n, (double)i, (double)j, (double)n->plane));
    }
    return AUR_OK;
}

/* Corner c of a cell: bits x, y, z. */
static double cell_value(const net *n, size_t i, size_t j, size_t k, size_t c) {
    const size_t width = n->cells[0] + 1;
    return n->values[(k + (c >> 2)) % 2][(j + (c >> 1 & 1)) * width + i + (c & 1)];
}

static void cell_vertex(net *n, size_t i, size_t j, size_t k) {
    double value[8];
    size_t inside = 0;
    for (size_t c = 0; c < 8; ++c) {
        value[c] = cell_value(n, i, j, k, c);
        inside += value[c] < 0.0;
    }
    if (inside == 0 || inside == 8)
        return;
    vec sum = {0};
    double count = 0.0;
    for (size_t a = 0; a < 8; ++a)
        for (size_t axis = 0; axis < 3; ++axis) {
            const size_t b = a | (size_t)1 << axis;
            if (b == a || (value[a] < 0.0) == (value[b] < 0.0))
                continue;
            const double t = value[a] / (value[a] - value[b]);
            double at[3] = {(double)(a & 1), (double)(a >> 1 & 1), (double)(a >> 2)};
            at[axis] = t;
            sum = add(sum, (vec){at[0], at[1], at[2]});
            count += 1.0;
        }
    const vec middle = scale(sum, 1.0 / count);
    n->ids[k % 2][j * n->cells[0] + i] = mesh_vertex(
        n->surface, corner_at(n, (double)i + middle.x, (double)j + middle.y, (double)k + middle.z), (vec){0});
}

/* Two triangles, split along the shorter diagonal. */
static void quad(mesh *m, const uint32_t id[4], bool reversed) {
    if (m->out_of_memory)
        return;
    const uint32_t a = id[0], b = id[reversed ? 3 : 1], c = id[2], d = id[reversed ? 1 : 3];
    const double across = length(subtract(m->positions[a], m->positions[c]));
    if (across <= length(subtract(m->positions[b], m->positions[d]))) {
        mesh_triangle(m, a, b, c);
        mesh_triangle(m, a, c, d);
    } else {
        mesh_triangle(m, b, c, d);
        mesh_triangle(m, b, d, a);
    }
}

/* The edges of layer k's near plane along x and y, and its edges along z. */
static void layer_quads(const net *n, size_t k) {
    const size_t width = n->cells[0];
    for (size_t j = 0; j < n->cells[1]; ++j)
        for (size_t i = 0; i < width; ++i) {
            const double here = cell_value(n, i, j, k, 0);
            const size_t at = j * width + i;
            const uint32_t *const near = n->ids[(k + 1) % 2], *const far = n->ids[k % 2];
            if (j > 0 && k > 0 && (here < 0.0) != (cell_value(n, i, j, k, 1) < 0.0))
                quad(n->surface, (const uint32_t[4]){near[at - width], near[at], far[at], far[at - width]},
                     here >= 0.0);
            if (i > 0 && k > 0 && (here < 0.0) != (cell_value(n, i, j, k, 2) < 0.0))
                quad(n->surface, (const uint32_t[4]){near[at - 1], far[at - 1], far[at], near[at]},
                     here >= 0.0);
            if (i > 0 && j > 0 && (here < 0.0) != (cell_value(n, i, j, k, 4) < 0.0))
                quad(n->surface,
                     (const uint32_t[4]){far[at - width - 1], far[at - width], far[at], far[at - 1]},
                     here >= 0.0);
        }
}

static vec gradient(const net *n, vec p, double step) {
    const double x = n->function(n->context, (vec){p.x + step, p.y, p.z}) -
                     n->function(n->context, (vec){p.x - step, p.y, p.z});
    const double y = n->function(n->context, (vec){p.x, p.y + step, p.z}) -
                     n->function(n->context, (vec){p.x, p.y - step, p.z});
    const double z = n->function(n->context, (vec){p.x, p.y, p.z + step}) -
                     n->function(n->context, (vec){p.x, p.y, p.z - step});
    return scale((vec){x, y, z}, 0.5 / step);
}

static aur_result finish_vertices(void *context, size_t chunk) {
    const net *const n = context;
    const double cell = n->box->cell;
    const size_t end =
        (chunk + 1) * CHUNK < n->surface->vertex_count ? (chunk + 1) * CHUNK : n->surface->vertex_count;
    for (size_t i = chunk * CHUNK; i < end; ++i) {
        vec p = n->surface->positions[i];
        vec slope = gradient(n, p, 0.4 * cell);
        const double squared = dot(slope, slope);
        if (squared > 1e-12) {
            const double step = clamp(n->function(n->context, p) / squared, -0.5 * cell, 0.5 * cell);
            p = add_scaled(p, -step, slope);
        }
        slope = gradient(n, p, 0.4 * cell);
        n->surface->positions[i] = p;
        n->surface->normals[i] = normalize(slope);
    }
    return AUR_OK;
}

static bool allocate(net *n) {
    const size_t corners = (n->cells[0] + 1) * (n->cells[1] + 1), cells = n->cells[0] * n->cells[1];
    n->block_state = calloc(n->blocks[0] * n->blocks[1] * n->blocks[2], sizeof *n->block_state);
    bool good = n->block_state != NULL;
    for (size_t i = 0; i < 2; ++i) {
        n->values[i] = calloc(corners, sizeof *n->values[i]);
        n->ids[i] = calloc(cells, sizeof *n->ids[i]);
        good = good && n->values[i] != NULL && n->ids[i] != NULL;
    }
    return good;
}

void mesh_solid(mesh *m, const solid_box *box, solid function, const void *context) {
    static const aur_parallel_options all_threads = {0};
    mesh surface = {0};
    net n = {.box = box, .function = function, .context = context, .surface = &surface};
    const vec extent = subtract(box->upper, box->lower);
    const double sizes[3] = {extent.x, extent.y, extent.z};
    for (size_t a = 0; a < 3; ++a) {
        n.blocks[a] = (size_t)ceil(sizes[a] / (BLOCK * box->cell));
        n.cells[a] = BLOCK * n.blocks[a];
    }
    if (allocate(&n)) {
        aur_parallel_for(&all_threads, n.blocks[2], sample_blocks, &n, NULL);
        for (n.plane = 0; n.plane <= n.cells[2]; ++n.plane) {
            aur_parallel_for(&all_threads, n.cells[1] + 1, sample_row, &n, NULL);
            if (n.plane == 0)
                continue;
            const size_t layer = n.plane - 1;
            for (size_t j = 0; j < n.cells[1]; ++j)
                for (size_t i = 0; i < n.cells[0]; ++i)
                    cell_vertex(&n, i, j, layer);
            layer_quads(&n, layer);
        }
        aur_parallel_for(&all_threads, (surface.vertex_count + CHUNK - 1) / CHUNK, finish_vertices, &n, NULL);
    } else {
        surface.out_of_memory = true;
    }
    free(n.block_state);
    for (size_t i = 0; i < 2; ++i) {
        free(n.values[i]);
        free(n.ids[i]);
    }
    /* Joined to what is there already. */
    const uint32_t first = (uint32_t)m->vertex_count;
    for (size_t i = 0; i < surface.vertex_count && !surface.out_of_memory; ++i)
        mesh_vertex(m, surface.positions[i], surface.normals[i]);
    for (size_t i = 0; i < surface.triangle_count && !surface.out_of_memory; ++i)
        mesh_triangle(m, first + surface.triangles[i][0], first + surface.triangles[i][1],
                      first + surface.triangles[i][2]);
    m->out_of_memory = m->out_of_memory || surface.out_of_memory;
    mesh_release(&surface);
}

/* --- building blocks */

double solid_ellipsoid(vec p, vec center, vec radii) {
    const vec q = subtract(p, center);
    const vec once = {q.x / radii.x, q.y / radii.y, q.z / radii.z};
    const vec twice = {once.x / radii.x, once.y / radii.y, once.z / radii.z};
    const double k = length(once), slope = length(twice);
    return slope > 1e-12 ? k * (k - 1.0) / slope : -fmin(radii.x, fmin(radii.y, radii.z));
}

double solid_ball(vec p, vec center, double radius) {
    return length(subtract(p, center)) - radius;
}

double solid_limb(vec p, vec a, vec b, double ra, double rb) {
    const vec along = subtract(b, a), from = subtract(p, a);
    const double t = clamp(dot(from, along) / dot(along, along), 0.0, 1.0);
    return length(add_scaled(from, -t, along)) - (ra + t * (rb - ra));
}

double solid_block(vec p, vec center, vec half, double rounding) {
    const vec q = subtract(p, center);
    const vec d = {fabs(q.x) - half.x + rounding, fabs(q.y) - half.y + rounding,
                   fabs(q.z) - half.z + rounding};
    const vec out = {fmax(d.x, 0.0), fmax(d.y, 0.0), fmax(d.z, 0.0)};
    return length(out) + fmin(fmax(d.x, fmax(d.y, d.z)), 0.0) - rounding;
}

double solid_join(double a, double b, double k) {
    const double h = fmax(k - fabs(a - b), 0.0) / k;
    return fmin(a, b) - h * h * h * k / 6.0;
}

double solid_cut(double a, double b, double k) {
    return -solid_join(-a, b, k);
}
