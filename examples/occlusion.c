/* Ambient occlusion with rays of Embree's and directions of ours: how much of the sky a point on the ground
 * sees below a sphere.
 *
 *     cc examples/occlusion.c -laureole -lembree3 -lm -o occlusion && ./occlusion 256
 *
 * Directions follow the cosine about the normal, so that the open share is the mean. Straight below a sphere
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

static RTCScene sphere_above(RTCDevice device, float height, float radius) {
    RTCScene scene = rtcNewScene(device);
    RTCGeometry sphere = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    float *const where =
        rtcSetNewGeometryBuffer(sphere, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof *where, 1);
    where[0] = where[1] = 0.0f;
    where[2] = height;
    where[3] = radius;
    rtcCommitGeometry(sphere);
    rtcAttachGeometry(scene, sphere);
    rtcReleaseGeometry(sphere);
    rtcCommitScene(scene);
    return scene;
}

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
    aur_directions_options options = aur_directions_options_default(count, AUR_DOMAIN_HEMISPHERE);
    options.lobe.exponent = 1.0;
    aur_directions *directions = NULL;
    aur_error error;
    double *const xyz = malloc(3 * count * sizeof *xyz), seen = 0.0;
    if (xyz == NULL || aur_directions_create(set, &options, &directions, &error) != AUR_OK ||
        aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, &error) != AUR_OK)
        return NAN;
    for (size_t i = 0; i < count; ++i)
        seen += is_open(scene, xyz + 3 * i);
    aur_directions_destroy(directions);
    free(xyz);
    return seen / (double)count;
}

int main(int argc, char **argv) {
    const size_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 256;
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = sphere_above(device, 2.0f, 1.0f);
    printf("open %g of 0.75, by random directions %g\n", open_share(scene, "spherical-fibonacci", count),
           open_share(scene, "random", count));
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return 0;
}
