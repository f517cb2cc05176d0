/* Pooled irradiance: one joint pattern is split among the pixels of a 4 x 4 block, the same way in all
 * blocks, and what they gathered is pooled where they see one surface (a discontinuity buffer: Wald, Benthin,
 * Slusallek, Keller 2002).
 *
 * A pixel's pool is the window of 5 x 5 pixels about it whose outer rows and columns count half. Like every
 * 4 x 4 window it has each part of the pattern once, and its middle is the pixel: light that changes linearly
 * over it is not blurred. Windows at the tile's rim are 4 wide and lie beside their pixel. */
#pragma once

#include "transport/gather/strata.h"

/* Adds to every stratum of a tile, AUR_TILE_PIXELS row by row, its diffuse light by the irradiance that
 * neighbouring pixels pool. False: out of memory. */
bool aur_gather_pool_irradiance(aur_pixel_strata *strata);
