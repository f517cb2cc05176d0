/* A seated hare, carved: in the place of the rabbit of Marques 2013's Cornell box. It looks along +x, its
 * paws at y = 0; z is mirrored. */
#include "noise.h"
#include "product.h"
#include "surface_net.h"

/* One ear: a long spoon, hollow towards the front and the side. */
static double ear(vec p) {
    const vec root = {0.255, 1.14, 0.065};
    vec q = subtract(p, root);
    q = turn_z(turn_x(q, -0.20), -0.30); /* upright, +y along the ear */
    const double along = clamp(q.y / 0.62, 0.0, 1.0);
    const double width = 0.035 + 0.085 * pow(sin(PI * pow(along, 0.75) * 0.98), 0.8);
    const double outer =
        solid_ellipsoid((vec){q.x / 0.55, q.y, q.z}, (vec){0.0, 0.33, 0.0}, (vec){0.13, 0.37, 0.105}) * 0.6;
    const vec into = {0.05, 0.36, 0.022};
    const double hollow = solid_ellipsoid((vec){q.x, q.y, q.z}, into, (vec){0.052, 0.28, 0.062});
    const double stem = solid_limb(q, (vec){0.0, -0.06, 0.0}, (vec){0.0, 0.16, 0.0}, 0.065, width * 0.6);
    return solid_cut(solid_join(outer, stem, 0.05), hollow, 0.03);
}

static double head(vec p) {
    double d = solid_ellipsoid(p, (vec){0.33, 1.04, 0.0}, (vec){0.205, 0.165, 0.145});
    d = solid_join(d, solid_ellipsoid(p, (vec){0.485, 0.975, 0.0}, (vec){0.125, 0.095, 0.088}), 0.10);
    d = solid_join(d, solid_ball(p, (vec){0.40, 0.965, 0.065}, 0.085), 0.08); /* cheek */
    d = solid_join(d, solid_ellipsoid(p, (vec){0.565, 0.955, 0.03}, (vec){0.05, 0.045, 0.035}),
                   0.03); /* lip */
    d = solid_join(d, solid_ellipsoid(p, (vec){0.50, 0.905, 0.0}, (vec){0.075, 0.04, 0.045}),
                   0.05); /* chin */
    d = solid_join(d, solid_ellipsoid(p, (vec){0.602, 0.992, 0.0}, (vec){0.022, 0.022, 0.032}),
                   0.02); /* nose */
    d = solid_cut(d, solid_limb(p, (vec){0.615, 0.985, 0.018}, (vec){0.64, 0.998, 0.042}, 0.008, 0.008),
                  0.012);
    d = solid_cut(d, solid_limb(p, (vec){0.64, 0.972, 0.0}, (vec){0.61, 0.925, 0.0}, 0.008, 0.007), 0.012);
    d = solid_cut(d, solid_limb(p, (vec){0.61, 0.925, 0.0}, (vec){0.545, 0.925, 0.07}, 0.007, 0.004), 0.014);
    /* the eye in its socket, between two lids */
    const vec eye = {0.415, 1.062, 0.108};
    d = solid_cut(d, solid_ellipsoid(p, add(eye, (vec){0.006, 0.0, 0.026}), (vec){0.055, 0.042, 0.028}),
                  0.03);
    d = solid_join(d, solid_ball(p, eye, 0.043), 0.004);
    const vec q = subtract(p, eye);
    const double lid = fabs(length((vec){q.x * 0.85, q.y, 0.0}) - 0.043) - 0.008;
    const double shell = fabs(length(q) - 0.048) - 0.009;
    return solid_join(d, fmax(lid, shell), 0.012);
}

static double body(vec p) {
    double d = solid_ellipsoid(turn_z(subtract(p, (vec){-0.22, 0.43, 0.0}), -0.25), (vec){0},
                               (vec){0.43, 0.37, 0.29}); /* back and rump */
    const double chest = solid_ellipsoid(turn_z(subtract(p, (vec){0.13, 0.58, 0.0}), 0.35), (vec){0},
                                         (vec){0.22, 0.34, 0.205});
    d = solid_join(d, chest, 0.16);
    d = solid_join(d, solid_limb(p, (vec){0.14, 0.76, 0.0}, (vec){0.27, 0.99, 0.0}, 0.165, 0.125), 0.12);
    const double thigh = solid_ellipsoid(turn_z(subtract(p, (vec){-0.17, 0.285, 0.205}), 0.35), (vec){0},
                                         (vec){0.275, 0.245, 0.125});
    d = solid_join(d, thigh, 0.05);
    d = solid_join(d, solid_limb(p, (vec){-0.30, 0.075, 0.245}, (vec){0.17, 0.058, 0.265}, 0.078, 0.06),
                   0.05);
    /* fore leg, paw and toes */
    d = solid_join(d, solid_limb(p, (vec){0.20, 0.52, 0.115}, (vec){0.295, 0.09, 0.095}, 0.095, 0.058), 0.07);
    d = solid_join(d, solid_ellipsoid(p, (vec){0.335, 0.048, 0.095}, (vec){0.095, 0.052, 0.062}), 0.04);
    for (double k = -1.0; k <= 1.0; k += 1.0) {
        const vec toe = {0.41, 0.036, 0.095 + 0.036 * k};
        d = solid_join(d, solid_limb(p, (vec){0.345, 0.05, 0.095 + 0.03 * k}, toe, 0.03, 0.026), 0.012);
        d = solid_join(d,
                       solid_limb(p, (vec){0.12, 0.06, 0.265 + 0.036 * k},
                                  (vec){0.235, 0.036, 0.27 + 0.042 * k}, 0.034, 0.027),
                       0.012);
    }
    return solid_join(d, solid_ellipsoid(p, (vec){-0.645, 0.27, 0.0}, (vec){0.105, 0.125, 0.105}), 0.05);
}

/* The hair: strands that run backwards and down, as a gouge would leave them. */
static double hair(vec p) {
    const vec q = turn_z(p, 0.6 + 0.5 * p.x);
    const vec bent =
        add_scaled(q, 0.05, (vec){noise(scale(p, 5.0)), noise(add(scale(p, 5.0), (vec){9.0, 0, 0})), 0.0});
    const double strands = noise((vec){bent.x * 9.0, bent.y * 34.0, bent.z * 34.0});
    const double fine = noise((vec){bent.x * 22.0, bent.y * 75.0, bent.z * 75.0});
    const double face = smoothstep(0.30, 0.48, p.x) * smoothstep(0.80, 0.9, p.y);
    const double ears = smoothstep(1.16, 1.26, p.y);
    return (1.0 - 0.7 * face) * (1.0 - 0.9 * ears) * (0.0075 * strands + 0.003 * fine);
}

static double hare_solid(const void *context, vec p) {
    (void)context;
    const vec whole = p;
    p.z = sqrt(p.z * p.z + 1e-6); /* no crease where the halves meet */
    double d = solid_join(body(p), head(p), 0.05);
    if (p.y > 0.9)
        d = solid_join(d, ear(p), 0.035);
    if (fabs(d) < 0.08)
        d += hair(whole);
    return fmax(d, -whole.y); /* flat where it sits */
}

static void build(mesh *m) {
    const solid_box box = {
        .lower = {-0.80, -0.02, -0.42}, .upper = {0.70, 1.90, 0.42}, .cell = 0.00807, .slack = 0.06};
    mesh_solid(m, &box, hare_solid, NULL);
}

const product product_hare = {.file = "hare.ply", .summary = "a carved hare", .build = build};
