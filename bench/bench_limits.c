/* The limits of the machine, each next to a plainer or slower way to do the same. */
#include "limits.h"

static bool run(const bench_options *options) {
    static const bench_limit_pair pairs[] = {
        {&bench_limit_fill_memory_stream, &bench_limit_fill_memory},
        {&bench_limit_copy_memory_stream, &bench_limit_copy_memory},
        {&bench_limit_read_cache, &bench_limit_read_memory},
        {&bench_limit_fill_cache, &bench_limit_fill_memory},
        {&bench_limit_fma_f32, &bench_limit_fma_f64},
        {&bench_limit_pairs_f32, &bench_limit_pairs_f64},
        {&bench_limit_rays_box_primary_packet, &bench_limit_rays_box_primary},
        {&bench_limit_rays_box_secondary_packet, &bench_limit_rays_box_secondary},
        {&bench_limit_rays_box_occluded_packet, &bench_limit_rays_box_occluded},
        {&bench_limit_rays_bumpy_primary_packet, &bench_limit_rays_bumpy_primary},
        {&bench_limit_rays_bumpy_secondary_packet, &bench_limit_rays_bumpy_secondary},
        {&bench_limit_rays_bumpy_occluded_packet, &bench_limit_rays_bumpy_occluded},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i)
        if (!bench_limit_compare(options, &pairs[i]))
            return false;
    return true;
}

const bench bench_limits = {"limits", "what one core can do: memory, arithmetic, bare Embree rays", run};
