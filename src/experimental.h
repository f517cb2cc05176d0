/* The door for the tools of this tree: what the bench and the makers of the bundled scenes use of the
 * libraries' inside, beside <aureole/...>. They include this header and no other one of src. It is installed
 * nowhere, and what it shows may change at any time. Functions of core can be called as they are; those of
 * other rooms where AUR_EXPERIMENTAL stands before them, else the linker does not find them. What a public
 * header offers is used by that: here stands only what the bench replays or takes apart (rays, tiles,
 * packets, photons, a kernel's row) and what it shares with the libraries (hashes, vectors, threads,
 * instruction sets).
 */
#pragma once

#include "points/base/cache.h"
#include "points/base/parallel.h"
#include "points/base/random.h"
#include "points/base/simd.h"
#include "points/base/vector.h"
#include "points/pointset/net_2d.h"
#include "points/quadrature/kernel.h"
#include "render/film/integrator.h"
#include "render/occlusion/rays.h"
#include "render/photons/irradiance.h"
#include "render/scene/embree.h"
#include "render/scene/scene.h"
