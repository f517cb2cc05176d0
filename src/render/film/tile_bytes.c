/* Tiles of a film in bytes, from one process to another. */
#include "points/base/bytes.h"
#include "render/film/film.h"

typedef struct piece {
    void *data;
    size_t size; /* of one pixel */
} piece;

enum { PIECES = 5 };

/* Goes over the tile's rows, `move` by piece: each is a stretch of one of the film's arrays. */
static void each_row(const aur_film *film, size_t index, void (*move)(void *bytes, size_t size, void *data),
                     void *bytes) {
    const aur_film_layout *const layout = &film->layout;
    const piece pieces[PIECES] = {{film->sums, layout->channel_count * sizeof *film->sums},
                                  {film->squares, 3 * sizeof *film->squares},
                                  {film->counts, sizeof *film->counts},
                                  {film->given, sizeof *film->given},
                                  {film->steps, sizeof *film->steps}};
    aur_tile tile = {0};
    aur_film_place_tile(film, index, &tile);
    for (size_t y = tile.y0; y < tile.y1; ++y) {
        const size_t pixel = (y - layout->y0) * (layout->x1 - layout->x0) + (tile.x0 - layout->x0);
        for (size_t p = 0; p < PIECES; ++p)
            move(bytes, tile.stride * pieces[p].size, (char *)pieces[p].data + pixel * pieces[p].size);
    }
}

static void put(void *bytes, size_t size, void *data) {
    aur_bytes_put(bytes, size, data);
}

static void get(void *bytes, size_t size, void *data) {
    aur_bytes_get(bytes, size, data);
}

void aur_film_put_tile(const aur_film *film, size_t index, aur_bytes *bytes) {
    pthread_mutex_lock(film->lock);
    each_row(film, index, put, bytes);
    pthread_mutex_unlock(film->lock);
}

void aur_film_get_tile(aur_film *film, size_t index, const aur_counters *counted, aur_bytes_reader *bytes) {
    pthread_mutex_lock(film->lock);
    each_row(film, index, get, bytes);
    aur_counters_add(&film->counters, counted);
    pthread_mutex_unlock(film->lock);
}
