/* The sets of the square and the cube, in the order of listings: one line for each file of a generator, which
 * defines aur_set_<name>. */
#pragma once

#include "points/pointset/set.h"

#define AUR_SQUARE_SETS(ROW)                                                                                 \
    ROW(random)                                                                                              \
    ROW(lcg)                                                                                                 \
    ROW(icg)                                                                                                 \
    ROW(jittered)                                                                                            \
    ROW(van_der_corput)                                                                                      \
    ROW(halton)                                                                                              \
    ROW(hammersley)                                                                                          \
    ROW(faure)                                                                                               \
    ROW(sobol)                                                                                               \
    ROW(interlaced)                                                                                          \
    ROW(cascaded)                                                                                            \
    ROW(niederreiter)                                                                                        \
    ROW(larcher_pillichshammer)                                                                              \
    ROW(pmj02)                                                                                               \
    ROW(matrices)                                                                                            \
    ROW(fibonacci_lattice)                                                                                   \
    ROW(rank1)                                                                                               \
    ROW(cbc)                                                                                                 \
    ROW(korobov)                                                                                             \
    ROW(r2)                                                                                                  \
    ROW(golden)                                                                                              \
    ROW(golden_set)                                                                                          \
    ROW(blue_noise)                                                                                          \
    ROW(bnot)                                                                                                \
    ROW(sliced)                                                                                              \
    ROW(owen_tree)                                                                                           \
    ROW(file)

#define AUR_DECLARE_SQUARE_SET(name) extern const aur_square_set aur_set_##name;
AUR_SQUARE_SETS(AUR_DECLARE_SQUARE_SET)
#undef AUR_DECLARE_SQUARE_SET
