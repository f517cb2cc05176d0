#include "heavy_box.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "bench.h"
#include "points/base/vector.h"

static const char scene_head[] =
    "<scene version=\"3.0.0\">\n"
    "<default name=\"spp\" value=\"16\"/><default name=\"resx\" value=\"256\"/>"
    "<default name=\"resy\" value=\"256\"/>\n"
    "<integrator type=\"path\"/>\n"
    "<sensor type=\"perspective\"><float name=\"fov\" value=\"39.3076\"/><transform name=\"to_world\">"
    "<lookat origin=\"278, 273, -800\" target=\"278, 273, 0\" up=\"0, 1, 0\"/></transform>"
    "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"$spp\"/></sampler>"
    "<film type=\"hdrfilm\"><integer name=\"width\" value=\"$resx\"/><integer name=\"height\" "
    "value=\"$resy\"/><rfilter type=\"box\"/></film></sensor>\n"
    "<bsdf type=\"twosided\" id=\"white\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
    "value=\"0.734, 0.736, 0.706\"/></bsdf></bsdf>\n"
    "<bsdf type=\"twosided\" id=\"red\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
    "value=\"0.581, 0.088, 0.057\"/></bsdf></bsdf>\n"
    "<bsdf type=\"twosided\" id=\"green\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
    "value=\"0.132, 0.348, 0.118\"/></bsdf></bsdf>\n";

static const char scene_light[] =
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"65\" y=\"52.5\"/><rotate x=\"1\" "
    "angle=\"90\"/><translate x=\"278\" y=\"548.8\" z=\"279.5\"/></transform><emitter type=\"area\"><rgb "
    "name=\"radiance\" value=\"17, 11.8, 4\"/></emitter></shape>\n</scene>\n";

static bool write_scene(const char *path, const char *mesh) {
    static const char *const walls[][2] = {
        {"floor-and-ceiling", "white"}, {"back-wall", "white"}, {"red-wall", "red"}, {"green-wall", "green"}};
    static const char *const positions[] = {"x=\"180\" y=\"125.1\" z=\"170\"",
                                            "x=\"375\" y=\"125.1\" z=\"370\""};
    FILE *const file = fopen(path, "w");
    if (file == NULL)
        return false;
    fputs(scene_head, file);
    for (size_t i = 0; i < sizeof walls / sizeof walls[0]; ++i)
        fprintf(file,
                "<shape type=\"obj\"><string name=\"filename\" value=\"" AUR_SOURCE_DIR
                "/scenes/cornell-box/meshes/%s.obj\"/><ref id=\"%s\"/></shape>\n",
                walls[i][0], walls[i][1]);
    for (size_t i = 0; i < sizeof positions / sizeof positions[0]; ++i)
        fprintf(file,
                "<shape type=\"ply\"><string name=\"filename\" value=\"%s\"/><boolean "
                "name=\"face_normals\" value=\"true\"/><transform name=\"to_world\"><translate %s/>"
                "</transform><ref id=\"white\"/></shape>\n",
                mesh, positions[i]);
    fputs(scene_light, file);
    return fclose(file) == 0;
}

/* A sphere about the origin with a wavy radius between 100 and 125: `rows` by `rows` quads. */
static bool write_mesh(const char *path, size_t rows) {
    FILE *const file = fopen(path, "wb");
    if (file == NULL)
        return false;
    const size_t side = rows + 1;
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
            "property float z\nelement face %zu\nproperty list uchar uint vertex_indices\nend_header\n",
            side * side, 2 * rows * rows);
    for (size_t i = 0; i < side * side; ++i) {
        const double theta = AUR_PI * (double)(i / side) / (double)rows;
        const double phi = 2.0 * AUR_PI * (double)(i % side) / (double)rows;
        const double radius = 112.5 + 12.5 * sin(24.0 * theta) * sin(24.0 * phi);
        const float vertex[3] = {(float)(radius * sin(theta) * cos(phi)), (float)(radius * cos(theta)),
                                 (float)(radius * sin(theta) * sin(phi))};
        fwrite(vertex, sizeof vertex, 1, file);
    }
    for (size_t i = 0; i < rows * rows; ++i) {
        const uint32_t a = (uint32_t)(i / rows * side + i % rows), b = a + (uint32_t)side;
        const uint32_t triangles[2][3] = {{a, b + 1, b}, {a, a + 1, b + 1}};
        for (size_t k = 0; k < 2; ++k) {
            fputc(3, file);
            fwrite(triangles[k], sizeof triangles[k], 1, file);
        }
    }
    return fclose(file) == 0;
}

bool bench_heavy_box(const char *folder, size_t triangles, char *path, size_t capacity) {
    const size_t rows = (size_t)ceil(sqrt((double)triangles / 4.0));
    char mesh[4096];
    snprintf(mesh, sizeof mesh, "%s/bumpy-sphere-%zu.ply", folder, rows);
    if (snprintf(path, capacity, "%s/heavy-box-%zu.xml", folder, rows) >= (int)capacity)
        return bench_fail("the path of %s is too long", folder);
    if (access(path, R_OK) == 0)
        return true;
    /* The scene is written last: if it exists, the mesh is complete. */
    return (write_mesh(mesh, rows) && write_scene(path, mesh)) || bench_fail("%s cannot be written", folder);
}
