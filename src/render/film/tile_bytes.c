/* Serialises tiles of a film between processes. */
#include "points/base/bytes.h"
#include "render/film/film.h"

typedef struct piece {
    void *data;
    size_t size; /* of one pixel */
} piece;

enum { PIECES = 5, PIXEL_PIECES = 2 }; /* the first two only where pixels share no samples */

/* Calls `move` for each row of the tile in each of the film's arrays, as one contiguous piece of memory. */
static void each_row(const aur_film *film, size_t index, void (*move)(void *bytes, size_t size, void *data),
                     void *bytes) {
    const aur_film_layout *const layout = &film->layout;
    const piece pieces[PIECES] = {{film->sums, layout->channel_count * sizeof *film->sums},
                                  {film->squares, 3 * sizeof *film->squares},
                                  {film->counts, sizeof *film->counts},
                                  {film->given, sizeof *film->given},
                                  {film->steps, sizeof *film->steps}};
    aur_tile tile = {0};
    aur_film_set_tile(film, index, &tile);
    const size_t x0 = tile.x0 > layout->x0 ? tile.x0 : layout->x0;
    const size_t x1 = tile.x1 < layout->x1 ? tile.x1 : layout->x1;
    for (size_t y = tile.y0; y < tile.y1; ++y) {
        size_t pixel;
        if (x0 >= x1 || !aur_film_has(film, x0, y, &pixel))
            continue;
        for (size_t p = film->spread != NULL ? PIXEL_PIECES : 0; p < PIECES; ++p)
            move(bytes, (x1 - x0) * pieces[p].size, (char *)pieces[p].data + pixel * pieces[p].size);
    }
    const aur_spread *const spread = film->spread;
    if (spread == NULL)
        return;
    const piece cells[] = {
        {spread->sums, spread->cell_values * sizeof *spread->sums},
        {spread->given, sizeof *spread->given},
        {spread->steps, sizeof *spread->steps},
        {spread->moments, spread->side * spread->side * AUR_SPREAD_MOMENTS * sizeof *spread->moments}};
    for (size_t p = 0; p < sizeof cells / sizeof cells[0]; ++p)
        if (cells[p].data != NULL)
            move(bytes, spread->tile_cells * cells[p].size,
                 (char *)cells[p].data + index * spread->tile_cells * cells[p].size);
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
