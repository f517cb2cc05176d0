/* Writes facets as an input of View3D. */
#include "lighting/viewfactors/facets.h"
#include "points/base/file.h"
#include "points/base/text.h"
#include "render/scene/scene_data.h"

#include <stdlib.h>

/* View3D's names have no blanks. */
static void write_name(FILE *stream, const char *name) {
    for (; *name != '\0'; ++name)
        fputc(aur_is_space(*name) ? '_' : *name, stream);
}

/* Surfaces are numbered from 1; those of a row are combined with its first one. `leaders` holds that number
 * for each row, or 0. */
static void write_surfaces(const aur_facets *facets, size_t *leaders, FILE *stream) {
    const aur_scene *const scene = facets->scene;
    size_t surface = 0, facet = 0, vertices = 1;
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_mesh *const mesh = &scene->shapes[i]->mesh;
        for (size_t k = 0; k < mesh->triangle_count; ++k, ++facet) {
            if (facets->areas[facet] == 0.0)
                continue;
            size_t *const leader = &leaders[facets->rows[facet]];
            ++surface;
            fprintf(stream, "S %zu %zu %zu %zu 0 0 %zu 1.0 ", surface, vertices + mesh->indices[3 * k],
                    vertices + mesh->indices[3 * k + 1], vertices + mesh->indices[3 * k + 2], *leader);
            if (facets->grouped)
                write_name(stream, facets->names[facets->groups[facet]]);
            else
                fprintf(stream, "facet-%u", (unsigned)facets->sources[facet]);
            fputc('\n', stream);
            if (*leader == 0)
                *leader = surface;
        }
        vertices += mesh->vertex_count;
    }
}

aur_result aur_facets_write_vs3(const aur_facets *facets, const char *path, aur_error *error) {
    size_t *const leaders = calloc(facets->front_rows, sizeof *leaders);
    if (leaders == NULL)
        return aur_fail_memory(error);
    aur_file_writer writer;
    const aur_result result = aur_file_open(path, &writer, error);
    if (result != AUR_OK) {
        free(leaders);
        return result;
    }
    const aur_scene *const scene = facets->scene;
    fputs("T facets written by Aureole\nC out=1\nF 3\n", writer.stream);
    size_t vertex = 0;
    for (size_t i = 0; i < scene->shape_count; ++i) {
        const aur_mesh *const mesh = &scene->shapes[i]->mesh;
        for (size_t k = 0; k < mesh->vertex_count; ++k) {
            const double *const p = &mesh->points[3 * k];
            aur_print(writer.stream, "V %zu %.17g %.17g %.17g\n", ++vertex, p[0], p[1], p[2]);
        }
    }
    write_surfaces(facets, leaders, writer.stream);
    fputs("End of data\n", writer.stream);
    free(leaders);
    return aur_file_commit(&writer, error);
}
