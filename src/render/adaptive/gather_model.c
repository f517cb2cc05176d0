#include "render/adaptive/gather_model.h"

#include <math.h>

/* A ray to a point on a light takes about so much of the time of the others, with what is shaded for them:
 * .5 in the public Cornell box and in the room. */
static const double LIGHT_PRICE = 0.5;
/* With points on bright texels, which rays do not tell: their draws, which took 15 % of the time and 5 % of
 * the rays in the public Cornell box, and more where triangles are small. */
static const double BRIGHT_PRICE = 1.1;
/* The square of a pattern's error falls nearly as its size to this power: patterns of 4 to 160 directions had
 * .8 to 1.2 of the noise that might be left, in boxes, the cube and the office. It falls more slowly where
 * the light comes from small places, as in rooms of lamps and blinds, by a power that is chosen between that
 * and 1. And so do points on lights at least, up to a number that sees them all. */
static const double POWER = 1.5, POWER_OF_PLACES = 1.25;
/* Of a pilot's square, what each part has at least. */
static const double LEAST_PART = 0.05;

static double square_of(const aur_gather_pilots *pilots, size_t pilot) {
    const double error = pilots->of[pilot].error;
    return error * error;
}

static bool is_there(const aur_gather_pilots *pilots, size_t pilot) {
    return pilots->of[pilot].rays > 0.0;
}

size_t aur_gather_last_pilot(const aur_gather_pilots *pilots) {
    const size_t more = is_there(pilots, AUR_PILOT_MORE) ? AUR_PILOT_MORE : AUR_PILOT_FEW;
    return is_there(pilots, AUR_PILOT_MOST) ? AUR_PILOT_MOST : more;
}

/* Rays of one point on lights. */
static double light_rays(const aur_gather_pilots *pilots) {
    static const double lights[] = {INFINITY, AUR_PILOT_LIGHTS_MORE, AUR_PILOT_LIGHTS_MOST};
    const size_t last = aur_gather_last_pilot(pilots);
    const double more = fmax(pilots->of[last].rays - pilots->of[AUR_PILOT_FEW].rays, 0.0);
    return more / (lights[last] - AUR_PILOT_LIGHTS);
}

/* What is left at x points of what y = growth x points change by, falling as points^-POWER. */
static double left_by_model(double square_x, double square_y, double growth) {
    return fmax(square_x - square_y, 0.0) / (1.0 - pow(growth, -POWER));
}

/* With the most points hardly any noise is left: 128 in place of 32 took 0 to 25 % off the square in six
 * rooms of bench/peers/rooms.py, less than the law says. */
static void tell_lights(const aur_gather_pilots *pilots, double camera, aur_gather_model *model) {
    const double growth = (double)AUR_PILOT_LIGHTS_MORE / AUR_PILOT_LIGHTS;
    const double last_growth = (double)AUR_PILOT_LIGHTS_MOST / AUR_PILOT_LIGHTS_MORE;
    const double most_left = 0.25, most_left_unseen = 0.5;
    const double few = square_of(pilots, AUR_PILOT_FEW), more = square_of(pilots, AUR_PILOT_MORE),
                 most = square_of(pilots, AUR_PILOT_MOST);
    if (!is_there(pilots, AUR_PILOT_MORE))
        return;
    if (!is_there(pilots, AUR_PILOT_MOST)) {
        model->lights[0] = left_by_model(few, more, growth);
        model->lights[1] = fmin(model->lights[0] * pow(growth, -POWER), most_left_unseen * more);
        model->lights[2] = model->lights[1] * pow(last_growth, -POWER);
        return;
    }
    model->lights[2] = fmin(left_by_model(more, most, last_growth) * pow(last_growth, -POWER),
                            most_left * fmax(most - camera, 0.0));
    model->lights[1] = fmax(more - most, 0.0) + model->lights[2];
    model->lights[0] = fmax(few - more, 0.0) + model->lights[1];
}

/* Between two numbers of points, as a power. */
static double between(double few, double square_few, double more, double square_more, double lights) {
    const double power = log(square_few / square_more) / log(more / few);
    return square_few * pow(lights / few, -power);
}

double aur_gather_model_lights(const aur_gather_model *model, double lights) {
    const double least = 1e-6 * model->lights[0];
    const double more = fmax(model->lights[1], least), most = fmax(model->lights[2], least);
    if (!(model->lights[0] > 0.0))
        return 0.0;
    if (lights <= AUR_PILOT_LIGHTS_MORE)
        return between(AUR_PILOT_LIGHTS, model->lights[0], AUR_PILOT_LIGHTS_MORE, more, lights);
    if (lights <= AUR_PILOT_LIGHTS_MOST)
        return between(AUR_PILOT_LIGHTS_MORE, more, AUR_PILOT_LIGHTS_MOST, most, lights);
    return most * pow(lights / AUR_PILOT_LIGHTS_MOST, -POWER);
}

/* The camera's part is that which pilots through the centres of pixels lack. */
static aur_gather_model plain_model(const aur_gather_pilots *pilots) {
    const double last = square_of(pilots, aur_gather_last_pilot(pilots)), price = light_rays(pilots);
    const double camera =
        is_there(pilots, AUR_PILOT_CENTRE) ? fmax(last - square_of(pilots, AUR_PILOT_CENTRE), 0.0) : 0.0;
    const double others = fmax(pilots->of[AUR_PILOT_FEW].rays - AUR_PILOT_LIGHTS * price, 0.0);
    /* Rays at edges are in none of these. The parts are chosen: together they are what the pilot's own
     * pattern takes, to which the camera's rays and those of mirrors come once. */
    aur_gather_model model = {.power = is_there(pilots, AUR_PILOT_MOST) ? POWER_OF_PLACES : POWER,
                              .fixed = 0.2 * others,
                              .direction = 0.8 * others / AUR_PILOT_DIRECTIONS,
                              .light = LIGHT_PRICE * price,
                              .alone = pilots->alone};
    tell_lights(pilots, camera, &model);
    const double rest = camera + model.lights[aur_gather_last_pilot(pilots)];
    model.gather = fmax(last - rest, LEAST_PART * last);
    model.camera = camera / pilots->side; /* pixels have it along lines, of which smaller ones see less */
    return model;
}

/* Pilots see less of what bright texels bring than whole pictures, which have fewer edges: they left .88 of
 * the error in the public Cornell box and .92 in the room, whole pictures with 64 directions .64 and .76. So
 * the choice goes by about the square of what is seen; how many directions it takes does not, which would
 * often be too few. */
aur_gather_model aur_gather_model_of(const aur_gather_pilots *pilots) {
    const aur_gather_model plain = plain_model(pilots);
    if (!is_there(pilots, AUR_PILOT_DRAWN))
        return plain;
    const double last = square_of(pilots, aur_gather_last_pilot(pilots)),
                 change = square_of(pilots, AUR_PILOT_DRAWN) - last;
    aur_gather_model drawn = plain;
    drawn.gather = fmax(plain.gather + change, LEAST_PART * last);
    drawn.bright = (double)AUR_PILOT_BRIGHT / AUR_PILOT_DIRECTIONS;
    const double draws =
        fmax(pilots->of[AUR_PILOT_DRAWN].rays - pilots->of[aur_gather_last_pilot(pilots)].rays, 0.0);
    drawn.fixed += 0.2 * draws;
    drawn.direction += 0.8 * draws / AUR_PILOT_DIRECTIONS;
    const double seen = fmin(drawn.gather / plain.gather, 1.0), power = 1.0 / plain.power;
    return BRIGHT_PRICE * drawn.direction * pow(seen, 2.0 * power) < plain.direction ? drawn : plain;
}

aur_gather_pattern aur_gather_model_pattern(const aur_gather_model *model, const aur_gather_target *target) {
    enum { MOST_LIGHTS = 1 << 14 };
    const double least_rest = 0.1;
    const double noise =
        target->noise - fmin(model->camera / target->samples, target->most_camera * target->noise);
    aur_gather_pattern best = {.rays = INFINITY};
    for (double lights = 1.0; lights <= MOST_LIGHTS; lights *= 2.0) {
        const double rest = noise - aur_gather_model_lights(model, lights);
        if (rest < least_rest * noise && lights < MOST_LIGHTS)
            continue;
        const double part = model->gather / fmax(rest, least_rest * noise);
        const double directions = target->factor * AUR_PILOT_DIRECTIONS * pow(part, 1.0 / model->power);
        const double rays = model->fixed + model->direction * directions + model->light * lights;
        if (rays < best.rays)
            best = (aur_gather_pattern){directions, lights, rays};
    }
    return best;
}
