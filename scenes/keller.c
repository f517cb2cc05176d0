/* keller FOLDER: the meshes of Keller's four scenes (1994, figure 1 and section 4.1) in FOLDER/meshes, and
 * their analytic forms, FOLDER/<scene>-analytic.xml, in which every triangle reflects half and emits 1/4.
 *
 * Nobody has the original models, so these are new ones with the same numbers of triangles. They are what the
 * paper's mathematics asks for: closed, in metres, with no two faces on each other. Every solid is closed in
 * itself and stands two millimetres off the next. The teapot has Newell's shape, but lid and pot are one
 * solid, and handle and spout are closed solids that end just before the pot; 5 by 5 quads a patch make its
 * 1560 triangles. z is up. */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "make/sheet.h"
#include "make/solids.h"
#include "points/base/random.h"

static const double gap = 0.002;

typedef struct writer {
    const char *folder, *scene;
    size_t triangle_count; /* of the scene so far */
    sheet analytic;
    char path[1024]; /* of the analytic form */
    group group;
    aur_error error;
    aur_result result; /* the first failure */
} writer;

/* --- files */

static void store_error(writer *w, aur_result result) {
    if (w->result == AUR_OK)
        w->result = result;
}

static void begin_scene(writer *w, const char *scene) {
    w->scene = scene;
    w->triangle_count = 0;
    snprintf(w->path, sizeof w->path, "%s/%s-analytic.xml", w->folder, scene);
    if (w->result == AUR_OK)
        w->result = sheet_open(&w->analytic, &w->error);
    if (w->result != AUR_OK)
        return;
    fprintf(
        w->analytic.stream,
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
        "<!--\n    Keller's analytic form of %s (1994, section 4.1): every triangle reflects half and emits "
        "1/4, so the\n"
        "    radiance is 1/2 everywhere. Below 1, ceiling and walls leave so much of the room's length and "
        "height\n"
        "    closed. Made by ../keller.c.\n-->\n<scene version=\"3.0.0\">\n"
        "    <default name=\"ceiling\" value=\"1\"/>\n    <default name=\"walls\" value=\"1\"/>\n"
        "    <default name=\"integrator\" value=\"radiosity\"/>\n    <default name=\"spp\" value=\"16\"/>\n\n"
        "    <integrator type=\"$integrator\"/>\n\n    <include filename=\"%s-camera.xml\"/>\n\n"
        "    <bsdf type=\"diffuse\" id=\"half\">\n        <rgb name=\"reflectance\" value=\"0.5\"/>\n    "
        "</bsdf>\n",
        scene, scene);
}

static void begin_group(writer *w) {
    w->group.vertex_count = w->group.triangle_count = 0;
}

#define TO_WORLD(scale_)                                                                                     \
    "        <transform name=\"to_world\">\n            <scale " scale_ "/>\n        </transform>\n"

/* Writes meshes/<scene>-<name>.obj; texture coordinates, where wanted, are metres along x and y. */
static void end_group(writer *w, const char *name, bool textured) {
    const group *const g = &w->group;
    char path[1024];
    snprintf(path, sizeof path, "%s/meshes/%s-%s.obj", w->folder, w->scene, name);
    w->triangle_count += g->triangle_count;
    sheet file;
    if (w->result == AUR_OK)
        w->result = sheet_open(&file, &w->error);
    if (w->result != AUR_OK)
        return;
    fprintf(file.stream, "# Made by scenes/keller.c. Metres, z up.\n");
    for (size_t i = 0; i < g->vertex_count; ++i)
        fprintf(file.stream, "v %.6g %.6g %.6g\n", g->vertices[i].x + 0.0, g->vertices[i].y + 0.0,
                g->vertices[i].z + 0.0);
    for (size_t i = 0; textured && i < g->vertex_count; ++i)
        fprintf(file.stream, "vt %.6g %.6g\n", g->vertices[i].x + 0.0, g->vertices[i].y + 0.0);
    for (size_t i = 0; i < g->triangle_count; ++i) {
        const size_t a = g->triangles[i][0] + 1, b = g->triangles[i][1] + 1, c = g->triangles[i][2] + 1;
        if (textured)
            fprintf(file.stream, "f %zu/%zu %zu/%zu %zu/%zu\n", a, a, b, b, c, c);
        else
            fprintf(file.stream, "f %zu %zu %zu\n", a, b, c);
    }
    store_error(w, sheet_write(&file, path, &w->error));
    const char *const transform = strcmp(name, "ceiling") == 0     ? TO_WORLD("x=\"$ceiling\"")
                                  : strncmp(name, "wall-", 5) == 0 ? TO_WORLD("z=\"$walls\"")
                                                                   : "";
    fprintf(w->analytic.stream,
            "\n    <shape type=\"obj\">\n        <string name=\"filename\" value=\"meshes/%s-%s.obj\"/>\n%s"
            "        <boolean name=\"face_normals\" value=\"true\"/>\n        <ref id=\"half\"/>\n"
            "        <emitter type=\"area\">\n            <rgb name=\"radiance\" value=\"0.25\"/>\n        "
            "</emitter>\n"
            "    </shape>\n",
            w->scene, name, transform);
}

static void end_scene(writer *w, size_t triangles) {
    if (w->result != AUR_OK) {
        sheet_abandon(&w->analytic);
        return;
    }
    fprintf(w->analytic.stream, "</scene>\n");
    store_error(w, sheet_write(&w->analytic, w->path, &w->error));
    if (w->triangle_count == triangles || w->result != AUR_OK)
        return;
    w->result = AUR_ERROR_INTERNAL;
    snprintf(w->error.message, sizeof w->error.message, "%s has %zu triangles, not %zu", w->scene,
             w->triangle_count, triangles);
}

/* --- scenes */

static void add_wall(writer *w, const char *name, const size_t corner[8], size_t a, size_t b, size_t c,
                     size_t d) {
    w->group.triangle_count = 0;
    add_quad(&w->group, corner[a], corner[b], corner[c], corner[d]);
    end_group(w, name, false);
}

/* A room of 12 triangles that is seen from inside: floor, ceiling, walls at low and high x and y. */
static void write_room(writer *w, span x, span y, span z) {
    group *const g = &w->group;
    size_t c[8];
    begin_group(w);
    add_box_corners(g, x, y, z, c);
    add_quad(g, c[0], c[1], c[3], c[2]);
    end_group(w, "floor", true);
    add_wall(w, "ceiling", c, 4, 6, 7, 5);
    add_wall(w, "wall-left", c, 0, 2, 6, 4);
    add_wall(w, "wall-right", c, 1, 5, 7, 3);
    add_wall(w, "wall-front", c, 0, 4, 5, 1);
    add_wall(w, "wall-back", c, 2, 3, 7, 6);
}

static void write_cube(writer *w) {
    begin_scene(w, "cube");
    write_room(w, (span){0.0, 1.0}, (span){0.0, 1.0}, (span){0.0, 1.0});
    end_scene(w, 12);
}

/* The 1 x 1 x 26 box whose ratio of plain to weighted deviations is that of the paper's "cube". */
static void write_corridor(writer *w) {
    begin_scene(w, "corridor");
    write_room(w, (span){0.0, 26.0}, (span){0.0, 1.0}, (span){0.0, 1.0});
    end_scene(w, 12);
}

static void write_teapot_box(writer *w) {
    begin_scene(w, "teapot-box");
    write_room(w, (span){-0.5, 0.5}, (span){-0.4, 0.4}, (span){0.0, 0.7});
    begin_group(w);
    add_teapot(&w->group, 0.085, (vec){0.0, 0.0, gap});
    end_group(w, "teapot", false);
    end_scene(w, 1572);
}

/* A desk 1.6 wide: top, two side panels and one behind the knees. */
static void add_desk(group *g, double x, double y) {
    const double top = 0.72;
    add_box(g, (span){x, x + 1.6}, (span){y, y + 0.8}, (span){top, top + 0.03});
    add_box(g, (span){x + 0.02, x + 0.05}, (span){y + 0.04, y + 0.76}, (span){gap, top - gap});
    add_box(g, (span){x + 1.55, x + 1.58}, (span){y + 0.04, y + 0.76}, (span){gap, top - gap});
    add_box(g, (span){x + 0.05 + gap, x + 1.55 - gap}, (span){y + 0.66, y + 0.68}, (span){0.3, top - gap});
}

static void add_shelf_boards(group *g, span x, span y, size_t boards, double height, double thickness) {
    for (size_t i = 0; i < boards; ++i) {
        const double z = gap + (height - thickness) * (double)i / (double)(boards - 1);
        add_box(g, x, y, (span){z, z + thickness});
    }
}

static void write_office(writer *w) {
    group *const g = &w->group;
    begin_scene(w, "office");
    write_room(w, (span){0.0, 6.0}, (span){0.0, 5.0}, (span){0.0, 2.8});
    begin_group(w);
    add_desk(g, 0.9, 2.5);
    add_desk(g, 3.0, 2.5);
    end_group(w, "desks", false);
    begin_group(w);
    /* A chair of seat, back and two frames; a screen on its foot. */
    add_box(g, (span){1.45, 1.95}, (span){1.75, 2.25}, (span){0.44, 0.5});
    add_box(g, (span){1.47, 1.93}, (span){1.7, 1.75 - gap}, (span){0.5, 1.0});
    add_box(g, (span){1.45, 1.48}, (span){1.77, 2.23}, (span){gap, 0.44 - gap});
    add_box(g, (span){1.92, 1.95}, (span){1.77, 2.23}, (span){gap, 0.44 - gap});
    add_box(g, (span){1.38, 2.02}, (span){2.94, 2.98}, (span){0.84, 1.22});
    add_box(g, (span){1.58, 1.82}, (span){2.86, 3.06}, (span){0.75 + gap, 0.84 - gap});
    end_group(w, "black", false);
    begin_group(w);
    /* Sides, three boards and a back. */
    add_box(g, (span){3.3, 3.33}, (span){4.6, 4.96}, (span){gap, 2.0});
    add_box(g, (span){4.87, 4.9}, (span){4.6, 4.96}, (span){gap, 2.0});
    add_shelf_boards(g, (span){3.33 + gap, 4.87 - gap}, (span){4.6, 4.96}, 3, 1.6, 0.03);
    add_box(g, (span){3.3, 4.9}, (span){4.96 + gap, 4.98}, (span){gap, 2.0});
    end_group(w, "shelf", false);
    begin_group(w);
    add_box(g, (span){0.9, 2.5}, (span){2.3, 2.5}, (span){2.6, 2.66});
    add_box(g, (span){3.4, 5.0}, (span){2.3, 2.5}, (span){2.6, 2.66});
    end_group(w, "lamps", false);
    end_scene(w, 276);
}

/* --- the living room */

/* Four legs under the box that x, y span. */
static void add_legs(group *g, span x, span y, span z) {
    const double side = 0.05, inset = 0.03;
    for (size_t i = 0; i < 4; ++i) {
        const double left = i & 1 ? x.high - inset - side : x.low + inset;
        const double front = i & 2 ? y.high - inset - side : y.low + inset;
        add_box(g, (span){left, left + side}, (span){front, front + side}, z);
    }
}

static void write_seats(writer *w) {
    group *const g = &w->group;
    begin_group(w);
    /* A sofa along the back wall: base, back, arms, three cushions to sit on and three to lean on. */
    add_box(g, (span){1.9, 4.3}, (span){3.75, 4.65}, (span){0.12, 0.3});
    add_box(g, (span){2.1 + gap, 4.1 - gap}, (span){4.45, 4.65}, (span){0.3 + gap, 0.82});
    add_box(g, (span){1.9, 2.1}, (span){3.75, 4.65}, (span){0.3 + gap, 0.6});
    add_box(g, (span){4.1, 4.3}, (span){3.75, 4.65}, (span){0.3 + gap, 0.6});
    for (size_t i = 0; i < 3; ++i) {
        const span x = {2.11 + 0.6 * (double)i, 2.69 + 0.6 * (double)i};
        add_box(g, x, (span){3.77, 4.43}, (span){0.3 + gap, 0.44});
        add_box(g, (span){x.low + 0.02, x.high - 0.02}, (span){4.27, 4.44}, (span){0.44 + gap, 0.78});
    }
    end_group(w, "sofa", false);
    begin_group(w);
    /* An armchair that looks along -x: base, back, arms, cushion. */
    add_box(g, (span){4.8, 5.6}, (span){2.3, 3.1}, (span){0.12, 0.3});
    add_box(g, (span){5.42, 5.6}, (span){2.46 + gap, 2.94 - gap}, (span){0.3 + gap, 0.85});
    add_box(g, (span){4.8, 5.6}, (span){2.3, 2.46}, (span){0.3 + gap, 0.58});
    add_box(g, (span){4.8, 5.6}, (span){2.94, 3.1}, (span){0.3 + gap, 0.58});
    add_box(g, (span){4.81, 5.41}, (span){2.47, 2.93}, (span){0.3 + gap, 0.44});
    end_group(w, "armchair", false);
}

static void write_woodwork(writer *w) {
    group *const g = &w->group;
    const double rug = 0.012 + 2.0 * gap;
    begin_group(w);
    add_legs(g, (span){1.9, 4.3}, (span){3.75, 4.65}, (span){gap, 0.12 - gap});
    add_legs(g, (span){4.8, 5.6}, (span){2.3, 3.1}, (span){gap, 0.12 - gap});
    /* A low table, and a bench for the screen. */
    add_box(g, (span){2.5, 3.7}, (span){2.4, 3.0}, (span){0.4, 0.43});
    add_legs(g, (span){2.5, 3.7}, (span){2.4, 3.0}, (span){rug, 0.4 - gap});
    add_box(g, (span){4.7, 6.2}, (span){4.3, 4.75}, (span){gap, 0.45});
    /* Shelves along the left wall: sides, five boards, a back. */
    add_box(g, (span){0.04, 0.34}, (span){1.4, 1.43}, (span){gap, 2.0});
    add_box(g, (span){0.04, 0.34}, (span){2.97, 3.0}, (span){gap, 2.0});
    add_shelf_boards(g, (span){0.04, 0.34}, (span){1.43 + gap, 2.97 - gap}, 5, 1.98, 0.03);
    add_box(g, (span){0.02, 0.04 - gap}, (span){1.4, 3.0}, (span){gap, 2.0});
    end_group(w, "wood", false);
}

/* Row by row from the left; every third book of one colour. */
static void write_books(writer *w) {
    static const size_t books[4] = {9, 8, 9, 7};
    static const char *const names[3] = {"books-red", "books-blue", "books-sand"};
    for (size_t color = 0; color < 3; ++color) {
        begin_group(w);
        for (size_t row = 0; row < 4; ++row) {
            double y = 1.46;
            const double z = gap + 1.95 * (double)row / 4.0 + 0.03 + gap;
            for (size_t i = 0; i < books[row]; ++i) {
                const uint64_t hash = aur_hash3(1994, row, i);
                const double width = 0.03 + 0.04 * aur_unit_double(hash);
                const double height = 0.24 + 0.14 * aur_unit_double(aur_mix64(hash));
                const double depth = 0.18 + 0.06 * aur_unit_double(aur_mix64(hash + 1));
                if ((row + i) % 3 == color)
                    add_box(&w->group, (span){0.06, 0.06 + depth}, (span){y, y + width},
                            (span){z, z + height});
                y += width + gap + (i == books[row] / 2 ? 0.35 : 0.0);
            }
        }
        end_group(w, names[color], false);
    }
}

/* `points` radii and heights from the top down; the axis is added at both ends. */
static profile make_profile(size_t points, const double radius[], const double height[]) {
    profile p = {0};
    add_to_profile(&p, 0.0, height[0]);
    for (size_t i = 0; i < points; ++i)
        add_to_profile(&p, radius[i], height[i]);
    add_to_profile(&p, 0.0, height[points - 1]);
    return p;
}

static void write_luminaires(writer *w) {
    group *const g = &w->group;
    const vec base = {1.45, 4.25, 0.0};
    begin_group(w);
    static const double stand_radius[] = {0.012, 0.012, 0.012, 0.012, 0.016, 0.03, 0.15, 0.15};
    static const double stand_height[] = {1.39, 1.0, 0.6, 0.2, 0.06, 0.035, 0.022, 0.002};
    const profile stand = make_profile(8, stand_radius, stand_height);
    add_turned(g, &stand, 16, base);
    end_group(w, "stand", false);
    begin_group(w);
    static const double shade_radius[] = {0.13, 0.22};
    static const double shade_height[] = {1.7, 1.4};
    const profile shade = make_profile(2, shade_radius, shade_height);
    add_turned(g, &shade, 16, base);
    end_group(w, "shade", false);
    begin_group(w);
    profile globe = {0};
    for (size_t i = 0; i <= 6; ++i) {
        const double angle = 3.14159265358979323846 * (double)i / 6.0;
        add_to_profile(&globe, i % 6 == 0 ? 0.0 : 0.16 * sin(angle), 0.16 * cos(angle));
    }
    add_turned(g, &globe, 12, (vec){3.1, 2.5, 2.2});
    end_group(w, "globe", false);
}

static void write_crockery(writer *w) {
    group *const g = &w->group;
    const double table = 0.43 + gap;
    begin_group(w);
    add_teapot(g, 0.045, (vec){3.0, 2.68, table});
    static const double cup_radius[] = {0.03, 0.042, 0.04, 0.034, 0.022};
    static const double cup_height[] = {0.02, 0.07, 0.045, 0.015, 0.0};
    const profile cup = make_profile(5, cup_radius, cup_height);
    add_turned(g, &cup, 12, (vec){3.36, 2.55, table});
    add_turned(g, &cup, 12, (vec){3.4, 2.82, table});
    end_group(w, "china", false);
    begin_group(w);
    static const double vase_radius[] = {0.02, 0.045, 0.04, 0.035, 0.05, 0.08, 0.105, 0.11, 0.1, 0.08, 0.06};
    static const double vase_height[] = {0.32, 0.42, 0.39, 0.35, 0.31, 0.26, 0.2, 0.15, 0.09, 0.04, 0.0};
    const profile vase = make_profile(11, vase_radius, vase_height);
    add_turned(g, &vase, 20, (vec){4.92, 4.5, 0.45 + gap});
    end_group(w, "vase", false);
}

static void write_living_room(writer *w) {
    group *const g = &w->group;
    begin_scene(w, "living-room");
    write_room(w, (span){0.0, 6.4}, (span){0.0, 4.8}, (span){0.0, 2.6});
    write_seats(w);
    write_woodwork(w);
    write_books(w);
    write_luminaires(w);
    write_crockery(w);
    begin_group(w);
    add_box(g, (span){1.9, 4.5}, (span){1.7, 3.6}, (span){gap, gap + 0.012});
    end_group(w, "rug", false);
    begin_group(w);
    add_box(g, (span){5.1, 6.1}, (span){4.55, 4.6}, (span){0.53, 1.1});
    add_box(g, (span){5.4, 5.8}, (span){4.5, 4.65}, (span){0.45 + gap, 0.53 - gap});
    end_group(w, "screen", false);
    begin_group(w);
    add_box(g, (span){2.4, 3.8}, (span){4.77, 4.8 - gap}, (span){1.15, 2.05});
    end_group(w, "mirror", false);
    begin_group(w);
    add_box(g, (span){4.75, 5.35}, (span){4.77, 4.8 - gap}, (span){1.3, 2.0});
    add_box(g, (span){gap, 0.03}, (span){3.4, 4.1}, (span){1.2, 2.0});
    end_group(w, "pictures", false);
    end_scene(w, 3604);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: keller FOLDER   writes FOLDER/meshes/*.obj and FOLDER/*-analytic.xml\n");
        return 2;
    }
    writer *const w = calloc(1, sizeof *w);
    if (w == NULL) {
        fprintf(stderr, "keller: out of memory\n");
        return 3;
    }
    w->folder = argv[1];
    write_cube(w);
    write_corridor(w);
    write_teapot_box(w);
    write_office(w);
    write_living_room(w);
    const aur_result result = w->result;
    if (result != AUR_OK) {
        char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
        aur_error_format(&w->error, sizeof text, text);
        fprintf(stderr, "keller: %s\n", text);
    }
    free(w);
    return result == AUR_OK ? 0 : 3;
}
