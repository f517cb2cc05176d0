#include "render/scene/scene_data.h"
#include "scene_text.h"

#include "render/scene/materials/sampling.h"

static aur_result load(const char *text, aur_scene **scene, aur_error *error) {
    return aur_scene_load_memory("room.rad", strlen(text), text, NULL, scene, error);
}

static aur_scene *must_load(const char *text) {
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (load(text, &scene, &error) != AUR_OK) {
        char message[1024];
        aur_error_format(&error, sizeof message, message);
        fail_msg("%s", message);
    }
    return scene;
}

#define MATERIALS                                                                                            \
    "# materials\nvoid plastic white\n0\n0\n5 .7 .6 .5 0 .1\nvoid light lamp 0 0 3 10 20 30\n"               \
    "void glow sky 0 0 4 1 2 3 0\nvoid alias grey white\n"

/* Every kind of surface, with its area and a point that a ray from `eye` along `way` finds, where the front
 * is on the eye's side. */
static void reads_surfaces(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double area;
        aur_vector eye, way;
        double distance;
    } rows[] = {
        {"polygon p 0 0 12  0 0 0  2 0 0  2 3 0  0 3 0", 6.0, {1, 1, 2}, {0, 0, -1}, 2.0},
        {"polygon p\n0\n0\n9\n 0 0 0\n 2 0 0\n 0 2 0", 2.0, {.5f, .5f, 2}, {0, 0, -1}, 2.0},
        {"sphere s 0 0 4 1 1 1 .5", AUR_PI, {1, 1, 5}, {0, 0, -1}, 3.5},
        {"bubble s 0 0 4 1 1 1 .5", AUR_PI, {1, 1, 1}, {0, 0, -1}, 0.5},
        {"sphere s 0 0 4 1 1 1 -.5", AUR_PI, {1, 1, 1}, {0, 0, -1}, 0.5},
        {"cylinder c 0 0 7 0 0 0 0 0 2 .5", 2.0 * AUR_PI, {3, 0, 1}, {-1, 0, 0}, 2.5},
        {"tube c 0 0 7 0 0 0 0 0 2 .5", 2.0 * AUR_PI, {0, 0, 1}, {-1, 0, 0}, 0.5},
        {"cone c 0 0 8 0 0 0 0 0 2 .5 1.5", 2.0 * AUR_PI * 2.2360679774997897, {3, 0, 1}, {-1, 0, 0}, 2.0},
        {"cone c 0 0 8 0 0 0 0 0 2 1 0", AUR_PI * 2.2360679774997897, {.25f, 0, 4}, {0, 0, -1}, 2.5},
        {"cup c 0 0 8 0 0 0 0 0 2 1 0", AUR_PI * 2.2360679774997897, {.25f, 0, -4}, {0, 0, 1}, 5.5},
        {"cup c 0 0 8 0 0 2 0 0 0 1 1", 4.0 * AUR_PI, {0, 0, 1}, {0, -1, 0}, 1.0},
        {"ring r 0 0 8 0 0 3 0 0 -2 2 1", 3.0 * AUR_PI, {1.5f, 0, 0}, {0, 0, 1}, 3.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char text[1024];
        snprintf(text, sizeof text, MATERIALS "lamp %s\ngrey sphere far 0 0 4 100 100 100 1\n", rows[i].text);
        aur_scene *const scene = must_load(text);
        assert_relative(scene->shapes[0]->area, rows[i].area, 1e-6);
        const aur_ray ray = {rows[i].eye, 0.0f, rows[i].way, INFINITY};
        aur_hit hit;
        aur_surface surface;
        assert_true(aur_scene_intersect(scene, &ray, &hit));
        assert_near(hit.distance, rows[i].distance, 1e-6);
        aur_scene_surface(scene, &ray, &hit, &surface);
        /* Light leaves the front only. */
        const aur_vector back = aur_vector_scale(rows[i].way, -1.0f);
        assert_near(aur_surface_emission(scene, &surface, back).z, 30.0, 0.0);
        assert_near(aur_surface_emission(scene, &surface, rows[i].way).z, 0.0, 0.0);
        aur_scene_destroy(scene);
    }
    /* through the ring's hole */
    aur_scene *const ring = must_load(MATERIALS "white ring r 0 0 8 0 0 3 0 0 1 1 2");
    const aur_ray hole = {{0.5f, 0.5f, 0}, 0.0f, {0, 0, 1}, INFINITY};
    assert_false(aur_scene_occluded(ring, &hole));
    for (size_t i = 0; i < 100; ++i) {
        const aur_shape_point point =
            aur_shape_sample(ring->shapes[0], NULL, (const float[3]){0, (float)i / 100.0f, 0.3f});
        assert_near(point.position.x * point.position.x + point.position.y * point.position.y,
                    1.0 + 3.0 * (double)i / 100.0, 1e-5);
    }
    aur_scene_destroy(ring);
}

/* Whether a point is in a polygon of a plane: crossings of a line to the right. */
static bool contains(size_t count, const double (*p)[2], double x, double y) {
    bool inside = false;
    for (size_t i = 0; i < count; ++i) {
        const double *const a = p[i], *const b = p[(i + 1) % count];
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            inside = !inside;
    }
    return inside;
}

/* Outlines of any form, and a hole by a seam that goes there and back: rays hit where points are inside, and
 * the area is the outline's. */
static void cuts_polygons(void **state) {
    (void)state;
    static const struct {
        size_t count;
        double corners[16][2];
        double area;
    } rows[] = {
        {6, {{0, 3}, {4, 3}, {4, 5}, {2, 5}, {2, 4}, {0, 4}}, 6.0},
        {8, {{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, 10.0},
        {10, {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}, 32.0},
        {10, {{0, 5}, {1, 1}, {2, 4}, {3, 0}, {4, 4}, {5, 1}, {6, 5}, {4, 4.5}, {3, 6}, {2, 4.5}}, 14.5},
        {5, {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 4.0},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        char text[2048];
        int used = sprintf(text, MATERIALS "white polygon p 0 0 %zu", 3 * rows[k].count);
        double area = 0.0;
        for (size_t i = 0; i < rows[k].count; ++i) {
            const double *const a = rows[k].corners[i], *const b = rows[k].corners[(i + 1) % rows[k].count];
            area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            used += sprintf(text + used, " %g %g 2", a[0], a[1]);
        }
        aur_scene *const scene = must_load(text);
        assert_relative(scene->shapes[0]->area, area, 1e-6);
        for (size_t i = 0; i < 2000; ++i) {
            const double x = -0.5 + 7.0 * fmod(0.618034 * (double)i, 1.0),
                         y = -0.5 + 7.0 * (double)i / 2000.0;
            const aur_ray ray = {{(float)x, (float)y, 0.0f}, 0.0f, {0, 0, 1}, INFINITY};
            assert_int_equal(aur_scene_occluded(scene, &ray), contains(rows[k].count, rows[k].corners, x, y));
        }
        aur_scene_destroy(scene);
    }
}

/* A plane under a dome of glow and a sun: sources add up, and a light of 180 degrees is a hemisphere. */
static void reads_sources(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load(MATERIALS "sky source up 0 0 4 0 0 1 180\nlamp source down 0 0 4 0 0 -2 "
                            "180\nlamp source sun 0 0 4 1 0 1 .533\n"
                            "white polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n");
    assert_int_equal(aur_scene_emitter_count(scene), 3);
    assert_near(aur_scene_environment(scene, (aur_vector){0, 0.6f, 0.8f}).y, 2.0, 0.0);
    assert_near(aur_scene_environment(scene, (aur_vector){0, 0.6f, -0.8f}).y, 20.0, 0.0);
    const float half = sqrtf(0.5f);
    assert_near(aur_scene_environment(scene, (aur_vector){half, 0, half}).z, 33.0, 0.0);
    aur_scene_destroy(scene);
}

/* A pane as Fresnel has it for each polarisation, summed over ways to and fro inside, one by one. */
static void glass_by_its_series(void **state) {
    (void)state;
    aur_scene *const scene =
        must_load("void glass g 0 0 4 .9 .5 0 1.52\ng polygon p 0 0 9 0 0 0 1 0 0 0 1 0");
    const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, 0);
    static const double inside_of[3] = {0.9, 0.5, 0.0};
    for (size_t k = 0; k < 10; ++k) {
        const double angle = (double)k * 8.9 * AUR_PI / 180.0, refracted = asin(sin(angle) / 1.52);
        double through[3] = {0}, mirrored[3] = {0};
        for (size_t s = 0; s < 2; ++s) {
            const double up = s == 0 ? cos(angle) : 1.52 * cos(angle);
            const double down = s == 0 ? 1.52 * cos(refracted) : cos(refracted);
            const double amplitude = (up - down) / (up + down), r = amplitude * amplitude;
            for (size_t c = 0; c < 3; ++c) {
                const double d = pow(inside_of[c], 1.0 / cos(refracted));
                double power = 0.5 * (1.0 - r) * d; /* arrives at the far surface */
                mirrored[c] += 0.5 * r;
                for (size_t bounce = 0; bounce < 60; ++bounce) {
                    *(bounce % 2 == 0 ? &through[c] : &mirrored[c]) += (1.0 - r) * power;
                    power *= r * d;
                }
            }
        }
        const aur_vector view = {(float)sin(angle), 0.0f, (float)cos(angle)};
        aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
        double seen[2][3];
        assert_int_equal(aur_bsdf_lobes(bsdf, (aur_bsdf_point){.u = 0.0f}, view, lobes), 2);
        for (size_t i = 0; i < 2; ++i)
            aur_vector_to_doubles(lobes[i].coefficient, seen[lobes[i].transmits ? 0 : 1]);
        for (size_t c = 0; c < 3; ++c) {
            assert_near(seen[0][c], through[c], 2e-6);
            assert_near(seen[1][c], mirrored[c], 2e-6);
        }
    }
    aur_scene_destroy(scene);
}

static void record(void *user, const char *message) {
    char *const text = user;
    strncat(text, message, 1023 - strlen(text));
    strncat(text, "\n", 1023 - strlen(text));
}

/* Boxes and prisms have the area and the volume of their formulas: the volume by the divergence of position /
 * 3 over the faces, so that every face looks outwards, or inwards where it is inverted. */
static void generates_boxes_and_prisms(void **state) {
    (void)state;
    const struct {
        const char *text;
        size_t shapes;
        double area, volume;
    } rows[] = {
        {"!genbox white b 1 2 3", 6, 22.0, 6.0},
        {"!genbox white b 1 2 3 -i | xform -t 5 6 7 -rx 30", 6, 22.0, -6.0},
        {"!genbox white b 1 2 3 | xform -s 2 -mx", 6, 88.0, 48.0},
        {"!genbox white b 1 1 1 | xform -a 3 -t 2 0 0 -a 2 -t 0 2 0 -i 2 -t 0 0 2", 36, 36.0, 6.0},
        /* faces of .8 x .8, twelve strips of .8 x .1 sqrt 2, eight triangles of side .1 sqrt 2 */
        {"!genbox white b 1 1 1 -b .1", 26, 6.0 * .64 + 12.0 * .08 * sqrt(2.0) + 8.0 * sqrt(3.0) / 4.0 * .02,
         1.0 - 12.0 * .8 * .005 - 8.0 * .001 * 5.0 / 6.0},
        {"!genprism white p 3 0 0 1 0 0 1 -l 0 0 -2", 5, 1.0 + 4.0 + 2.0 * sqrt(2.0), 1.0},
        {"!genprism white p 3 0 0 1 0 0 1 -l 0 0 2 -e -c", 2, 2.0 + 2.0 * sqrt(2.0), -2.0 / 3.0},
        {"!genprism white p corners.txt -l 0 0 -2", 5, 1.0 + 4.0 + 2.0 * sqrt(2.0), 1.0},
    };
    FILE *const corners = fopen("corners.txt", "w");
    assert_true(corners != NULL && fputs("0 0\n1 0 # here\n0 1\n", corners) >= 0 && fclose(corners) == 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char text[1024];
        snprintf(text, sizeof text, MATERIALS "%s\n", rows[i].text);
        aur_scene *const scene = must_load(text);
        double area = 0.0, volume = 0.0;
        assert_int_equal(scene->shape_count, rows[i].shapes);
        for (size_t k = 0; k < scene->shape_count; ++k) {
            const aur_shape *const shape = scene->shapes[k];
            area += shape->area;
            for (size_t t = 0; t < shape->mesh.triangle_count; ++t) {
                aur_vector corner[3];
                aur_mesh_corners(&shape->mesh, t, corner);
                const aur_vector origin = {(float)scene->origin[0], (float)scene->origin[1],
                                           (float)scene->origin[2]};
                for (size_t c = 0; c < 3; ++c)
                    corner[c] = aur_vector_add(corner[c], origin);
                volume += (double)aur_vector_dot(corner[0], aur_vector_cross(corner[1], corner[2])) / 6.0;
            }
        }
        assert_relative(area, rows[i].area, 1e-6);
        assert_near(volume, rows[i].volume, 1e-4 * fabs(rows[i].volume));
        aur_scene_destroy(scene);
    }
    /* rounded: the parallel body of a box of .6 x .8 x 1 at .2 (Steiner 1840) */
    aur_scene *const scene = must_load(MATERIALS "!genbox white b 1 1.2 1.4 -r .2\n");
    double area = 0.0;
    assert_int_equal(scene->shape_count, 26);
    for (size_t k = 0; k < 18; ++k)
        area += scene->shapes[k]->area;
    assert_relative(area, 2.0 * (.6 * .8 + .6 + .8) + 4.0 * (.6 + .8 + 1.0) * (2.0 * AUR_PI * .2), 1e-6);
    aur_scene_destroy(scene);
}

static double area_of(const char *text, size_t shapes) {
    aur_scene *const scene = must_load(text);
    double area = 0.0;
    assert_int_equal(scene->shape_count, shapes);
    for (size_t k = 0; k < scene->shape_count; ++k)
        area += scene->shapes[k]->area;
    aur_scene_destroy(scene);
    return area;
}

/* A rounded prism over a rectangle is a rounded box, whichever way it is extruded. A surface of revolution of
 * straight pieces has the area of its frustums; expressions are read as calcomp does, a sign before a power.
 */
static void generates_rounded_prisms_and_revolutions(void **state) {
    (void)state;
    const double box = area_of(MATERIALS "!genbox white b 1 1.2 1.4 -r .2\n", 26);
    assert_relative(area_of(MATERIALS "!genprism white p 4 0 0 0 1.2 1 1.2 1 0 -l 0 0 1.4 -r .2\n", 26), box,
                    1e-6);
    assert_relative(area_of(MATERIALS "!genprism white p 4 0 0 1 0 1 1.2 0 1.2 -l 0 0 -1.4 -r .2\n", 26), box,
                    1e-6);
    static const struct {
        const char *text;
        size_t shapes;
        double area;
    } rows[] = {
        {"'t' '1'  4", 4, 2.0},      /* a cylinder */
        {"'0' '1+t' '2*2'", 4, 3.0}, /* a ring of radii 1 and 2 */
        {"'2*t' 'if(t-.25, 1, 2)' 2 -s", 2, 3.0 * 1.4142135623730951 + 2.0},
        {"'4+-2^2*t' '3-mod(4,3)' 1", 1, 2.0 * 4.0 * 2.0}, /* (-2)^2 */
        {"'PI*t/PI' 'sqrt(1)*hermite(1,1,0,0,t)' 1", 1, 2.0},
        {"'max(t,0)' 'abs(-1)*bezier(1,1,1,1,t)' 1", 1, 2.0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char text[1024];
        snprintf(text, sizeof text, MATERIALS "!genrev white r %s\n", rows[i].text);
        assert_relative(area_of(text, rows[i].shapes), AUR_PI * rows[i].area, 1e-6);
    }
}

/* Hemispherical means of matrices between two patches of the same projected solid angle, pi / 2. */
static void takes_means_of_matrices(void **state) {
    (void)state;
    static const char matrix[] =
        "<WavelengthData><Wavelength unit=\"Integral\">%s</Wavelength><WavelengthDataBlock>"
        "<WavelengthDataDirection>%s</WavelengthDataDirection><ColumnAngleBasis>two</ColumnAngleBasis>"
        "<ScatteringData>%s</ScatteringData></WavelengthDataBlock></WavelengthData>\n";
    FILE *const file = fopen("two.xml", "w");
    assert_non_null(file);
    fprintf(file,
            "<WindowElement><AngleBasis><AngleBasisName>two</AngleBasisName>"
            "<AngleBasisBlock><nPhis>1</nPhis><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>45"
            "</UpperTheta></ThetaBounds></AngleBasisBlock><AngleBasisBlock><nPhis>1</nPhis><ThetaBounds>"
            "<LowerTheta>45</LowerTheta><UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock>"
            "</AngleBasis>\n");
    fprintf(file, matrix, "Solar", "Transmission Front", "9 9 9 9");
    fprintf(file, matrix, "Visible", "Transmission Front", ".1, .2,\n.3, 0,");
    fprintf(file, matrix, "Visible", "Reflection Front", ".1 0 0 .1");
    fprintf(file, matrix, "Visible", "Reflection Back", "0 .2 .2 0");
    fputs("</WindowElement>\n", file);
    assert_int_equal(fclose(file), 0);
    static const char text[] = "void BSDF w 6 0 two.xml 0 0 1 . 0 0\nw sphere s 0 0 4 0 0 0 1\n"
                               "void aBSDF v 5 none.xml 0 0 1 . 0 0\n";
    char said[1024] = "";
    const aur_scene_options options = {.size = sizeof options, .warnings = {record, said}, .diffuse = true};
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (aur_scene_load_memory("room.rad", sizeof text - 1, text, &options, &scene, &error) != AUR_OK)
        fail_msg("%zu: %s", error.line, error.message);
    assert_non_null(strstr(said, "1 patterns, textures and materials"));
    const aur_bsdf_point point = {.u = 0.0f};
    float pdf;
    for (size_t i = 0; i < 2; ++i) {
        const aur_vector value =
            aur_bsdf_evaluate(aur_scene_shape_bsdf(scene, 0), AUR_BSDF_WHOLE, point, (aur_vector){0, 0, 1},
                              (aur_vector){0, 0, i == 0 ? 1.0f : -1.0f}, &pdf);
        assert_near(value.x, (i == 0 ? 0.5 * (.2 + .4) : .6) * (AUR_PI / 4.0) / AUR_PI, 1e-6);
    }
    aur_scene_destroy(scene);
}

/* Replacements by --diffuse for unsupported materials; one warning counts them. */
static void takes_diffuse_parts(void **state) {
    (void)state;
    static const char text[] =
        "void texfunc dents 4 a b c d.cal 0 0\ndents plastic2 p 1 . 0 6 .4 .5 .6 .1 .1 .1\n"
        "void transfunc t 2 a b.cal 0 6 .5 .5 .5 .2 .5 0\nvoid antimatter none 1 p 0 0\n"
        "void mixfunc m 4 void p a b.cal 0 0\np sphere s 0 0 4 0 0 0 1\nt sphere s 0 0 4 5 0 0 1\n"
        "none sphere s 0 0 4 9 0 0 1\nm sphere s 0 0 4 5 5 0 1\nvoid sphere s 0 0 4 0 0 0 9\n";
    char said[1024] = "";
    const aur_scene_options options = {.size = sizeof options, .warnings = {record, said}, .diffuse = true};
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (aur_scene_load_memory("room.rad", sizeof text - 1, text, &options, &scene, &error) != AUR_OK)
        fail_msg("%zu: %s", error.line, error.message);
    assert_string_equal(said, "room.rad: 4 patterns, textures and materials of Radiance are not read: "
                              "their diffuse part replaces them\n");
    assert_int_equal(scene->shape_count, 3);
    const aur_bsdf_point point = {.u = 0.0f};
    const aur_vector coat = aur_bsdf_diffuse_albedo(aur_scene_shape_bsdf(scene, 0), point, 1.0f);
    assert_near(coat.x, .9 * .4 + .1, 1e-6);
    assert_near(coat.z, .9 * .6 + .1, 1e-6);
    float pdf;
    const aur_vector through = aur_bsdf_evaluate(aur_scene_shape_bsdf(scene, 1), AUR_BSDF_WHOLE, point,
                                                 (aur_vector){0, 0, 1}, (aur_vector){0, 0, -1}, &pdf);
    assert_near(through.x, .8 * .5 * .5 / AUR_PI, 1e-6);
    assert_ptr_equal(aur_scene_shape_bsdf(scene, 2), aur_scene_shape_bsdf(scene, 0));
    aur_scene_destroy(scene);
}

#define SPHERE(material) material " sphere s 0 0 4 0 0 0 1\n"

static void bad_input(void **state) {
    (void)state;
    static const struct {
        const char *text;
        size_t line;
        const char *message;
    } rows[] = {
        {"\nvoid brightfunc b\n2 a b\n0\n0\n" SPHERE("b"), 2, "'brightfunc' is not read"},
        {"void plasic p 0 0 5 1 1 1 0 0", 1, "plastic"},
        {"void plastic p\n0\n0\n5 1 1 1 1.5 0\n" SPHERE("p"), 1, "1.5 must be from 0 to 1"},
        {"void trans2 p 0 0 7 1 1 1 0 0 .5 .5\nvoid alias q p\n" SPHERE("q"), 1, "'trans2' is not read"},
        {"m poligon p 0 0 9 0 0 0 1 0 0 0 1 0", 1, "'poligon' is not read"},
        {"void plastic p\n0\n0\n4 1 1 1 .1", 1, "plastic takes 5 numbers, not 4"},
        {"void plastic p\n0\n0\n5 1 1 1 .1 x", 4, "expected a number here, not 'x'"},
        {"void plastic p\n0\n0\n5 1 1 nan 0 0", 4, "expected a number here, not 'nan'"},
        {"void plastic p\n0\n-1\n5 1 1 1 0 0", 3, "expected the number of integers here, not '-1'"},
        {"void plastic p\n0\n1 7\n5 1 1 1 0 0", 3, "plastic takes no integers, not 1"},
        {"void plastic p\n0\n", 3, "the file ends, but the number of integers must follow"},
        {"void plastic p\n99999999999999999999\n", 2, "expected the number of strings here"},
        {"void plastic p 0 0 5 1.5 1 1 0 0", 1, "'reflectance'"},
        {"\n\n!gensurf a b 1 1 1", 3,
         "'gensurf' is not run, only cat, xform, genbox, genprism, genrev, gendaylit"},
        {"!genbox a b 1 1 1", 1, "unknown material 'a': it is not defined above"},
        {"!genbox a b 1 1", 1, "genbox: three sizes expected"},
        {"!genbox a b 1 1 0", 1, "genbox: sizes must be above 0"},
        {"!genbox a b 1 1 1 -b .6", 1, "at most half"},
        {"!genbox a b 1 1 1 -o", 1, "genbox: '-o' is not read"},
        {"!genprism a b 2 0 0 1 1", 1, "must be from 3 to 1024"},
        {"!genprism a b x.txt", 1, "cannot find 'x.txt'"},
        {"!genprism a b 3 0 0 1 1 0 1 -r 2", 1, "at most the height"},
        {"!genprism a b 3 0 0 0 0 0 1 -r .1", 1, "side 2 has no length"},
        {"!genprism a b 3 0 0 1 0 .5 0 -r .1", 1, "lie on each other"},
        {"!genrev a b t 1", 1, "z(t), r(t) and the number of pieces expected"},
        {"!genrev a b t 1 0", 1, "must be from 1"},
        {"!genrev a b t 1 2 -e x", 1, "genrev: '-e' is not read"},
        {"!genrev a b t -1 2", 1, "r(0) = -1 must not be below 0"},
        {"!genrev a b t 'sine(t)' 2", 1, "unknown name in 'sine(t)': 'sine'"},
        {"!genrev a b t 'sin(t,1)' 2", 1, "wrong arguments in 'sin(t,1)': 'sin'"},
        {"!genrev a b '(t' 1 2", 1, "')' expected in '(t'"},
        {"!genrev a b 't t' 1 2", 1, "an operator expected in 't t': 't'"},
        {"!genrev a b '1/t' 1 2", 1, "a finite value expected"},
        {"!genprism a b 3 0 0 1 1 0", 1, "x and y of each corner expected"},
        {"!xform -t 1 2 chair.rad", 1, "xform: 3 numbers expected after '-t'"},
        {"!xform -s 0 chair.rad", 1, "-s must not be 0"},
        {"!xform -a 1000 -t 1 0 0 -a 1000 -t 0 1 0 chair.rad", 1, "more than 100000 objects"},
        {"!xform -a 0 chair.rad", 1, "-a 0 makes nothing"},
        {"!xform -a 1.5 chair.rad", 1, "must be a whole number"},
        {"!xform -m", 1, "a name expected after '-m'"},
        {"!xform -f options.txt a.rad", 1, "'-f' is not supported after xform"},
        {"!xform a.rad | b", 1, "'b' is not supported after '|'"},
        {"!xform a.rad | xform b.rad", 1, "'b.rad' is not supported after '| xform'"},
        {"!xform a.rad |", 1, "'|' is not supported after a command"},
        {"\n\n!cat nowhere.rad", 3, "cannot find 'nowhere.rad'"},
        {"!cat a.rad > b.rad", 1, "'>' is not supported after cat"},
        {"\n! cat # nothing", 2, "included file not found"},
        {"!cat \xc3\xa4\xf0\x9f\x98\x80.rad", 1, "cannot find '\xc3\xa4\xf0\x9f\x98\x80.rad'"},
        {"!cat a\xe4.rad", 1, "cannot find 'a\xe4.rad'"},
        {"!cat a\x01.rad", 1, "must not have control characters"},
        {"!", 1, "a command must follow '!'"},
        {"nix sphere s 0 0 4 0 0 0 1", 1, "unknown material 'nix'"},
        {"void alias a b", 1, "unknown material 'b'"},
        {"void brightfunc b 2 a b 0 0\nb plastic p 0 0 5 1 1 1 0 0\n" SPHERE("p"), 2,
         "its modifier must be 'void', not 'b'"},
        {MATERIALS "white polygon p 0 0 10 0 0 0 1 0 0 0 1 0 0", 9, "are not corners of three"},
        {MATERIALS "white ring p 0 0 8 0 0 0 0 0 1 1 1", 9, "two different radii"},
        {MATERIALS "white ring p 0 0 8 0 0 0 0 0 0 1 2", 9, "two different radii"},
        {MATERIALS "white source p 0 0 4 0 0 1 1", 9, "must be a light or a glow"},
        {MATERIALS "lamp source p 0 0 4 0 0 1 0", 9, "its angle must be"},
        {MATERIALS "lamp source p 0 0 4 0 0 0 1", 9, "'sun_direction' must not be"},
        {MATERIALS "white mesh p 1 a.rtm 0 0", 9, "is compiled for Radiance"},
        {MATERIALS "white mesh p 3 a.obj -rx 9 0 0", 9, "cannot find 'a.obj'"},
        {MATERIALS "white mesh p 1 a&\"<$b.obj 0 0", 9, "a&\"<$b.obj"},
        {MATERIALS "white mesh p 1 a\x1b.obj 0 0", 9, "must not have control characters"},
        {MATERIALS "white sphere p 1 a 0 4 0 0 0 1", 9, "sphere takes no strings"},
        {MATERIALS "white instance p 1 a.oct 0 0", 9, "instance: 'a.oct' is compiled for Radiance"},
        {MATERIALS "white instance p 2 a.rad b.rad 0 0", 9, "instance: 'b.rad' is not an option of xform"},
        {MATERIALS "white mesh p 0 0 0", 9, "mesh: the name of a file expected"},
        {MATERIALS "white cone p 0 0 8 0 0 0 0 0 1 1 -1", 9, "must not be of different signs"},
        {MATERIALS "white cone p 0 0 8 0 0 0 0 0 0 1 1", 9, "'p0' and 'p1' must differ"},
        {MATERIALS "white cup p 0 0 8 0 0 0 0 0 1 0 0", 9, "must be above 0"},
        {"void dielectric d 0 0 5 1 1 2 1.5 0\n" SPHERE("d"), 1, "transmission must be from 0 to 1"},
        {"void light g 0 0 3 1 -1 1", 1, "must not be below 0"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_scene *scene = NULL;
        aur_error error = {0};
        if (load(rows[i].text, &scene, &error) == AUR_OK)
            fail_msg("row %zu loads", i);
        if (strstr(error.message, rows[i].message) == NULL || error.line != rows[i].line || error.column != 0)
            fail_msg("row %zu: %zu:%zu: %s", i, error.line, error.column, error.message);
        assert_string_equal(error.file, "room.rad");
    }
}

/* Unsupported objects are reported immediately, before the mesh is searched; the last one is the error. Other
 * mistakes are the error if the file cannot be read on. */
static void says_all_that_is_left_out(void **state) {
    (void)state;
    static const struct {
        const char *text, *warnings;
        aur_result result;
        const char *message;
    } rows[] = {
        {"void brightfunc b\n2 dirt dirt.cal\n0\n1 .5\nb plastic p 0 0 5 1 1 1 0 0\np mesh m 1 none.obj 0 0\n"
         "void plastic2 q 1 . 0 5 1 1 1 .5 0\n!gensurf q box 1 1 1 | xform\nq blob c 0 0 8 0 0 0 0 0 1 1 .5\n"
         "q sphere s 0 0 4 0 0 0 1\nq sphere s 0 0 4 0 0 0 1\n",
         "room.rad:5: plastic: patterns, textures and mixtures are not read: its modifier must be 'void', "
         "not 'b'\n"
         "room.rad:8: the command 'gensurf' is not run, only cat, xform, genbox, genprism, genrev, "
         "gendaylit and gensky are: write what it makes into a file and include that\n"
         "room.rad:9: 'blob' is not read; did you mean 'glow'?\n",
         AUR_ERROR_UNSUPPORTED, "'plastic2' is not read; did you mean 'plastic'?"},
        {"void mixfunc d 0 0 5 1 1 1 1.5 0\nvoid mirror unused 0 0 3 1 1 1\n" SPHERE(
             "d") "void plastic q 0 0 4 1 1 1 0\n",
         "room.rad:1: 'mixfunc' is not read\n", AUR_ERROR_FORMAT, "plastic takes 5 numbers, not 4"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char said[1024] = "";
        const aur_scene_options options = {.size = sizeof options, .warnings = {record, said}};
        aur_scene *scene = NULL;
        aur_error error = {0};
        assert_int_equal(
            aur_scene_load_memory("room.rad", strlen(rows[i].text), rows[i].text, &options, &scene, &error),
            rows[i].result);
        assert_string_equal(said, rows[i].warnings);
        assert_non_null(strstr(error.message, rows[i].message));
        /* it is the default */
        assert_int_equal(
            aur_scene_load_memory("room.rad", strlen(rows[i].text), rows[i].text, NULL, &scene, NULL),
            rows[i].result);
    }
}

/* Materials of any kind that no surface uses change nothing. */
static void materials_may_be_unused(void **state) {
    (void)state;
    static const char unused[] =
        "void trans t 0 0 7 1 1 1 0 0 .5 .5\nvoid plastic shiny 0 0 5 .2 .2 .2 .1 .2\n"
        "void brightfunc f 2 skybr other.cal 0 2 1 .5\nf glow g 0 0 4 1 1 1 0\n"
        "void BSDF b 6 0 a.xml 0 0 1 . 0 0\nvoid mixfunc m 4 a b c d.cal 0 0\nvoid alias other t\n"
        "void glow behind 0 0 4 1 1 1 -1\n" MATERIALS "white sphere s 0 0 4 0 0 0 1\n";
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (load(unused, &scene, &error) != AUR_OK)
        fail_msg("%zu: %s", error.line, error.message);
    assert_int_equal(scene->shape_count, 1);
    aur_scene_destroy(scene);
}

/* Faces that are no surface are counted and refuse nothing, lights of them too; bent ones become triangles.
 */
static void leaves_out_what_is_no_surface(void **state) {
    (void)state;
    static const char text[] = MATERIALS "white polygon p 0 0 9 0 0 0 1 0 0 2 0 0\n"
                                         "white polygon p 0 0 12 0 0 0 1 0 0 1 1 .01 0 1 0\n"
                                         "white polygon p 0 0 12 0 0 0 2 2 0 2 0 0 0 1 0\n"
                                         "lamp polygon p 0 0 12 0 0 0 1 0 0 2 0 0 1 0 0\n"
                                         "lamp polygon p 0 0 9 0 0 3 1 0 3 0 1 3\n"
                                         "lamp polygon p 0 0 9 0 0 4 1 0 4 2 0 4\n";
    char said[1024] = "";
    const aur_scene_options options = {.size = sizeof options, .warnings = {record, said}};
    aur_scene *scene = NULL;
    assert_int_equal(aur_scene_load_memory("room.rad", strlen(text), text, &options, &scene, NULL), AUR_OK);
    assert_string_equal(said,
                        "room.rad:10: 1 of 6 polygons have corners outside of their plane and become "
                        "triangles at an angle (the "
                        "first is here)\n"
                        "room.rad:9: 3 of 6 polygons have no area and are left out (the first is here)\n"
                        "room.rad:11: 1 of 6 polygons have an outline that crosses itself and are left out "
                        "(the first is here)\n"
                        "room.rad:12: 2 lights have no area and give no light (the first is here)\n");
    static const size_t triangles[] = {0, 2, 0, 0, 1, 0};
    for (size_t i = 0; i < 6; ++i)
        assert_int_equal(scene->shapes[i]->mesh.triangle_count, triangles[i]);
    assert_int_equal(scene->emitter_count, 1);
    assert_int_equal(scene->emitters[0]->shape, 4);
    assert_int_equal(scene->shapes[4]->emitter, 0);
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_surfaces),
        cmocka_unit_test(cuts_polygons),
        cmocka_unit_test(reads_sources),
        cmocka_unit_test(glass_by_its_series),
        cmocka_unit_test(generates_boxes_and_prisms),
        cmocka_unit_test(generates_rounded_prisms_and_revolutions),
        cmocka_unit_test(takes_means_of_matrices),
        cmocka_unit_test(takes_diffuse_parts),
        cmocka_unit_test(bad_input),
        cmocka_unit_test(materials_may_be_unused),
        cmocka_unit_test(says_all_that_is_left_out),
        cmocka_unit_test(leaves_out_what_is_no_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
