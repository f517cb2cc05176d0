/* The place of the ambient occlusion scene: a half circle of fluted columns on three steps, a floor of tiles
 * with open joints, a beam with teeth, and pebbles. Large and fine things side by side. */
#include "noise.h"
#include "points/base/random.h"
#include "product.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

enum { COLUMNS = 9, FLUTES = 20 };

static const double ring_radius = 4.3;

static const double shaft[][2] = {
    {0.0, 0.0},    {0.44, 0.0},  {0.44, 0.0},  {0.44, 0.0},  {0.44, 0.10}, {0.44, 0.10}, {0.44, 0.10},
    {0.40, 0.11},  {0.43, 0.17}, {0.40, 0.23}, {0.36, 0.24}, {0.35, 0.27}, {0.37, 0.31}, {0.35, 0.34},
    {0.32, 0.35},  {0.32, 0.35}, {0.30, 0.42}, {0.298, 1.2}, {0.29, 2.0},  {0.265, 2.8}, {0.245, 3.25},
    {0.245, 3.25}, {0.27, 3.27}, {0.27, 3.30}, {0.25, 3.32}, {0.25, 3.36}, {0.30, 3.42}, {0.37, 3.50},
    {0.38, 3.52},  {0.38, 3.52}, {0.38, 3.52}, {0.0, 3.52}};

static vec fluted(const void *context, double u, double v) {
    double point[2];
    profile_at(context, u, point);
    const double angle = 2.0 * PI * v, turn = FLUTES * v - floor(FLUTES * v);
    const double on_shaft = smoothstep(0.42, 0.50, point[1]) * (1.0 - smoothstep(3.12, 3.2, point[1]));
    const double groove = fmax(0.0, sin(PI * clamp((turn - 0.1) / 0.8, 0.0, 1.0)));
    const double r = point[0] - 0.028 * on_shaft * sqrt(groove);
    return (vec){r * cos(angle), point[1], r * sin(angle)};
}

/* A block between two radii, two heights and two angles (about y, 0 behind), with square edges. */
typedef struct wedge {
    double inner, outer, low, high, from, to;
} wedge;

static vec wedge_point(const wedge *w, double r, double y, double t) {
    const double angle = w->from + t * (w->to - w->from);
    return (vec){r * sin(angle), y, -r * cos(angle)};
}

static void add_quad(mesh *m, vec a, vec b, vec c, vec d) {
    const vec normal = normalize(cross(subtract(c, a), subtract(d, b))); /* also where two corners are one */
    const uint32_t first = mesh_vertex(m, a, normal);
    mesh_vertex(m, b, normal);
    mesh_vertex(m, c, normal);
    mesh_vertex(m, d, normal);
    mesh_triangle(m, first, first + 1, first + 2);
    mesh_triangle(m, first, first + 2, first + 3);
}

static void add_wedge(mesh *m, const wedge *w, size_t parts) {
    for (size_t i = 0; i < parts; ++i) {
        const double a = (double)i / (double)parts, b = (double)(i + 1) / (double)parts;
        add_quad(m, wedge_point(w, w->inner, w->high, a), wedge_point(w, w->inner, w->high, b),
                 wedge_point(w, w->outer, w->high, b), wedge_point(w, w->outer, w->high, a));
        add_quad(m, wedge_point(w, w->outer, w->low, a), wedge_point(w, w->outer, w->low, b),
                 wedge_point(w, w->inner, w->low, b), wedge_point(w, w->inner, w->low, a));
        add_quad(m, wedge_point(w, w->outer, w->high, a), wedge_point(w, w->outer, w->high, b),
                 wedge_point(w, w->outer, w->low, b), wedge_point(w, w->outer, w->low, a));
        add_quad(m, wedge_point(w, w->inner, w->low, a), wedge_point(w, w->inner, w->low, b),
                 wedge_point(w, w->inner, w->high, b), wedge_point(w, w->inner, w->high, a));
    }
    add_quad(m, wedge_point(w, w->inner, w->low, 0.0), wedge_point(w, w->inner, w->high, 0.0),
             wedge_point(w, w->outer, w->high, 0.0), wedge_point(w, w->outer, w->low, 0.0));
    add_quad(m, wedge_point(w, w->outer, w->low, 1.0), wedge_point(w, w->outer, w->high, 1.0),
             wedge_point(w, w->inner, w->high, 1.0), wedge_point(w, w->inner, w->low, 1.0));
}

static double spread(size_t i, size_t count) {
    return 0.55 * PI * (2.0 * (double)i / (double)(count - 1) - 1.0);
}

static void add_colonnade(mesh *m) {
    const profile column = {COUNT(shaft), shaft};
    const grid size = {.rows = 130, .columns = 8 * FLUTES, .wraps_v = true};
    for (size_t i = 0; i < COLUMNS; ++i) {
        const double angle = spread(i, COLUMNS);
        const size_t first = m->vertex_count;
        mesh_grid(m, &size, fluted, &column);
        mesh_place(m, first, 1.0, 0.0, (vec){ring_radius * sin(angle), 0.0, -ring_radius * cos(angle)});
        const double half = 0.40 / ring_radius;
        const wedge abacus = {ring_radius - 0.40, ring_radius + 0.40, 3.52, 3.62, angle - half, angle + half};
        add_wedge(m, &abacus, 4);
    }
    const double end = 0.55 * PI + 0.42 / ring_radius;
    const wedge beams[] = {{ring_radius - 0.30, ring_radius + 0.30, 3.62, 3.86, -end, end},
                           {ring_radius - 0.33, ring_radius + 0.33, 3.86, 4.06, -end, end},
                           {ring_radius - 0.50, ring_radius + 0.50, 4.17, 4.29, -end, end},
                           {ring_radius - 0.56, ring_radius + 0.56, 4.29, 4.36, -end, end}};
    for (size_t i = 0; i < COUNT(beams); ++i)
        add_wedge(m, &beams[i], 160);
    for (size_t i = 0; i < 130; ++i) { /* the teeth between */
        const double angle = end * (2.0 * ((double)i + 0.5) / 130.0 - 1.0), half = 0.27 * end / 130.0 * 2.0;
        const wedge tooth = {ring_radius - 0.45, ring_radius + 0.45, 4.06, 4.17, angle - half, angle + half};
        add_wedge(m, &tooth, 1);
    }
    const wedge steps[] = {{3.55, 5.05, -0.18, 0.0, -end - 0.10, end + 0.10},
                           {3.25, 5.35, -0.36, -0.18, -end - 0.16, end + 0.16},
                           {2.95, 5.65, -0.54, -0.36, -end - 0.22, end + 0.22}};
    for (size_t i = 0; i < COUNT(steps); ++i)
        add_wedge(m, &steps[i], 160);
}

/* Rings of tiles about the middle, and what they lie on. */
static void add_floor(mesh *m) {
    for (size_t ring = 0; ring < 26; ++ring) {
        const double inner = 1.15 + 0.36 * (double)ring, outer = inner + 0.345;
        const size_t count = (size_t)(2.0 * PI * inner / 0.46);
        for (size_t i = 0; i < count; ++i) {
            const double turn = 2.0 * PI / (double)count, shift = 0.618 * (double)ring;
            const double from = turn * ((double)i + shift), gap = 0.0075 / inner;
            const double rise = 0.006 * (aur_unit_double(aur_hash3(5, ring, i)) - 0.5);
            const wedge tile = {inner, outer, -0.60, -0.54 + rise, from + gap, from + turn - gap};
            add_wedge(m, &tile, 3);
        }
    }
    for (size_t i = 0; i < 3; ++i) { /* the round base in the middle */
        const wedge base = {
            0.0, 1.12 - 0.10 * (double)i, -0.60 + 0.10 * (double)i, -0.46 + 0.10 * (double)i, 0.0, 2.0 * PI};
        add_wedge(m, &base, 128);
    }
}

static vec pebble_surface(const void *context, double u, double v) {
    const double seed = *(const double *)context;
    const double theta = PI * (1.0 - u), angle = 2.0 * PI * v;
    const double r = u >= 1.0 || u <= 0.0 ? 0.0 : sin(theta);
    const vec n = {r * cos(angle), cos(theta), r * sin(angle)};
    const double size = 1.0 + 0.22 * noise(add(scale(n, 1.3), (vec){seed, 0.0, 0.0})) +
                        0.03 * noise(add(scale(n, 6.0), (vec){seed, 0.0, 0.0}));
    return (vec){1.15 * size * n.x, 0.70 * size * n.y, 0.95 * size * n.z};
}

static void add_pebbles(mesh *m) {
    const grid size = {.rows = 18, .columns = 26, .wraps_v = true};
    for (size_t i = 0; i < 260; ++i) {
        const double angle = 2.0 * PI * aur_unit_double(aur_hash3(1, i, 0)),
                     away = aur_unit_double(aur_hash3(1, i, 1));
        const double r = 1.35 + 1.55 * sqrt(away), big = aur_unit_double(aur_hash3(1, i, 2));
        const double radius = 0.022 + 0.075 * pow(big, 4.0), seed = 3.7 * (double)i;
        const size_t first = m->vertex_count;
        mesh_grid(m, &size, pebble_surface, &seed);
        mesh_place(m, first, radius, seed, (vec){r * sin(angle), -0.535 + 0.58 * radius, -r * cos(angle)});
    }
}

static void build(mesh *m) {
    add_colonnade(m);
    add_floor(m);
    add_pebbles(m);
}

const product product_temple = {.file = "temple.ply", .summary = "a half circle of columns", .build = build};
