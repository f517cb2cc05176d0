/* A seated figure in meditation on a lotus: the scanned figure of Marques 2018 and 2019. It looks along +z,
 * the lowest point of its base is at y = 0. The curls of its hair lie on a spherical Fibonacci set. */
#include <aureole/sphere.h>
#include <stdlib.h>

#include "noise.h"
#include "product.h"
#include "surface_net.h"

enum { PETALS = 18, CURLS = 420 };

/* --- the throne */

/* A row of petals about the axis, each a pointed shell that leans outwards. */
static double petal_row(vec p, double radius, double foot, double height, double lean, double phase) {
    const double sector = 2.0 * PI / PETALS;
    double angle = atan2(p.x, p.z) + phase * sector;
    angle -= sector * floor(angle / sector + 0.5);
    const double r = sqrt(p.x * p.x + p.z * p.z);
    const double side = fabs(r * sin(angle)), out = r * cos(angle) - radius, up = (p.y - foot) / height;
    /* Widest at a third of its height, round, with a small point. */
    const double t = clamp(up, 0.0, 1.0);
    const double width =
        0.5 * radius * sector * pow(fmax(0.0, 1.0 - pow(t, 3.2)), 0.6) * (0.86 + 0.5 * t * (1.0 - t));
    const double curve = lean * t * t - 0.03 * sin(PI * t);
    const double across = clamp(side / (width + 1e-3), 0.0, 1.0);
    const double bulge = 0.045 * (1.0 - across * across) * (1.0 - 0.6 * t);
    const double rim = 0.007 * smoothstep(0.66, 0.80, across) * (t > 0.02 ? 1.0 : 0.0);
    const double shell = fabs(out - curve - bulge) - 0.016 - rim;
    const double outline = fmax(side - width, fmax(up - 1.0, -up) * height);
    return 0.7 * solid_cut(shell, -outline, 0.02);
}

static double throne(vec p) {
    const double r = sqrt(p.x * p.x + p.z * p.z);
    /* mouldings, each a rounded disk: radius, middle, half height, rounding */
    static const double disks[][4] = {{0.78, 0.035, 0.035, 0.012},
                                      {0.73, 0.095, 0.030, 0.028},
                                      {0.585, 0.28, 0.16, 0.05},
                                      {0.655, 0.425, 0.022, 0.02}};
    double d = 1e9;
    for (size_t i = 0; i < sizeof disks / sizeof disks[0]; ++i) {
        const double *const k = disks[i];
        d = solid_join(
            d, solid_block((vec){r, p.y, 0.0}, (vec){0.0, k[1], 0.0}, (vec){k[0], k[2], k[0]}, k[3]), 0.012);
    }
    d = fmin(d, petal_row(p, 0.585, 0.215, 0.215, 0.075, 0.0));
    d = fmin(d, petal_row(p, 0.575, 0.215, 0.185, 0.115, 0.5));
    d = fmin(d, petal_row((vec){p.x, 0.43 - p.y, p.z}, 0.585, 0.215, 0.125, 0.13, 0.0));
    /* beads along the edge */
    const double sector = 2.0 * PI / 72.0;
    double angle = atan2(p.x, p.z);
    angle -= sector * floor(angle / sector + 0.5);
    return fmin(d, solid_ball((vec){r * cos(angle), p.y, r * sin(angle)}, (vec){0.735, 0.135, 0.0}, 0.021));
}

/* --- the head */

static const vec skull = {0.0, 1.545, 0.0};

static double hair(vec p, double cap) {
    const vec from = subtract(p, skull);
    const double bump = solid_ball(p, (vec){0.0, 1.725, -0.035}, 0.088);
    cap = solid_join(cap, bump, 0.05);
    if (cap > 0.06 || cap < -0.06)
        return cap;
    /* The nearest point of the set, about the head or about the bump on it. */
    const bool upper = bump < 0.03 && p.y > 1.74;
    const vec about = upper ? subtract(p, (vec){0.0, 1.725, -0.035}) : from;
    const vec axis = normalize(about);
    const double direction[3] = {axis.x, axis.z, axis.y};
    const aur_fibonacci_set curls = {CURLS, AUR_DOMAIN_SPHERE};
    uint64_t index = 0;
    aur_fibonacci_nearest(&curls, 1, direction, 1, &index, NULL);
    const double height = 1.0 - (2.0 * (double)index + 1.0) / CURLS, radius = sqrt(1.0 - height * height);
    const double phi = 2.0 * PI * (double)index * 0.61803398874989484820;
    const vec curl = {radius * cos(phi), height, radius * sin(phi)};
    const double apart = acos(clamp(dot(axis, curl), -1.0, 1.0)) / sqrt(4.0 / CURLS);
    const double dome = fmax(0.0, 1.0 - 0.95 * apart * apart);
    /* each curl winds once and a half to its middle */
    const vec x = normalize(cross((vec){0.31, 0.9, 0.17}, curl)), y = cross(curl, x);
    const double winding = atan2(dot(axis, y), dot(axis, x)) + 9.0 * apart;
    return 0.8 * (cap - (upper ? 0.012 : 0.017) * sqrt(dome) -
                  0.0035 * dome * cos(winding) * smoothstep(0.1, 0.4, apart));
}

static double face(vec p) {
    const double x = sqrt(p.x * p.x + 4e-6);
    const vec q = {x, p.y, p.z};
    double d = solid_ellipsoid(p, (vec){0.0, 1.535, 0.005}, (vec){0.143, 0.185, 0.158});
    d = solid_join(d, solid_ellipsoid(q, (vec){0.055, 1.455, 0.06}, (vec){0.085, 0.095, 0.095}),
                   0.06); /* cheeks */
    d = solid_join(d, solid_ellipsoid(p, (vec){0.0, 1.39, 0.085}, (vec){0.058, 0.045, 0.058}),
                   0.05); /* chin */
    /* sockets under arched brows that run into the nose */
    d = solid_cut(d, solid_ellipsoid(q, (vec){0.062, 1.530, 0.178}, (vec){0.052, 0.030, 0.030}), 0.03);
    const vec brow[4] = {
        {0.014, 1.535, 0.172}, {0.040, 1.567, 0.166}, {0.078, 1.570, 0.146}, {0.115, 1.545, 0.108}};
    for (size_t i = 0; i + 1 < 4; ++i)
        d = solid_join(d, solid_limb(q, brow[i], brow[i + 1], 0.0085, 0.0075), 0.018);
    /* lids, almost closed */
    const double eye = solid_ellipsoid(turn_z(subtract(q, (vec){0.060, 1.517, 0.143}), -0.10), (vec){0},
                                       (vec){0.042, 0.022, 0.022});
    d = solid_join(d, eye, 0.008);
    const vec lash[3] = {{0.026, 1.508, 0.166}, {0.060, 1.502, 0.168}, {0.098, 1.513, 0.148}};
    d = solid_cut(
        d, fmin(solid_limb(q, lash[0], lash[1], 0.003, 0.004), solid_limb(q, lash[1], lash[2], 0.004, 0.003)),
        0.007);
    /* nose */
    d = solid_join(d, solid_limb(p, (vec){0.0, 1.540, 0.166}, (vec){0.0, 1.462, 0.200}, 0.013, 0.021), 0.020);
    d = solid_join(d, solid_ball(q, (vec){0.020, 1.457, 0.183}, 0.0145), 0.014);
    d = solid_cut(d, solid_ball(q, (vec){0.011, 1.443, 0.193}, 0.006), 0.008);
    /* mouth */
    d = solid_join(d, solid_ellipsoid(p, (vec){0.0, 1.415, 0.150}, (vec){0.058, 0.034, 0.022}), 0.03);
    const vec upper[3] = {{0.0, 1.4215, 0.1745}, {0.018, 1.4255, 0.1725}, {0.052, 1.4200, 0.159}};
    d = solid_join(d,
                   fmin(solid_limb(q, upper[0], upper[1], 0.0082, 0.0085),
                        solid_limb(q, upper[1], upper[2], 0.0085, 0.004)),
                   0.006);
    d = solid_join(d, solid_limb(q, (vec){0.0, 1.4035, 0.171}, (vec){0.040, 1.4110, 0.161}, 0.0105, 0.005),
                   0.006);
    d = solid_cut(d, solid_limb(q, (vec){0.0, 1.4130, 0.186}, (vec){0.057, 1.4195, 0.163}, 0.003, 0.003),
                  0.006);
    d = solid_cut(d, solid_ball(p, (vec){0.0, 1.388, 0.166}, 0.010), 0.02);
    d = solid_join(d, solid_ball(p, (vec){0.0, 1.588, 0.154}, 0.0105), 0.004); /* urna */
    /* long ears */
    const vec ear[5] = {{0.146, 1.555, -0.012},
                        {0.163, 1.530, -0.035},
                        {0.160, 1.470, -0.025},
                        {0.150, 1.395, -0.008},
                        {0.147, 1.372, 0.002}};
    double lobe = 1e9;
    for (size_t i = 0; i + 1 < 5; ++i)
        lobe =
            solid_join(lobe, solid_limb((vec){q.x, q.y, 0.75 * q.z}, ear[i], ear[i + 1], 0.017, 0.016), 0.02);
    lobe = solid_cut(lobe, solid_limb(q, (vec){0.178, 1.535, -0.028}, (vec){0.172, 1.40, 0.0}, 0.010, 0.007),
                     0.012);
    return solid_join(d, lobe, 0.015);
}

static double head(vec p) {
    double d = face(p);
    const double neck = solid_limb(p, (vec){0.0, 1.22, -0.025}, (vec){0.0, 1.42, 0.0}, 0.098, 0.088) -
                        0.004 * cos((p.y - 1.26) * 2.0 * PI / 0.045) * smoothstep(1.24, 1.27, p.y) *
                            (1.0 - smoothstep(1.36, 1.38, p.y));
    d = solid_join(d, neck, 0.03);
    /* Hair above a line that dips at the temples. */
    const double cap = solid_ellipsoid(p, (vec){0.0, 1.552, -0.012}, (vec){0.150, 0.185, 0.162});
    const double line = 1.607 - 0.9 * p.x * p.x - 0.75 * fmax(0.0, 0.13 - p.z) + 0.2 * fmax(0.0, -p.z);
    return solid_join(d, solid_cut(hair(p, cap), p.y - line, 0.012), 0.006);
}

/* --- the body */

/* The robe leaves the right shoulder (x < 0) bare. Positive where it lies. */
static double robe_side(vec p) {
    const double edge = 0.42 * p.x + 0.62 * (1.06 - p.y) + 0.05 * sin(6.0 * p.x + 2.0);
    return p.y < 0.78 ? 1.0 : fmax(edge + 0.03, p.x - 0.02 - 0.12 * (1.3 - p.y));
}

static double arm(vec q, double hand) {
    double d = solid_limb(q, (vec){0.335, 1.13, -0.035}, (vec){0.435, 0.82, -0.02}, 0.098, 0.080);
    d = solid_join(d, solid_limb(q, (vec){0.435, 0.82, -0.02}, (vec){0.185, 0.635, 0.30}, 0.080, 0.050),
                   0.05);
    return solid_join(
        d, solid_limb(q, (vec){0.19, 0.632, 0.30}, (vec){0.06, 0.612 + hand, 0.345}, 0.047, 0.038), 0.03);
}

static double hands(vec p) {
    double d = 1e9;
    for (size_t i = 0; i < 4; ++i) {
        const double k = (double)i;
        /* fingers of the upper and of the lower hand, and the thumbs that meet */
        d = solid_join(d,
                       solid_limb(p, (vec){0.06, 0.628, 0.315 + 0.030 * k},
                                  (vec){-0.105 + 0.01 * k, 0.632, 0.325 + 0.029 * k}, 0.019, 0.014),
                       0.012);
        d = solid_join(d,
                       solid_limb(p, (vec){-0.06, 0.598, 0.32 + 0.032 * k},
                                  (vec){0.125 - 0.01 * k, 0.590, 0.335 + 0.031 * k}, 0.020, 0.015),
                       0.012);
    }
    const vec q = {fabs(p.x), p.y, p.z};
    return solid_join(d, solid_limb(q, (vec){0.10, 0.645, 0.345}, (vec){0.008, 0.692, 0.375}, 0.021, 0.014),
                      0.02);
}

static double legs(vec p) {
    const vec q = {fabs(p.x), p.y, p.z};
    double d = solid_limb(q, (vec){0.13, 0.55, -0.05}, (vec){0.50, 0.535, 0.24}, 0.155, 0.105);
    d = solid_join(d, solid_limb(q, (vec){0.50, 0.535, 0.24}, (vec){0.02, 0.520, 0.41}, 0.105, 0.078), 0.07);
    d = solid_join(d, solid_ellipsoid(p, (vec){0.0, 0.50, 0.05}, (vec){0.46, 0.10, 0.36}), 0.08);
    /* the folds of the cloth between the shins, spread on the throne */
    const double fan = atan2(p.x, p.z - 0.05), reach = sqrt(p.x * p.x + (p.z - 0.05) * (p.z - 0.05));
    const double cloth = solid_ellipsoid(p, (vec){0.0, 0.458, 0.28}, (vec){0.26, 0.045, 0.30}) -
                         0.010 * cos(26.0 * fan) * smoothstep(0.2, 0.5, reach);
    return solid_join(d, cloth, 0.03);
}

static double folds(vec p) {
    /* Over the legs they run around the knees; over the body they fall from the left shoulder. */
    const vec knee = {p.x < 0.0 ? -0.50 : 0.50, 0.535, 0.24};
    const double round = length(subtract(p, knee));
    const double low = cos(52.0 * (round + 0.02 * noise(scale(p, 7.0)))) * smoothstep(0.10, 0.2, round);
    const vec shoulder = {0.30, 1.24, -0.03};
    const vec from = subtract(p, shoulder);
    const double fan = atan2(from.x + 0.12, -from.y + 0.02), fall = length(from);
    const double high =
        smoothstep(0.10, 0.28, fall) * cos(24.0 * fan + 5.0 * fall + 0.8 * noise(scale(p, 5.0)));
    const double upper = smoothstep(0.66, 0.74, p.y);
    const double ridge = upper * high + (1.0 - upper) * low;
    const double crisp = ridge > 0.0 ? sqrt(ridge) : -0.4 * ridge * ridge;
    return 0.0085 * crisp;
}

static double body(vec p) {
    const vec q = {fabs(p.x), p.y, p.z};
    double d = solid_ellipsoid(p, (vec){0.0, 0.76, -0.03}, (vec){0.232, 0.30, 0.168});
    d = solid_join(d, solid_ellipsoid(p, (vec){0.0, 1.04, -0.035}, (vec){0.285, 0.235, 0.165}), 0.10);
    d = solid_join(d, solid_limb(q, (vec){0.05, 1.205, -0.04}, (vec){0.315, 1.14, -0.035}, 0.085, 0.10),
                   0.06);
    d = solid_join(d, solid_ellipsoid(q, (vec){0.115, 1.075, 0.075}, (vec){0.105, 0.075, 0.055}),
                   0.06); /* breast */
    const double bare_arm = arm(q, p.x > 0.0 ? 0.0 : 0.015);
    const double navel = solid_ball(p, (vec){0.0, 0.80, 0.150}, 0.012);
    d = solid_cut(solid_join(d, bare_arm, 0.025), navel, 0.02);
    const double lower = legs(p);
    d = solid_join(d, lower, 0.05);
    if (fabs(d) < 0.1) {
        const double side = robe_side(p);
        const bool wrist = p.z > 0.22 && p.y > 0.57 && fabs(p.x) < 0.22;
        const double bare = wrist || (p.x < -0.05 && p.y > 0.80 && lower > 0.05 && side < 0.0) ? 0.0 : 1.0;
        const double on = bare * smoothstep(-0.004, 0.004, side);
        const double hem = exp(-side * side / 0.0002) * (p.y > 0.80 ? 0.007 : 0.0) * bare;
        d -= on * (0.009 + folds(p)) + hem;
    }
    return solid_join(d, hands(p), 0.012);
}

static double statue_solid(const void *context, vec p) {
    (void)context;
    double d = 1e9;
    if (p.y < 0.62)
        d = throne(p);
    if (p.y > 0.36)
        d = fmin(d, body(p));
    if (p.y > 1.12)
        d = solid_join(d, head(p), 0.02);
    if (fabs(d) < 0.03) /* the hand of time */
        d += 0.0012 * fractal_noise(scale(p, 28.0), 3) - 0.004 * smoothstep(0.45, 0.8, noise(scale(p, 9.0)));
    return fmax(d, -p.y);
}

static void build(mesh *m) {
    const solid_box box = {
        .lower = {-0.84, -0.02, -0.84}, .upper = {0.84, 1.90, 0.84}, .cell = 0.00546, .slack = 0.08};
    mesh_solid(m, &box, statue_solid, NULL);
}

const product product_statue = {
    .file = "statue.ply", .summary = "a seated figure on a lotus throne", .build = build};
