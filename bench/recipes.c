/* Parameters for a target error, found by experiment. One line per error and subject. */
#include "quality.h"

const bench_recipe bench_recipes[] = {
    {"cornell-box", 0.01, 0.10, 1,
     "finalgather:photons=5000,diffuse_samples=2,edges=60,light_samples=2,share=true,short_rays=0"},
    {"cornell-box", 0.005, 0.20, 1,
     "finalgather:photons=14000,diffuse_samples=4,edges=192,light_samples=4,share=true,short_rays=0"},
    {"cornell-box", 0.002, 0.70, 2,
     "finalgather:photons=120000,photons_per_texel=24,diffuse_samples=22,edges=1000,light_samples=7,share="
     "true,short_rays=0"},
    {"cornell-box", 0.0015, -1.0, 64, "finalgather:photons=2000000,diffuse_samples=1024,edges=4096"},
    {"heavy-box", 0.005, 0.0, 4,
     "finalgather:photons=20000,diffuse_samples=20,edges=384,light_samples=2,share=true,short_rays=0"},
    {"glossy-box", 0.02, 0.0, 4,
     "finalgather:photons=50000,photons_per_texel=32,diffuse_samples=8,glossy_samples=4,edges=512,"
     "light_samples=4,share=true,short_rays=0"},
    {"glossy-box", 0.005, 0.0, 104,
     "finalgather:photons=3000000,diffuse_samples=208,glossy_samples=104,edges=6656,light_samples=6,share="
     "true,short_rays=0"},
    {"room", 0.02, 0.0, 128,
     "finalgather:photons=8000000,diffuse_samples=256,glossy_samples=128,edges=1024,bright_samples=256,"
     "light_samples=8,share=true"},
    {"statue", 0.01, 0.0, 3200, "path:interleaved=true,rr_depth=4,candidates=2"},
    {"sphere", 0.01, 0.0, 720, "path:interleaved=true,rr_depth=4,candidates=2"},
};

const size_t bench_recipe_count = sizeof bench_recipes / sizeof bench_recipes[0];
