/* Blue noise by capacity-constrained Voronoi tessellation (Balzer, Schloemer, Deussen 2009), periodic: each
 * site has an equal part of the area and is near its centre. The paper distributes points of a fine uniform
 * set to the sites and swaps them while that reduces the sum of squared distances; this is the limit of
 * infinitely many such points, where the parts are the cells of a power diagram. The number of rounds makes
 * the sites as regular as in the paper: less than in bnot. A table: n up to 2^20. Error about N^-3/4 and
 * lower for smooth functions; no alignments. */
#include "points/pointset/relax/relaxation.h"

enum { VERSION = 2, ROUNDS = 8 };

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    return aur_transport_relax(aur_hash2(seed, 1), ROUNDS, count, sites, error);
}

const aur_square_set aur_set_blue_noise = {
    .description = {.row = {.name = "blue-noise",
                            .summary = "capacity-constrained Voronoi tessellation, periodic",
                            .source = "Balzer, Schloemer, Deussen 2009"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = 1 << 20},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .kind_data = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};
