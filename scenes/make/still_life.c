/* What stands on the table of the room: teapot, cups, a bowl of fruit and a cloth. The table is y = 0; each
 * mesh stands where the scene has it, so that one unit is about the length of the teapot. */
#include "noise.h"
#include "product.h"
#include "teapot_patches.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* --- the teapot */

static void add_teapot(mesh *m, size_t quads) {
    teapot_patch patches[TEAPOT_PATCH_COUNT];
    teapot_patches(patches);
    for (size_t k = 0; k < TEAPOT_PATCH_COUNT; ++k) {
        const uint32_t first = (uint32_t)m->vertex_count, row = (uint32_t)quads + 1;
        for (size_t i = 0; i <= quads; ++i)
            for (size_t j = 0; j <= quads; ++j) {
                vec p, n;
                teapot_evaluate(&patches[k], (double)i / (double)quads, (double)j / (double)quads, &p, &n);
                if (dot(n, n) == 0.0) /* on the axis */
                    n = (vec){0.0, 0.0, p.z > 1.0 ? 1.0 : -1.0};
                mesh_vertex(m, (vec){p.x, p.z, -p.y}, (vec){n.x, n.z, -n.y});
            }
        for (uint32_t i = 0; i < quads; ++i)
            for (uint32_t j = 0; j < quads; ++j) {
                const uint32_t a = first + i * row + j, b = a + row;
                mesh_triangle(m, a, b, b + 1);
                mesh_triangle(m, a, b + 1, a + 1);
            }
    }
}

static void build_teapot(mesh *m) {
    add_teapot(m, 40);
    mesh_place(m, 0, 0.158, 2.75, (vec){0.60, 0.0, -0.18});
}

/* --- cups */

static const double cup_profile[][2] = {
    {0.0, 0.022},   {0.10, 0.022}, {0.105, 0.0},  {0.105, 0.0},  {0.118, 0.0},  {0.118, 0.022},
    {0.125, 0.03},  {0.185, 0.08}, {0.205, 0.17}, {0.215, 0.25}, {0.222, 0.27}, {0.216, 0.275},
    {0.208, 0.262}, {0.198, 0.18}, {0.178, 0.09}, {0.12, 0.045}, {0.05, 0.04},  {0.0, 0.04}};
static const double saucer_profile[][2] = {{0.0, 0.012},   {0.12, 0.012},  {0.125, 0.0},  {0.125, 0.0},
                                           {0.145, 0.0},   {0.145, 0.012}, {0.24, 0.035}, {0.33, 0.06},
                                           {0.345, 0.068}, {0.34, 0.075},  {0.31, 0.066}, {0.22, 0.043},
                                           {0.15, 0.024},  {0.13, 0.020},  {0.0, 0.020}};

static vec cup_handle(const void *context, double u) {
    (void)context;
    const double angle = PI * (0.62 - 1.24 * u);
    return (vec){0.195 + 0.095 * cos(angle) + 0.03 * u, 0.165 + 0.080 * sin(angle) - 0.01 * u, 0.0};
}

static double handle_radius(const void *context, double u) {
    (void)context;
    return 0.0175 + 0.007 * (2.0 * u - 1.0) * (2.0 * u - 1.0);
}

static void add_cup(mesh *m, double angle, vec position) {
    const size_t first = m->vertex_count;
    const profile cup = {COUNT(cup_profile), cup_profile}, saucer = {COUNT(saucer_profile), saucer_profile};
    const tube handle = {.curve = cup_handle, .radius = handle_radius, .rows = 56, .columns = 24};
    mesh_revolve(m, &cup, 104, 120);
    mesh_tube(m, &handle);
    mesh_place(m, first, 0.92, angle, (vec){0.0, 0.021, 0.0});
    const size_t below = m->vertex_count;
    mesh_revolve(m, &saucer, 72, 128);
    mesh_place(m, below, 0.95, 0.0, (vec){0});
    mesh_place(m, first, 1.0, 0.0, position);
}

static void build_cups(mesh *m) {
    add_cup(m, 0.5, (vec){0.28, 0.0, 0.44});
    add_cup(m, -0.7, (vec){1.20, 0.0, 0.26});
}

static const double tea_profile[][2] = {{0.0, 0.0},      {0.155, 0.0},   {0.175, 0.0},
                                        {0.1755, 0.003}, {0.172, 0.001}, {0.0, 0.001}};

static void build_tea(mesh *m) {
    const profile tea = {COUNT(tea_profile), tea_profile};
    static const vec positions[2] = {{0.28, 0.205, 0.44}, {1.20, 0.205, 0.26}};
    for (size_t i = 0; i < 2; ++i) {
        const size_t first = m->vertex_count;
        mesh_revolve(m, &tea, 24, 96);
        mesh_place(m, first, 1.0, 0.0, positions[i]);
    }
}

/* --- the bowl and its fruit */

static const vec bowl_place = {-0.62, 0.0, -0.12};

static const double bowl_profile[][2] = {
    {0.0, 0.05},   {0.16, 0.05},  {0.18, 0.0},   {0.18, 0.0},   {0.21, 0.0},   {0.205, 0.03},
    {0.19, 0.055}, {0.22, 0.085}, {0.36, 0.13},  {0.48, 0.22},  {0.545, 0.30}, {0.56, 0.315},
    {0.55, 0.322}, {0.53, 0.31},  {0.46, 0.235}, {0.34, 0.155}, {0.2, 0.115},  {0.0, 0.105}};

/* Fluted: its radius waves along the rim, more the higher it is. */
static vec bowl_surface(const void *context, double u, double v) {
    double point[2];
    profile_at(context, u, point);
    const double angle = 2.0 * PI * v, rise = smoothstep(0.08, 0.3, point[1]);
    const double r = point[0] * (1.0 + 0.022 * rise * cos(18.0 * angle));
    return (vec){r * cos(angle), point[1] + 0.008 * rise * cos(18.0 * angle), r * sin(angle)};
}

static void build_bowl(mesh *m) {
    const profile bowl = {COUNT(bowl_profile), bowl_profile};
    const grid size = {.rows = 96, .columns = 288, .wraps_v = true};
    mesh_grid(m, &size, bowl_surface, &bowl);
    mesh_place(m, 0, 1.0, 0.0, bowl_place);
}

typedef struct fruit {
    vec position;
    double size, lean, angle; /* leans about z, then turns about y */
    double seed;
} fruit;

/* Moves and leans what was added since `first`. */
static void place_fruit(mesh *m, size_t first, const fruit *f) {
    for (size_t i = first; i < m->vertex_count; ++i) {
        m->positions[i] = turn_z(m->positions[i], f->lean);
        m->normals[i] = turn_z(m->normals[i], f->lean);
    }
    mesh_place(m, first, f->size, f->angle, f->position);
}

static vec apple_surface(const void *context, double u, double v) {
    const fruit *const f = context;
    const double theta = PI * (1.0 - u), angle = 2.0 * PI * v;
    const double lobes = 1.0 + 0.022 * cos(5.0 * angle + f->seed) * (1.0 - 0.5 * cos(theta));
    const double top = exp(-theta * theta / 0.10), bottom = exp(-(PI - theta) * (PI - theta) / 0.05);
    const double taper = 1.0 + 0.10 * cos(theta) - 0.04 * cos(2.0 * theta);
    const vec p = {lobes * taper * sin(theta) * cos(angle), 0.90 * cos(theta) - 0.38 * top + 0.13 * bottom,
                   lobes * taper * sin(theta) * sin(angle)};
    return add_scaled(p, 0.014 * noise(add(scale(p, 1.7), (vec){f->seed, 0.0, 0.0})), p);
}

static vec pear_surface(const void *context, double u, double v) {
    static const double shape[][2] = {{0.0, -0.92}, {0.10, -0.97}, {0.55, -1.0}, {0.98, -0.62},
                                      {0.98, -0.1}, {0.68, 0.35},  {0.44, 0.75}, {0.38, 1.08},
                                      {0.26, 1.30}, {0.08, 1.33},  {0.0, 1.26}};
    const profile outline = {COUNT(shape), shape};
    const fruit *const f = context;
    double point[2];
    profile_at(&outline, u, point);
    const double angle = 2.0 * PI * v, bend = 0.07 * (point[1] + 1.0) * (point[1] + 1.0);
    const vec p = {point[0] * cos(angle) + bend, point[1], point[0] * sin(angle)};
    return point[0] == 0.0 ? p
                           : add_scaled(p, 0.02 * noise(add(scale(p, 1.9), (vec){f->seed, 0.0, 0.0})),
                                        (vec){cos(angle), 0.0, sin(angle)});
}

static vec orange_surface(const void *context, double u, double v) {
    const fruit *const f = context;
    const double theta = PI * (1.0 - u), angle = 2.0 * PI * v;
    const vec n = {u >= 1.0 || u <= 0.0 ? 0.0 : sin(theta) * cos(angle), cos(theta),
                   u >= 1.0 || u <= 0.0 ? 0.0 : sin(theta) * sin(angle)};
    const double pores = smoothstep(0.25, 0.6, noise(add(scale(n, 21.0), (vec){f->seed, 0.0, 0.0})));
    const double navel = exp(-theta * theta / 0.006);
    const double r =
        1.0 - 0.012 * pores + 0.012 * noise(add(scale(n, 2.0), (vec){0.0, f->seed, 0.0})) - 0.05 * navel;
    return (vec){r * n.x, 0.95 * r * n.y, r * n.z};
}

static const fruit apples[] = {{{-0.83, 0.27, 0.06}, 0.165, 0.35, 0.4, 1.0},
                               {{-0.46, 0.26, 0.10}, 0.160, -0.45, 0.9, 5.0}};
static const fruit oranges[] = {{{-0.80, 0.27, -0.26}, 0.172, 0.5, 1.0, 2.0},
                                {{-0.64, 0.29, -0.02}, 0.170, -0.6, 2.0, 7.0}};
static const fruit pears[] = {{{-0.42, 0.33, -0.24}, 0.165, -0.55, 0.35, 3.0},
                              {{-0.36, 0.158, 0.60}, 0.155, 1.42, 2.2, 4.0}};

static void add_fruits(mesh *m, size_t count, const fruit *fruits, surface_function skin, const grid *size) {
    for (size_t i = 0; i < count; ++i) {
        const size_t first = m->vertex_count;
        mesh_grid(m, size, skin, &fruits[i]);
        place_fruit(m, first, &fruits[i]);
    }
}

static void build_apples(mesh *m) {
    add_fruits(m, COUNT(apples), apples, apple_surface,
               &(grid){.rows = 120, .columns = 140, .wraps_v = true});
}

static void build_oranges(mesh *m) {
    add_fruits(m, COUNT(oranges), oranges, orange_surface,
               &(grid){.rows = 132, .columns = 176, .wraps_v = true});
}

static void build_pears(mesh *m) {
    add_fruits(m, COUNT(pears), pears, pear_surface, &(grid){.rows = 96, .columns = 96, .wraps_v = true});
}

static vec stem_curve(const void *context, double u) {
    const double bend = *(const double *)context;
    return (vec){bend * u * u, 0.46 + 0.55 * u, 0.05 * u};
}

static double stem_radius(const void *context, double u) {
    (void)context;
    return 0.035 + 0.025 * u * u;
}

static vec pear_stem(const void *context, double u) {
    (void)context;
    return (vec){0.36 + 0.12 * u * u, 1.24 + 0.42 * u, 0.0};
}

static void build_stems(mesh *m) {
    static const double bends[2] = {0.22, -0.18};
    for (size_t i = 0; i < 2; ++i) {
        const tube stem = {
            .curve = stem_curve, .radius = stem_radius, .context = &bends[i], .rows = 20, .columns = 16};
        size_t first = m->vertex_count;
        mesh_tube(m, &stem);
        place_fruit(m, first, &apples[i]);
        const tube other = {.curve = pear_stem, .radius = stem_radius, .rows = 20, .columns = 16};
        first = m->vertex_count;
        mesh_tube(m, &other);
        place_fruit(m, first, &pears[i]);
    }
}

static vec ball_surface(const void *context, double u, double v) {
    (void)context;
    const double theta = PI * (1.0 - u), angle = 2.0 * PI * v;
    const double r = u >= 1.0 || u <= 0.0 ? 0.0 : sin(theta);
    return (vec){r * cos(angle), 1.08 * cos(theta), r * sin(angle)};
}

/* A bunch of grapes that hangs over the bowl's rim onto the table: grapes about a bent line, none within
 * another. */
static void build_grapes(mesh *m) {
    vec grapes[64];
    size_t count = 0;
    const grid size = {.rows = 20, .columns = 28, .wraps_v = true};
    for (size_t i = 0; i < 4000 && count < 44; ++i) {
        const double t = noise((vec){0.37 * (double)i, 3.3, 0.7}) * 0.5 + 0.5;
        const double angle = 40.0 * noise((vec){9.1, 0.41 * (double)i, 0.2});
        const double away =
            (0.035 + 0.10 * sin(PI * clamp(t, 0.05, 0.95))) * (0.55 + 0.45 * cos(7.0 * (double)i));
        vec p = {-0.40 + 0.50 * t, fmax(0.34 - 0.52 * t * t, 0.06), 0.20 + 0.26 * t};
        p = add(p, (vec){0.5 * away * cos(angle), fabs(away * sin(angle)) * 0.9, -away * cos(angle)});
        p.y = fmax(p.y, 0.062);
        bool free = length(subtract((vec){p.x, p.y, p.z}, (vec){-0.46, 0.26, 0.10})) > 0.215;
        for (size_t k = 0; k < count; ++k)
            free = free && length(subtract(p, grapes[k])) > 0.108;
        if (!free)
            continue;
        grapes[count++] = p;
        const size_t first = m->vertex_count;
        const fruit grape = {p, 0.056 + 0.004 * sin(5.0 * (double)i), 1.3 * sin(3.0 * (double)i),
                             2.0 * (double)i, 0.0};
        mesh_grid(m, &size, ball_surface, NULL);
        place_fruit(m, first, &grape);
    }
}

/* --- the cloth, over the table's front edge */

enum { CLOTH_ROWS = 220, CLOTH_COLUMNS = 170 };

static vec cloth_surface(const void *context, double u, double v) {
    (void)context;
    const double edge = 0.72, bend = 0.035; /* the table's front edge, and the roundness of the cloth there */
    const double x = -1.05 + 1.15 * v, s = -0.58 + 1.95 * u; /* along the cloth from the back to the front */
    const double skew = x - 0.16 * s;
    const double over = fmax(0.0, s - edge);
    const vec at = {2.3 * x, 2.0 * s, 0.0};
    const double wrinkle = 0.010 * fmax(0.0, noise(add(scale(at, 1.6), (vec){3.0, 1.0, 4.0})) + 0.15) +
                           0.004 * noise(scale(at, 4.0));
    const double fold =
        sin(13.0 * x + 1.5 * noise((vec){2.0 * x, 1.3 * s, 8.0})) * smoothstep(0.0, 0.5, over);
    if (over == 0.0)
        return (vec){skew, 0.006 + fmax(0.0, wrinkle), s};
    const double quarter = 0.5 * PI * bend;
    const double angle = fmin(over, quarter) / bend, down = fmax(0.0, over - quarter);
    return (vec){skew + 0.03 * fold,
                 0.006 + fmax(0.0, wrinkle) * (1.0 - smoothstep(0.0, 0.1, over)) - bend * (1.0 - cos(angle)) -
                     down,
                 edge + bend * sin(angle) + 0.03 + 0.06 * fold * smoothstep(0.0, 0.3, over) -
                     0.03 * (1.0 - smoothstep(0.0, quarter, over))};
}

static void build_cloth(mesh *m) {
    const grid size = {.rows = CLOTH_ROWS, .columns = CLOTH_COLUMNS};
    mesh_grid(m, &size, cloth_surface, NULL);
}

/* --- the wood of the table: rings of a tree that was cut lengthwise */

static aur_result paint_wood(aur_image **image, aur_error *error) {
    enum { WIDTH = 1536, HEIGHT = 640 };
    const aur_result result = aur_image_create(WIDTH, HEIGHT, 3, image, error);
    for (size_t y = 0; y < HEIGHT && result == AUR_OK; ++y)
        for (size_t x = 0; x < WIDTH; ++x) {
            const double px = 6.0 * (double)x / WIDTH, py = 2.5 * (double)y / HEIGHT;
            const double plank = floor(py / 0.5), within = py - 0.5 * plank;
            const vec p = {0.35 * px + 31.0 * plank, within + 2.7 * plank, 0.9 * plank};
            const double bent = p.y + 0.16 * noise((vec){1.3 * p.x, 2.2 * p.y, p.z}) +
                                0.03 * noise((vec){5.0 * p.x, 9.0 * p.y, 1.0});
            const double ring = 17.0 * bent - floor(17.0 * bent);
            const double late = pow(ring, 3.0), fiber = noise((vec){9.0 * px, 210.0 * py, 0.0});
            const double pore = smoothstep(0.35, 0.7, noise((vec){6.0 * px, 150.0 * py, 5.0}));
            const double seam = smoothstep(0.0, 0.006, within) * smoothstep(0.0, 0.006, 0.5 - within);
            const double shade = (0.80 + 0.16 * noise((vec){plank * 7.7, 0.3, 0.0}) - 0.30 * late +
                                  0.07 * fiber - 0.22 * pore) *
                                 (0.25 + 0.75 * seam);
            const double tint[3] = {0.40, 0.205, 0.095};
            for (size_t c = 0; c < 3; ++c)
                aur_image_data(*image)[3 * (y * WIDTH + x) + c] =
                    (float)fmax(0.004, tint[c] * pow(shade, 1.0 + 0.25 * (double)c));
        }
    return result;
}

const product product_teapot = {
    .file = "teapot.ply", .summary = "a teapot on the table", .build = build_teapot};
const product product_cups = {.file = "cups.ply", .summary = "two cups on saucers", .build = build_cups};
const product product_tea = {.file = "tea.ply", .summary = "the tea in the cups", .build = build_tea};
const product product_bowl = {.file = "bowl.ply", .summary = "a fluted bowl", .build = build_bowl};
const product product_apples = {.file = "apples.ply", .summary = "two apples", .build = build_apples};
const product product_oranges = {.file = "oranges.ply", .summary = "two oranges", .build = build_oranges};
const product product_pears = {.file = "pears.ply", .summary = "two pears", .build = build_pears};
const product product_grapes = {.file = "grapes.ply", .summary = "a bunch of grapes", .build = build_grapes};
const product product_stems = {
    .file = "stems.ply", .summary = "the stems of apples and pears", .build = build_stems};
const product product_cloth = {
    .file = "cloth.ply", .summary = "a cloth over the table's edge", .build = build_cloth};
const product product_wood = {.file = "wood.exr", .summary = "planks", .paint = paint_wood};
