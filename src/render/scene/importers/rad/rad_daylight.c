/* Built-in equivalents of gendaylit and gensky, for skies whose brightness the command states. */
#include <math.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

static const double PI = 3.14159265358979323846;

typedef struct command {
    const char *name;
    bool perez, sun, visible;
    char sky; /* gensky: c or u, overcast or uniform; 0: neither */
    bool placed, scaled;
    double angles[2], irradiances[2], albedo;
} command;

/* Parses `count` numbers after the option at *at. */
static bool read_numbers(size_t word_count, const aur_rad_word *words, size_t *at, size_t count,
                         double *numbers) {
    for (size_t i = 0; i < count; ++i)
        if (++*at >= word_count || !aur_rad_number(words[*at], &numbers[i]))
            return false;
    return true;
}

static bool read_option(command *c, size_t count, const aur_rad_word *words, size_t *at) {
    const aur_rad_word word = words[*at];
    double output = 0.0;
    if (aur_rad_is_word(word, "-ang"))
        return c->placed = read_numbers(count, words, at, 2, c->angles);
    if (aur_rad_is_word(word, "-g"))
        return read_numbers(count, words, at, 1, &c->albedo) && c->albedo >= 0.0 && c->albedo <= 1.0;
    if (c->perez && aur_rad_is_word(word, "-s"))
        return !(c->sun = false);
    if (c->perez && aur_rad_is_word(word, "-w"))
        return true;
    if (c->perez && (aur_rad_is_word(word, "-W") || aur_rad_is_word(word, "-G"))) {
        c->scaled = read_numbers(count, words, at, 2, c->irradiances);
        if (word.text[1] == 'G')
            c->irradiances[0] /= sin(c->angles[0] * PI / 180.0);
        return c->scaled && (word.text[1] == 'W' || c->placed);
    }
    if (c->perez && aur_rad_is_word(word, "-O")) {
        c->visible = !(read_numbers(count, words, at, 1, &output) && output == 1.0);
        return output == 0.0 || output == 1.0;
    }
    if (!c->perez && (aur_rad_is_word(word, "-c") || aur_rad_is_word(word, "-u"))) {
        c->sky = word.text[1];
        return true;
    }
    return !c->perez && aur_rad_is_word(word, "-B") &&
           (c->scaled = read_numbers(count, words, at, 1, c->irradiances + 1));
}

/* The sun's disk of gendaylit, as it prints it. */
static aur_result add_sun(aur_rad *self, const command *c, const double sun[3]) {
    double world[3];
    memcpy(world, sun, sizeof world);
    aur_rad_pose_apply(&self->pose, 0.0, world);
    const double facing[3] = {c->irradiances[0], c->irradiances[0], c->irradiances[0]};
    aur_xml_node *const node = aur_node_object(self->nodes, self->parent, "emitter", "sun");
    aur_node_numbers(self->nodes, node, "vector", "sun_direction", 3, world);
    aur_node_numbers(self->nodes, node, "rgb", "irradiance", 3, facing);
    return self->nodes->result;
}

aur_result aur_rad_read_daylight(aur_rad *self, size_t count, const aur_rad_word *words,
                                 aur_rad_material *material) {
    command c = {
        .perez = aur_rad_is_word(words[0], "gendaylit"), .sun = true, .visible = true, .albedo = 0.2};
    c.name = c.perez ? "gendaylit" : "gensky";
    for (size_t i = 1; i < count; ++i) {
        const aur_rad_word word = words[i];
        if (!read_option(&c, count, words, &i))
            return aur_rad_fail(self, word.line, AUR_ERROR_UNSUPPORTED,
                                "%s: '%.*s' is not read: %s expected, or the output of the command in a file",
                                c.name, word.length > 40 ? 40 : (int)word.length, word.text,
                                c.perez ? "-ang, then -W or -G, -O 1, -g, -s and -w"
                                        : "-c or -u, -B, -ang and -g");
    }
    const double diffuse = c.irradiances[1], direct = c.irradiances[0];
    if (!c.scaled || (c.perez ? !c.placed || c.visible : c.sky == '\0'))
        return aur_rad_fail(self, words[0].line, AUR_ERROR_UNSUPPORTED,
                            "%s: %s expected, or the output of the command in a file", c.name,
                            c.perez ? "-ang ALTITUDE AZIMUTH, -W DIRECT DIFFUSE and -O 1"
                                    : "-c or -u and -B IRRADIANCE");
    if (!(diffuse > 0.0 && diffuse < 2000.0 && direct >= 0.0 && direct < 2000.0) ||
        (c.perez && !(c.angles[0] > 0.0 && c.angles[0] <= 90.0)))
        return aur_rad_fail(self, words[0].line, AUR_ERROR_FORMAT,
                            "%s: irradiances below 2000 W/m2, the sky's above 0, and a sun above the horizon "
                            "expected",
                            c.name);
    const double altitude = c.angles[0] * PI / 180.0, azimuth = c.angles[1] * PI / 180.0;
    const double sun[3] = {-sin(azimuth) * cos(altitude), -cos(azimuth) * cos(altitude), sin(altitude)};
    aur_rad_sky *const sky = material->sky = aur_arena_allocate(self->scene->arena, sizeof *sky);
    if (sky == NULL)
        return aur_fail_memory(self->error);
    const double horizontal = diffuse + (c.perez ? direct * sun[2] : 0.0);
    *sky = (aur_rad_sky){.perez = c.perez, .by_irradiance = c.perez};
    const double numbers[10] = {c.perez        ? direct
                                : c.sky == 'c' ? 2.0
                                               : 3.0,
                                c.perez        ? diffuse
                                : c.sky == 'c' ? diffuse * 9.0 / (7.0 * PI)
                                               : diffuse / PI,
                                c.albedo * horizontal / PI,
                                0.0,
                                0.0,
                                0.0,
                                0.0,
                                sun[0],
                                sun[1],
                                sun[2]};
    memcpy(sky->numbers, numbers, sizeof numbers);
    return c.perez && c.sun && direct > 0.0 ? add_sun(self, &c, sun) : AUR_OK;
}
