/* The door for the tools of this tree: what the bench and the makers of the bundled scenes use of the
 * libraries' inside, beside <aureole/...>. They include this header and no other one of src. It is installed
 * nowhere, and what it shows may change at any time. Functions of core can be called as they are; those of
 * other rooms where AUR_EXPERIMENTAL stands before them, else the linker does not find them. What a public
 * header offers is used by that: here stands only what the bench replays or takes apart (rays, tiles,
 * packets, photons, a kernel's row) and what it shares with the libraries (hashes, vectors, threads,
 * instruction sets).
 */
#pragma once

#include "core/cache.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/simd.h"
#include "core/vector.h"
#include "pointset/net_2d.h"
#include "quadrature/kernel.h"
#include "scene/embree.h"
#include "scene/scene.h"
#include "transport/integrator.h"
#include "transport/occlusion/rays.h"
#include "transport/photons/irradiance.h"
