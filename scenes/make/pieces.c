/* Smaller things: the plates, and the field of seeds. */
#include "product.h"
#include "surface_net.h"

static double slab(const void *context, vec p) {
    (void)context;
    return solid_block(p, (vec){0}, (vec){2.4, 0.05, 0.62}, 0.045);
}

static void build_plate(mesh *m) {
    const solid_box box = {
        .lower = {-2.45, -0.08, -0.68}, .upper = {2.45, 0.08, 0.68}, .cell = 0.0145, .slack = 0.01};
    mesh_solid(m, &box, slab, NULL);
}

/* A seed: half a ball, drawn out a little at the top, on the ground at the origin. */
static vec seed_surface(const void *context, double u, double v) {
    (void)context;
    const double rise = 0.5 * PI * u, angle = 2.0 * PI * v;
    const double r = u >= 1.0 ? 0.0 : cos(rise) * (1.0 + 0.12 * sin(2.0 * rise));
    return (vec){r * cos(angle), 1.15 * sin(rise), r * sin(angle)};
}

/* The seeds of a sunflower (Vogel 1979): seed i at the golden angle times i and a distance of sqrt(i), larger
 * outside, as many as fit between two circles. */
static void build_seeds(mesh *m) {
    const double golden_angle = PI * (3.0 - sqrt(5.0));
    const grid size = {.rows = 14, .columns = 28, .wraps_v = true};
    for (size_t i = 70; i < 610; ++i) {
        const double distance = 0.128 * sqrt((double)i), angle = golden_angle * (double)i;
        const size_t first = m->vertex_count;
        mesh_grid(m, &size, seed_surface, NULL);
        mesh_place(m, first, 0.088 + 0.006 * distance, 0.0,
                   (vec){distance * cos(angle), 0.0, distance * sin(angle)});
    }
}

const product product_plate = {
    .file = "plate.ply", .summary = "a slab with round edges", .build = build_plate};
const product product_seeds = {
    .file = "seeds.ply", .summary = "540 seeds as a sunflower sets them", .build = build_seeds};
