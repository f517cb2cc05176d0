
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "render/vertex/visible_emitters.h"

typedef struct emitter_edges {
    uint16_t *probes; /* per pixel; NULL: no pixel has any */
} emitter_edges;

static void destroy(void *data) {
    emitter_edges *const edges = data;
    if (edges == NULL)
        return;
    free(edges->probes);
    free(edges);
}

static void mark_about(const aur_view *view, size_t pixel, size_t reach, uint16_t probes, uint16_t *marked) {
    const size_t x = pixel % view->width, y = pixel / view->width;
    for (size_t j = y > reach ? y - reach : 0; j <= y + reach && j < view->height; ++j)
        for (size_t i = x > reach ? x - reach : 0; i <= x + reach && i < view->width; ++i)
            marked[j * view->width + i] = probes;
}

static aur_result find(const aur_view *view, uint16_t probes, emitter_edges *edges, aur_error *error) {
    const size_t pixels = view->width * view->height;
    const aur_film_layout layout = {
        .width = view->width, .height = view->height, .x1 = view->width, .y1 = view->height};
    const float radius = -aur_filter_sample(view->filter, 0.0f);
    const size_t drawn = (size_t)ceilf(aur_larger(radius - 0.5f, 0.0f));
    const size_t beyond = drawn > view->reach ? drawn : view->reach;
    aur_visible_emitters visible = {0};
    aur_result result =
        aur_visible_emitters_find(view->scene, &layout, aur_emitter_points(pixels), 0, &visible, error);
    for (size_t i = 0; result == AUR_OK && visible.share != NULL && i < pixels; ++i) {
        if (!visible.edges[i])
            continue;
        if (edges->probes == NULL)
            edges->probes = calloc(pixels, sizeof *edges->probes);
        if (edges->probes == NULL)
            result = aur_fail_memory(error);
        else
            mark_about(view, i, beyond, probes, edges->probes);
    }
    aur_visible_emitters_release(&visible);
    return result;
}

aur_result aur_emitter_edges_find(const aur_view *view, uint16_t probes,
                                  const aur_integrator_context *context, const uint16_t **out,
                                  aur_error *error) {
    *out = NULL;
    if (!aur_visible_emitters_can_be_found(view))
        return AUR_OK;
    char key[160];
    snprintf(key, sizeof key, "lamp edges %zu %zu %s %.9g %zu %u", view->width, view->height,
             aur_filter_name(view->filter), (double)aur_filter_sample(view->filter, 0.0f), view->reach,
             (unsigned)probes);
    emitter_edges *edges = aur_cache_find(context->cache, key);
    if (edges == NULL) {
        const uint64_t before = aur_rays_traced;
        edges = calloc(1, sizeof *edges);
        aur_result result = edges != NULL ? find(view, probes, edges, error) : aur_fail_memory(error);
        if (result != AUR_OK) {
            destroy(edges);
            return result;
        }
        result = aur_cache_store(context->cache, key, edges, aur_rays_traced - before, destroy);
        if (result != AUR_OK)
            return result;
    }
    *out = edges->probes;
    return AUR_OK;
}
