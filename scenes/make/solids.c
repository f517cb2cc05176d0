#include "solids.h"

#include <stdbool.h>

#include "teapot_patches.h"

static size_t add_vertex(group *g, double x, double y, double z) {
    g->vertices[g->vertex_count] = (vec){x, y, z};
    return g->vertex_count++;
}

static void add_triangle(group *g, size_t a, size_t b, size_t c) {
    size_t *const corners = g->triangles[g->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

void add_quad(group *g, size_t a, size_t b, size_t c, size_t d) {
    add_triangle(g, a, b, c);
    add_triangle(g, a, c, d);
}

static void begin_solid(group *g) {
    g->first_vertex = g->vertex_count;
    g->first_triangle = g->triangle_count;
}

/* Turns the triangles so that the solid's volume is positive: normals point outwards. */
static void end_solid(group *g) {
    double volume = 0.0;
    const vec middle = g->vertices[g->first_vertex];
    for (size_t i = g->first_triangle; i < g->triangle_count; ++i) {
        vec p[3];
        for (size_t k = 0; k < 3; ++k)
            p[k] = add_scaled(g->vertices[g->triangles[i][k]], -1.0, middle);
        const vec n = cross(p[0], p[1]);
        volume += n.x * p[2].x + n.y * p[2].y + n.z * p[2].z;
    }
    for (size_t i = g->first_triangle; i < g->triangle_count && volume < 0.0; ++i) {
        const size_t swap = g->triangles[i][1];
        g->triangles[i][1] = g->triangles[i][2];
        g->triangles[i][2] = swap;
    }
}

void add_box_corners(group *g, span x, span y, span z, size_t corner[8]) {
    for (size_t i = 0; i < 8; ++i)
        corner[i] = add_vertex(g, i & 1 ? x.high : x.low, i & 2 ? y.high : y.low, i & 4 ? z.high : z.low);
}

void add_box(group *g, span x, span y, span z) {
    size_t c[8];
    begin_solid(g);
    add_box_corners(g, x, y, z, c);
    add_quad(g, c[0], c[2], c[3], c[1]);
    add_quad(g, c[4], c[5], c[7], c[6]);
    add_quad(g, c[0], c[1], c[5], c[4]);
    add_quad(g, c[2], c[6], c[7], c[3]);
    add_quad(g, c[0], c[4], c[6], c[2]);
    add_quad(g, c[1], c[3], c[7], c[5]);
    end_solid(g);
}

void add_to_profile(profile *p, double radius, double height) {
    p->radius[p->count] = radius;
    p->height[p->count++] = height;
}

void add_turned(group *g, const profile *p, size_t sides, vec base) {
    begin_solid(g);
    const size_t rings = p->count - 2;
    const size_t top = add_vertex(g, base.x, base.y, base.z + p->height[0]);
    const size_t first = g->vertex_count;
    for (size_t i = 1; i <= rings; ++i)
        for (size_t k = 0; k < sides; ++k) {
            const double angle = 2.0 * 3.14159265358979323846 * (double)k / (double)sides;
            add_vertex(g, base.x + p->radius[i] * cos(angle), base.y + p->radius[i] * sin(angle),
                       base.z + p->height[i]);
        }
    const size_t bottom = add_vertex(g, base.x, base.y, base.z + p->height[rings + 1]);
    for (size_t k = 0; k < sides; ++k) {
        const size_t next = (k + 1) % sides, last = first + (rings - 1) * sides;
        add_triangle(g, top, first + k, first + next);
        for (size_t i = 0; i + 1 < rings; ++i) {
            const size_t upper = first + i * sides, lower = upper + sides;
            add_quad(g, upper + k, lower + k, lower + next, upper + next);
        }
        add_triangle(g, last + k, bottom, last + next);
    }
    end_solid(g);
}

/* --- the teapot */

enum { QUADS = 5, POT_SIDES = 4 * QUADS };

/* Surfaces of revolution come in quarters, the first of each at 4 times its number; rim, upper body, lower
 * body, bottom, knob and lid, each from the inside out or from above. */
enum { RIM = 0, BODY_END = 4, KNOB = 4, LID = 5, HANDLE = 24, SPOUT = 28 };

/* Adds the points with u > 0 of a profile. */
static void add_curve(profile *p, const teapot_patch *quarter) {
    for (size_t i = 1; i <= QUADS; ++i) {
        vec position, normal;
        teapot_evaluate(quarter, (double)i / QUADS, 0.0, &position, &normal);
        add_to_profile(p, position.x, position.z);
    }
}

static profile pot_profile(const teapot_patch *patches) {
    profile p = {0};
    vec top, rim, normal;
    teapot_evaluate(&patches[4 * KNOB], 0.0, 0.0, &top, &normal);
    teapot_evaluate(&patches[4 * RIM], 0.0, 0.0, &rim, &normal);
    add_to_profile(&p, 0.0, top.z);
    add_curve(&p, &patches[4 * KNOB]);
    add_curve(&p, &patches[4 * LID]);
    /* The lid's edge and the rim's are one. */
    p.radius[p.count - 1] = 0.5 * (p.radius[p.count - 1] + rim.x);
    for (size_t i = RIM; i < BODY_END; ++i)
        add_curve(&p, &patches[4 * i]);
    return p;
}

/* The greatest radius of the pot at a height. */
static double pot_radius(const profile *p, double height) {
    double radius = 0.0;
    for (size_t i = 0; i + 1 < p->count; ++i) {
        const double a = p->height[i], b = p->height[i + 1];
        if ((height - a) * (height - b) > 0.0 || a == b)
            continue;
        const double here = p->radius[i] + (p->radius[i + 1] - p->radius[i]) * (height - a) / (b - a);
        radius = here > radius ? here : radius;
    }
    return radius;
}

/* The pot, and what handle and spout are cut from. */
typedef struct newell {
    teapot_patch patches[TEAPOT_PATCH_COUNT];
    profile pot;
} newell;

/* Point k of `around` of the cross-section at u in [0,2] of HANDLE or SPOUT: two patches along, each with its
 * mirror image. */
static vec tube_point(const newell *teapot, size_t tube, double u, size_t k, size_t around) {
    const size_t half = around / 2;
    vec position, normal;
    teapot_evaluate(&teapot->patches[tube + (u > 1.0 ? 2 : 0) + (k < half ? 0 : 1)], u > 1.0 ? u - 1.0 : u,
                    (double)(k % half) / (double)half, &position, &normal);
    return position;
}

static bool is_clear(const newell *teapot, size_t tube, double u, size_t around) {
    for (size_t k = 0; k < around; ++k) {
        const vec p = tube_point(teapot, tube, u, k, around);
        if (sqrt(p.x * p.x + p.y * p.y) < pot_radius(&teapot->pot, p.z) + 0.02)
            return false;
    }
    return true;
}

/* A tube from where it is clear of the pot to where it is no longer, with flat ends. */
static void add_tube(group *g, const newell *teapot, size_t tube, size_t around, size_t along, double scale,
                     vec base) {
    double begin = 0.0, end = 2.0;
    while (!is_clear(teapot, tube, begin, around))
        begin += 1.0 / 1024.0;
    while (!is_clear(teapot, tube, end, around))
        end -= 1.0 / 1024.0;
    begin_solid(g);
    const size_t first = g->vertex_count;
    for (size_t i = 0; i <= along; ++i)
        for (size_t k = 0; k < around; ++k) {
            const vec p =
                tube_point(teapot, tube, begin + (end - begin) * (double)i / (double)along, k, around);
            add_vertex(g, base.x + scale * p.x, base.y + scale * p.y, base.z + scale * p.z);
        }
    for (size_t i = 0; i < along; ++i)
        for (size_t k = 0; k < around; ++k) {
            const size_t here = first + i * around, next = here + around, next_around = (k + 1) % around;
            add_quad(g, here + k, next + k, next + next_around, here + next_around);
        }
    const size_t last = first + along * around;
    for (size_t k = 1; k + 1 < around; ++k) {
        add_triangle(g, first, first + k, first + k + 1);
        add_triangle(g, last, last + k + 1, last + k);
    }
    end_solid(g);
}

void add_teapot(group *g, double scale, vec base) {
    newell teapot;
    teapot_patches(teapot.patches);
    teapot.pot = pot_profile(teapot.patches);
    profile scaled = teapot.pot;
    for (size_t i = 0; i < scaled.count; ++i) {
        scaled.radius[i] *= scale;
        scaled.height[i] *= scale;
    }
    add_turned(g, &scaled, POT_SIDES, base);
    add_tube(g, &teapot, HANDLE, 8, 11, scale, base);
    add_tube(g, &teapot, SPOUT, 12, 8, scale, base);
}
