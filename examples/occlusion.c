/* Ambient occlusion by Embree's rays and our directions: how much of the sky is open straight below a sphere.
 *
 *     cc examples/occlusion.c -laureole -lembree3 -lm -o occlusion && ./occlusion 256
 *
 * Directions follow the cosine about the normal, so that the open share is the mean. Below a sphere
 * of radius r at the height h it is 1 - (r/h)^2; prints it beside what as many random directions find. */
#include <aureole/sphere.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int is_open(RTCScene scene, const double u[3]) {
    struct RTCRay ray = {
        .dir_x = (float)u[0], .dir_y = (float)u[1], .dir_z = (float)u[2], .tfar = INFINITY, .mask = ~0u};
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray, NULL);
#else
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar > 0.0f; /* Embree makes it negative where something is hit */
}

static double open_share(RTCScene scene, const char *set, size_t count) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.lobe.exponent = 1.0;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    aur_points *points;
    double seen = 0.0;
    if (aur_points_generate(set, &request, &points, NULL) != AUR_OK)
        return NAN;
    for (size_t i = 0; i < count; ++i)
        seen += is_open(scene, aur_points_get_view(points)->coordinates + 3 * i);
    aur_points_destroy(points);
    return seen / (double)count;
}

int main(int argc, char **argv) {
    const size_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 256;
    static const float sphere[4] = {0.0f, 0.0f, 2.0f, 1.0f}; /* centre and radius */
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sphere, 0,
                               sizeof sphere, 1);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    printf("open %g of 0.75, by random directions %g\n", open_share(scene, "spherical-fibonacci", count),
           open_share(scene, "random", count));
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
