#include "room.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

#include "points/base/random.h"

static double draw(bench_room *self, double low, double high) {
    const uint64_t hash = aur_hash2(self->seed, self->drawn++);
    return low + (high - low) * (double)aur_unit_float((uint32_t)hash);
}

static void put(bench_room *self, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    self->used +=
        (size_t)vsnprintf(self->text + self->used, sizeof self->text - self->used, format, arguments);
    va_end(arguments);
}

static void put_matte(bench_room *self) {
    put(self,
        "<bsdf type='twosided'><bsdf type='diffuse'><rgb name='reflectance' value='%.3f %.3f "
        "%.3f'/></bsdf></bsdf>",
        draw(self, 0.2, 0.8), draw(self, 0.2, 0.8), draw(self, 0.2, 0.8));
}

static void put_box(bench_room *self) {
    const double x = draw(self, -0.8, 0.8), y = draw(self, -0.3, 0.8), side = draw(self, 0.08, 0.25);
    put(self,
        "<shape type='cube'><transform name='to_world'><scale value='%.3f'/><rotate z='1' angle='%.1f'/>"
        "<translate x='%.3f' y='%.3f' z='%.3f'/></transform>",
        side, draw(self, 0.0, 90.0), x, y, side - 0.98);
    if (draw(self, 0.0, 1.0) < 0.2)
        put(self, "<bsdf type='conductor'/>");
    else
        put_matte(self);
    put(self, "</shape>");
}

/* One to sixteen light sources on the ceiling or at random positions, or a window to a bright sky. */
void bench_room_make(uint64_t seed, bench_room *self) {
    *self = (bench_room){.seed = seed};
    const bool window = seed % 3 == 0;
    put(self,
        "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'><float name='fov' "
        "value='75'/>"
        "<transform name='to_world'><lookat origin='0,-.95,0' target='0,1,-.3' up='0,0,1'/></transform><film "
        "type='hdrfilm'><rfilter type='box'/></film></sensor>");
    for (int wall = 0; wall < 6; ++wall) {
        static const char *const turns[] = {"",
                                            "<rotate x='1' angle='180'/>",
                                            "<rotate x='1' angle='90'/>",
                                            "<rotate x='1' angle='-90'/>",
                                            "<rotate y='1' angle='90'/>",
                                            "<rotate y='1' angle='-90'/>"};
        const double size = window && wall == 5 ? 0.6 : 1.0; /* leaves a gap around it */
        put(self,
            "<shape type='rectangle'><transform name='to_world'><scale value='%.2f'/><translate z='-1'/>%s"
            "</transform>",
            size, turns[wall]);
        put_matte(self);
        put(self, "</shape>");
    }
    for (int i = 0; i < 6; ++i)
        put_box(self);
    if (window)
        put(self, "<emitter type='constant'><rgb name='radiance' value='10'/></emitter>");
    const int lights = window ? 0 : 1 << (int)draw(self, 0.0, 4.99);
    for (int i = 0; i < lights; ++i)
        put(self,
            "<shape type='rectangle'><transform name='to_world'><scale value='%.3f'/><rotate x='1' "
            "angle='180'/>"
            "<translate x='%.3f' y='%.3f' z='%.3f'/></transform><emitter type='area'><rgb name='radiance' "
            "value='%.1f'/></emitter></shape>",
            draw(self, 0.02, 0.2), draw(self, -0.8, 0.8), draw(self, -0.8, 0.8), draw(self, -0.2, 0.98),
            draw(self, 5.0, 50.0));
    put(self, "</scene>");
}
