/* Loading scenes of 1.5 million triangles from each mesh format, against the unavoidable part: one read of
 * the file and Embree's build of the same mesh. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <aureole-render/scene.h>

#include "bench.h"
#include "folder.h"
#include "grid.h"

enum { SIDE = 866, QUICK_SIDE = 60, PATH_CAPACITY = 256 };

static void write_obj(const bench_grid *g, FILE *file) {
    for (size_t i = 0; i < g->vertex_count; ++i)
        fprintf(file, "v %.5f %.5f %.5f\n", (double)g->positions[3 * i], (double)g->positions[3 * i + 1],
                (double)g->positions[3 * i + 2]);
    for (size_t i = 0; i < g->triangle_count; ++i)
        fprintf(file, "f %u %u %u\n", g->indices[3 * i] + 1, g->indices[3 * i + 1] + 1,
                g->indices[3 * i + 2] + 1);
}

static void write_serialized(const bench_grid *g, FILE *file) {
    const size_t vertex_bytes = 3 * g->vertex_count * sizeof(float);
    const size_t index_bytes = 3 * g->triangle_count * sizeof(uint32_t);
    const uint32_t flags = 0x1000, meshes = 1;
    const uint64_t counts[2] = {g->vertex_count, g->triangle_count}, offset = 0;
    unsigned char *const plain = malloc(22 + vertex_bytes + index_bytes);
    uLongf size = compressBound((uLong)(22 + vertex_bytes + index_bytes));
    unsigned char *const packed = malloc(size);
    if (plain != NULL && packed != NULL) {
        memcpy(plain, &flags, 4);
        memcpy(plain + 4, "m", 2);
        memcpy(plain + 6, counts, 16);
        memcpy(plain + 22, g->positions, vertex_bytes);
        memcpy(plain + 22 + vertex_bytes, g->indices, index_bytes);
        compress2(packed, &size, plain, (uLong)(22 + vertex_bytes + index_bytes), 1);
        fwrite("\x1c\x04\x04\0", 1, 4, file);
        fwrite(packed, 1, size, file);
        fwrite(&offset, 8, 1, file);
        fwrite(&meshes, 4, 1, file);
    }
    free(plain);
    free(packed);
}

typedef struct load_context {
    const bench_grid *mesh;
    char file[PATH_CAPACITY], scene[PATH_CAPACITY];
    bool failed;
} load_context;

static void load(void *data) {
    load_context *const context = data;
    aur_scene *scene = NULL;
    aur_error error;
    if (aur_scene_load(context->scene, NULL, &scene, &error) != AUR_OK)
        context->failed = !bench_fail("%s: %s", error.file, error.message);
    aur_scene_destroy(scene);
}

static void read_file(load_context *context) {
    const int file = open(context->file, O_RDONLY);
    struct stat status;
    char *const bytes = file >= 0 && fstat(file, &status) == 0 ? malloc((size_t)status.st_size) : NULL;
    size_t done = 0;
    for (ssize_t part; bytes != NULL && done < (size_t)status.st_size; done += (size_t)part) {
        part = read(file, bytes + done, (size_t)status.st_size - done);
        if (part <= 0)
            break;
    }
    context->failed = context->failed || bytes == NULL || done < (size_t)status.st_size;
    if (bytes != NULL)
        bench_keep((double)bytes[0]);
    free(bytes);
    if (file >= 0)
        close(file);
}

static void read_and_build(void *data) {
    load_context *const context = data;
    read_file(context);
    bench_grid_build(context->mesh);
}

static bool write_files(const char *folder, const char *kind, void (*write)(const bench_grid *, FILE *),
                        bool face_normals, load_context *context) {
    snprintf(context->file, sizeof context->file, "%s/mesh.%s", folder, kind);
    snprintf(context->scene, sizeof context->scene, "%s/%s.xml", folder, kind);
    FILE *file = fopen(context->file, "wb");
    if (file == NULL)
        return bench_fail("%s cannot be written", context->file);
    write(context->mesh, file);
    const bool good = fclose(file) == 0;
    file = fopen(context->scene, "wb");
    if (!good || file == NULL)
        return bench_fail("%s cannot be written", context->scene);
    fprintf(file,
            "<scene version='3.0.0'><sensor type='perspective'/><shape type='%s'><string name='filename' "
            "value='mesh.%s'/><boolean name='face_normals' value='%s'/></shape></scene>",
            kind, kind, face_normals ? "true" : "false");
    return fclose(file) == 0;
}

static bool measure(const bench_options *options, const char *folder, const bench_grid *mesh,
                    const char *kind, void (*write)(const bench_grid *, FILE *), bool face_normals) {
    load_context context = {.mesh = mesh};
    const bool written = write_files(folder, kind, write, face_normals, &context);
    if (written) {
        const double triangles = (double)mesh->triangle_count;
        const bench_work subject = {load, &context, triangles}, limit = {read_and_build, &context, triangles};
        bench_options few = *options;
        few.pairs = options->quick ? 1 : 5;
        const bench_pair pair = bench_compare(&few, &subject, &limit);
        char name[64];
        snprintf(name, sizeof name, "%s, %s", kind, face_normals ? "flat" : "smoothed where it can be");
        bench_print_pair(name, "reading the file, Embree's build", "Mtriangle", 1e6, &pair);
    }
    return written && (!context.failed || bench_fail("%s cannot be read", context.file));
}

static bool run(const bench_options *options) {
    bench_folder folder;
    if (!bench_folder_create(&folder))
        return false;
    bench_grid mesh;
    const bool good = bench_grid_create(&mesh, options->quick ? QUICK_SIDE : SIDE) &&
                      measure(options, folder.path, &mesh, "obj", write_obj, true) &&
                      measure(options, folder.path, &mesh, "obj", write_obj, false) &&
                      measure(options, folder.path, &mesh, "ply", bench_grid_write_ply, true) &&
                      measure(options, folder.path, &mesh, "ply", bench_grid_write_ply, false) &&
                      measure(options, folder.path, &mesh, "serialized", write_serialized, true);
    bench_grid_release(&mesh);
    bench_folder_remove(&folder);
    return good;
}

const bench bench_load = {"load", "scenes of 1.5 million triangles against reading and Embree's build", run};
