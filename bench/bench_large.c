/* Large scenes: memory and time of 30 million triangles, compared with Embree alone, and a group of many
 * shapes. */
#include <stdio.h>

#include "bench.h"
#include "child.h"
#include "folder.h"
#include "grid.h"

enum { SIDE = 3873, QUICK_SIDE = 60, SHAPES = 30000, QUICK_SHAPES = 300, PATH_CAPACITY = 64 };

typedef struct large_context {
    size_t side, shapes;
    char mesh[PATH_CAPACITY], scene[PATH_CAPACITY], group[PATH_CAPACITY];
} large_context;

static bool write_mesh(void *data) {
    const large_context *const context = data;
    bench_grid mesh;
    FILE *const file = fopen(context->mesh, "wb");
    bool good = bench_grid_create(&mesh, context->side) && file != NULL;
    if (good)
        bench_grid_write_ply(&mesh, file);
    bench_grid_release(&mesh);
    if (file != NULL)
        good = fclose(file) == 0 && good;
    return good;
}

/* The baseline: Embree's mesh and its tree. */
static bool build(void *data) {
    const large_context *const context = data;
    bench_grid mesh;
    const bool good = bench_grid_create(&mesh, context->side);
    if (good)
        bench_grid_build(&mesh);
    bench_grid_release(&mesh);
    return good;
}

static bool write_scenes(const large_context *context) {
    FILE *const scene = fopen(context->scene, "wb"), *const group = fopen(context->group, "wb");
    if (scene != NULL)
        fprintf(scene,
                "<scene version='3.0.0'><shape type='ply'><string name='filename' value='%s'/><boolean "
                "name='face_normals' value='true'/></shape></scene>",
                context->mesh);
    if (group != NULL)
        fprintf(group, "<scene version='3.0.0'><shape type='shapegroup' id='group'>\n");
    for (size_t i = 0; i < context->shapes && group != NULL; ++i)
        fprintf(group,
                "<shape type='%s'><transform name='to_world'><scale value='.3'/><translate x='%zu' "
                "y='%zu'/></transform><bsdf type='diffuse'/></shape>\n",
                i % 2 == 0 ? "cube" : "sphere", i % 173, i / 173);
    if (group != NULL)
        fprintf(group, "</shape><shape type='instance'><ref id='group'/></shape></scene>");
    const bool scene_closed = scene != NULL && fclose(scene) == 0;
    const bool group_closed = group != NULL && fclose(group) == 0;
    return (scene_closed && group_closed) || bench_fail("%s cannot be written", context->scene);
}

static bool measure(large_context *context) {
    bench_child_cost written, bare, ours, group;
    const bool good = write_scenes(context) && bench_run_apart(write_mesh, context, &written) &&
                      bench_run_apart(build, context, &bare) &&
                      bench_run_child((const char *const[]){"info", context->scene, NULL}, &ours) &&
                      bench_run_child((const char *const[]){"info", context->group, NULL}, &group);
    if (!good)
        return false;
    const double triangles = 2.0 * (double)context->side * (double)context->side;
    printf(
        "%.1f million triangles: %.2f GB, %.2f times Embree's own %.2f GB; %.1f CPU s, %.2f times its %.1f\n",
        1e-6 * triangles, 1e-9 * ours.peak_bytes, ours.peak_bytes / bare.peak_bytes, 1e-9 * bare.peak_bytes,
        ours.cpu_seconds, ours.cpu_seconds / bare.cpu_seconds, bare.cpu_seconds);
    printf("a group of %zu shapes: %.2f CPU s\n", context->shapes, group.cpu_seconds);
    return true;
}

static bool run(const bench_options *options) {
    bench_folder folder;
    if (!bench_folder_create(&folder))
        return false;
    large_context context = {.side = options->quick ? QUICK_SIDE : SIDE,
                             .shapes = options->quick ? QUICK_SHAPES : SHAPES};
    snprintf(context.mesh, sizeof context.mesh, "%s/mesh.ply", folder.path);
    snprintf(context.scene, sizeof context.scene, "%s/mesh.xml", folder.path);
    snprintf(context.group, sizeof context.group, "%s/group.xml", folder.path);
    const bool good = measure(&context);
    bench_folder_remove(&folder);
    return good;
}

const bench bench_large = {
    "large", "memory of 30 million triangles against Embree alone; a group of 30,000 shapes", run};
