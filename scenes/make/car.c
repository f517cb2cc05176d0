/* A toy car of the thirties, in four meshes: lacquer, chrome, glass and rubber. It stands on y = 0 and drives
 * along +x; 3.9 long, 1.6 wide. */
#include "product.h"
#include "surface_net.h"

static const vec front_wheel = {1.13, 0.34, 0.63}, rear_wheel = {-1.12, 0.34, 0.63};

static double slab_between(double x, double low, double high) {
    return fmax(low - x, x - high);
}

static double cabin(vec p, double shrink) {
    const vec q = turn_z(subtract(p, (vec){-0.42, 0.86, 0.0}), 0.06);
    const double shell = solid_ellipsoid(q, (vec){0}, (vec){1.12 - shrink, 0.52 - shrink, 0.54 - shrink});
    return shell;
}

/* Where the windows are; the sides mirrored. */
static double windows(vec p) {
    const double z = fabs(p.z);
    const double side = fmax(slab_between(p.y, 0.93, 1.22 - 0.10 * (p.x + 0.4) * (p.x + 0.4)),
                             fmin(slab_between(p.x, -0.40, 0.20), slab_between(p.x, -0.98, -0.49)));
    const double lights = fmax(side, 0.30 - z);
    const double screen = fmax(fmax(slab_between(p.y, 0.94, 1.27), 0.32 - p.x), fmax(z - 0.36, 0.012 - z));
    const double rear = fmax(fmax(slab_between(p.y, 1.0, 1.22), p.x + 1.06), fmax(z - 0.26, 0.010 - z));
    return fmin(lights, fmin(screen, rear));
}

static double arch(vec p, vec wheel, double radius) {
    const double x = p.x - wheel.x, y = p.y - wheel.y;
    return fmax(sqrt(x * x + y * y) - radius, 0.36 - fabs(p.z));
}

static double body(const void *context, vec p) {
    (void)context;
    const vec q = {p.x, p.y, sqrt(p.z * p.z + 1e-6)};
    double d = solid_ellipsoid(q, (vec){0.0, 0.56, 0.0}, (vec){1.75, 0.36, 0.56});
    d = solid_join(
        d,
        solid_ellipsoid(turn_z(subtract(q, (vec){0.98, 0.66, 0.0}), 0.05), (vec){0}, (vec){0.92, 0.30, 0.36}),
        0.12);
    double roof = cabin(q, 0.0);
    d = solid_join(d, roof, 0.16);
    d = solid_cut(d, fmax(cabin(q, 0.06), 0.80 - q.y), 0.02); /* room for those who ride in it */
    d = solid_cut(d, fmax(windows(p), cabin(q, -0.05)), 0.035);
    /* fenders, and the running board between them */
    d = solid_join(d,
                   solid_ellipsoid(turn_z(subtract(q, (vec){1.10, 0.46, 0.63}), 0.08), (vec){0},
                                   (vec){0.66, 0.40, 0.20}),
                   0.05);
    d = solid_join(d,
                   solid_ellipsoid(turn_z(subtract(q, (vec){-1.16, 0.46, 0.62}), -0.07), (vec){0},
                                   (vec){0.80, 0.43, 0.22}),
                   0.06);
    d = solid_join(d, solid_block(q, (vec){0.0, 0.27, 0.64}, (vec){0.75, 0.035, 0.15}, 0.03), 0.08);
    /* lines: doors, hood */
    const double door = fabs(fmax(slab_between(q.x, -0.45, 0.26), slab_between(q.y, 0.36, 0.90))) - 0.011;
    d = solid_cut(d, fmax(fmax(door, 0.38 - q.z), fabs(d) - 0.024), 0.02);
    for (size_t i = 0; i < 7; ++i) /* louvres of the hood */
        d = solid_cut(d,
                      solid_limb(q, (vec){0.62 + 0.075 * (double)i, 0.60, 0.40},
                                 (vec){0.66 + 0.075 * (double)i, 0.76, 0.37}, 0.011, 0.011),
                      0.014);
    d = solid_join(d, solid_limb(q, (vec){1.86, 0.66, 0.0}, (vec){-0.02, 1.0, 0.0}, 0.018, 0.018), 0.03);
    d = solid_cut(d, fmin(arch(q, front_wheel, 0.375), arch(q, rear_wheel, 0.375)), 0.05);
    return fmax(d, 0.20 - p.y);
}

static double glass(const void *context, vec p) {
    (void)context;
    const vec q = {p.x, p.y, sqrt(p.z * p.z + 1e-6)};
    const double shell = fmax(cabin(q, 0.022), -cabin(q, 0.040));
    return fmax(shell, windows(p) - 0.012);
}

static double wheel_axis(vec p, vec wheel, double *radius) {
    const double x = p.x - wheel.x, y = p.y - wheel.y;
    *radius = sqrt(x * x + y * y);
    return fabs(p.z) - wheel.z;
}

static double tyre(const void *context, vec p) {
    (void)context;
    double d = 1e9;
    for (size_t i = 0; i < 2; ++i) {
        double r;
        const double across = wheel_axis(p, i == 0 ? front_wheel : rear_wheel, &r);
        const double ring = sqrt((r - 0.235) * (r - 0.235) + 0.75 * across * across) - 0.105;
        const double angle = atan2(p.y - 0.34, p.x - (i == 0 ? front_wheel.x : rear_wheel.x));
        const double tread = 0.006 * smoothstep(0.30, 0.325, r) *
                             (cos(48.0 * angle + (across > 0.0 ? 1.5 : -1.5)) > 0.0 ? 1.0 : 0.0);
        d = fmin(d, ring + tread);
    }
    return d;
}

static double chrome(const void *context, vec p) {
    (void)context;
    const vec q = {p.x, p.y, fabs(p.z)};
    double d = 1e9;
    for (size_t i = 0; i < 2; ++i) { /* caps of the wheels, with a spinner and rings */
        double r;
        const double across = wheel_axis(p, i == 0 ? front_wheel : rear_wheel, &r);
        const double dish = solid_ellipsoid((vec){r, across - 0.02, 0.0}, (vec){0},
                                            (vec){0.165, 0.055 + 0.006 * cos(60.0 * r), 0.165});
        d = fmin(d,
                 solid_join(dish,
                            solid_ellipsoid((vec){r, across - 0.05, 0.0}, (vec){0}, (vec){0.05, 0.05, 0.05}),
                            0.02));
    }
    /* bumpers */
    const double bow = 0.10 * q.z * q.z;
    d = fmin(
        d, solid_block((vec){q.x + bow, q.y, q.z}, (vec){1.90, 0.33, 0.0}, (vec){0.022, 0.045, 0.70}, 0.02));
    d = fmin(
        d, solid_block((vec){q.x - bow, q.y, q.z}, (vec){-1.96, 0.33, 0.0}, (vec){0.022, 0.045, 0.66}, 0.02));
    d = fmin(d, solid_limb(q, (vec){1.93, 0.27, 0.22}, (vec){1.93, 0.43, 0.22}, 0.032, 0.026));
    d = fmin(d, solid_limb(q, (vec){-1.99, 0.27, 0.22}, (vec){-1.99, 0.43, 0.22}, 0.032, 0.026));
    /* the grille: bars on a shield */
    const double shield =
        solid_ellipsoid(turn_z(subtract(q, (vec){1.83, 0.62, 0.0}), 0.14), (vec){0}, (vec){0.10, 0.27, 0.20});
    const double bars = fabs(q.z - 0.044 * floor(q.z / 0.044 + 0.5)) - 0.012;
    d = fmin(d, fmin(fmax(shield, bars), fmax(fabs(shield) - 0.016, 1.86 - q.x)));
    /* lamps on the fenders */
    const vec headlight = {1.50, 0.74, 0.50};
    const double drop = solid_ellipsoid(q, headlight, (vec){0.20, 0.118, 0.118});
    d = fmin(d, solid_cut(fmax(drop, q.x - headlight.x - 0.10),
                          solid_ball(q, add(headlight, (vec){0.13, 0.0, 0.0}), 0.105), 0.01));
    d = fmin(d, solid_limb(q, (vec){1.46, 0.66, 0.50}, (vec){1.42, 0.55, 0.50}, 0.03, 0.04));
    /* handle, mascot, strip along the side */
    d = fmin(d, solid_limb(q, (vec){-0.36, 0.84, 0.565}, (vec){-0.24, 0.845, 0.56}, 0.014, 0.014));
    d = fmin(d, solid_limb(q, (vec){1.86, 0.89, 0.0}, (vec){1.68, 0.95, 0.0}, 0.016, 0.028));
    return d;
}

static double headlights(const void *context, vec p) {
    (void)context;
    const vec q = {p.x, p.y, fabs(p.z)};
    return fmax(solid_ellipsoid(q, (vec){1.555, 0.74, 0.50}, (vec){0.075, 0.088, 0.088}), 1.555 - q.x);
}

static void build(mesh *m, solid function, double cell) {
    const solid_box box = {
        .lower = {-2.10, -0.02, -0.90}, .upper = {2.05, 1.50, 0.90}, .cell = cell, .slack = 0.05};
    mesh_solid(m, &box, function, NULL);
}

static void build_body(mesh *m) {
    build(m, body, 0.0165);
}

static void build_chrome(mesh *m) {
    build(m, chrome, 0.0125);
}

static void build_glass(mesh *m) {
    build(m, glass, 0.0125);
}

static void build_tyres(mesh *m) {
    build(m, tyre, 0.0160);
}

static void build_headlights(mesh *m) {
    build(m, headlights, 0.008);
}

const product product_car_body = {
    .file = "car-body.ply", .summary = "a toy car: its lacquered parts", .build = build_body};
const product product_car_chrome = {.file = "car-chrome.ply", .summary = "its chrome", .build = build_chrome};
const product product_car_glass = {.file = "car-glass.ply", .summary = "its windows", .build = build_glass};
const product product_car_tyres = {.file = "car-tyres.ply", .summary = "its tyres", .build = build_tyres};
const product product_car_headlights = {
    .file = "car-lamps.ply", .summary = "its lamps", .build = build_headlights};
