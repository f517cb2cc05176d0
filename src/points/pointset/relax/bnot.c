/* Blue noise through optimal transport (de Goes, Breeden, Ostromoukhov, Desbrun 2012), periodic: points at
 * the centres of cells of equal area. The number of rounds is fixed and small: a full minimisation ends in
 * crystalline patches, which the paper breaks up by jitter. A table: n up to 2^20. Error about N^-3/4 and
 * lower for smooth functions; no alignments. */
#include "points/pointset/relax/relaxation.h"

enum { VERSION = 2, ROUNDS = 30 };

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    return aur_transport_relax(seed, ROUNDS, count, sites, error);
}

const aur_square_set aur_set_bnot = {
    .description = {.row = {.name = "bnot",
                            .summary = "blue noise through optimal transport, periodic",
                            .source = "de Goes, Breeden, Ostromoukhov, Desbrun 2012"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = 1 << 20},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .kind_data = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};
