/* View files of Radiance (.vf): a camera. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

enum { SIDE = 768 }; /* image size along its longer side, in pixels */

static const double DEGREE = 3.14159265358979323846 / 180.0;

typedef struct view {
    double position[3], direction[3], up[3], across[2], clips[2];
} view;

static bool begins_view(aur_rad_word word) {
    static const char *const words[] = {"VIEW=", "rvu", "rview", "rpict"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i)
        if (aur_rad_is_word(word, words[i]))
            return true;
    return word.length >= 3 && strncmp(word.text, "-vt", 3) == 0;
}

bool aur_rad_is_view(size_t size, const char *data) {
    aur_rad self = {.at = data, .end = data + size, .line = 1};
    aur_rad_word word;
    return aur_rad_next_word(&self, &word) && begins_view(word);
}

/* Options with numeric arguments, and the fields that store them. */
static aur_result read_option(aur_rad *self, aur_rad_word option, view *parsed) {
    double ignored[1];
    const struct {
        const char *name;
        size_t count;
        double *numbers;
    } rows[] = {{"-vp", 3, parsed->position},
                {"-vd", 3, parsed->direction},
                {"-vu", 3, parsed->up},
                {"-vh", 1, parsed->across},
                {"-vv", 1, parsed->across + 1},
                {"-vo", 1, parsed->clips},
                {"-va", 1, parsed->clips + 1},
                {"-vs", 1, ignored},
                {"-vl", 1, ignored}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (!aur_rad_is_word(option, rows[i].name))
            continue;
        for (size_t k = 0; k < rows[i].count; ++k) {
            aur_rad_word word;
            if (!aur_rad_next_word(self, &word) || !aur_rad_number(word, &rows[i].numbers[k]))
                return aur_rad_fail(self, option.line, AUR_ERROR_FORMAT,
                                    "view: %zu numbers expected after '%s'", rows[i].count, rows[i].name);
        }
        return rows[i].numbers != ignored || ignored[0] == 0.0
                   ? AUR_OK
                   : aur_rad_fail(self, option.line, AUR_ERROR_UNSUPPORTED,
                                  "view: a view that is shifted (%s %g) is not read", rows[i].name,
                                  ignored[0]);
    }
    /* Other words belong to rvu and its images, such as -x 512. */
    return option.length == 4 && strncmp(option.text, "-vt", 3) == 0 && option.text[3] != 'v'
               ? aur_rad_fail(self, option.line, AUR_ERROR_UNSUPPORTED,
                              "view: only perspective views (-vtv) are read, not '%.*s'", (int)option.length,
                              option.text)
               : AUR_OK;
}

static aur_result add_sensor(aur_rad *self, view *parsed) {
    aur_nodes *const nodes = self->nodes;
    const double width = tan(0.5 * DEGREE * parsed->across[0]),
                 height = tan(0.5 * DEGREE * parsed->across[1]);
    double target[3];
    if (!(aur_normalize3(parsed->direction) > 0.0) || !(aur_normalize3(parsed->up) > 0.0))
        return aur_rad_fail(self, self->line, AUR_ERROR_FORMAT, "view: -vd and -vu must not be 0");
    for (size_t i = 0; i < 2; ++i)
        if (!(parsed->across[i] > 0.0 && parsed->across[i] < 180.0))
            return aur_rad_fail(self, self->line, AUR_ERROR_FORMAT,
                                "view: -vh and -vv must be from 0 to 180 degrees");
    for (size_t i = 0; i < 3; ++i)
        target[i] = parsed->position[i] + parsed->direction[i];
    aur_xml_node *const sensor = aur_node_object(nodes, self->parent, "sensor", "perspective");
    aur_node_property(nodes, sensor, "float", "fov", "%.17g", parsed->across[0]);
    aur_node_property(nodes, sensor, "string", "fov_axis", "x");
    if (parsed->clips[0] > 0.0)
        aur_node_property(nodes, sensor, "float", "near_clip", "%.17g", parsed->clips[0]);
    if (parsed->clips[1] > 0.0)
        aur_node_property(nodes, sensor, "float", "far_clip", "%.17g", parsed->clips[1]);
    aur_xml_node *const to_world = aur_node_add(nodes, sensor, "transform");
    aur_node_set(nodes, to_world, "name", "to_world");
    aur_xml_node *const lookat = aur_node_add(nodes, to_world, "lookat");
    aur_node_set_numbers(nodes, lookat, "origin", 3, parsed->position);
    aur_node_set_numbers(nodes, lookat, "target", 3, target);
    aur_node_set_numbers(nodes, lookat, "up", 3, parsed->up);
    aur_xml_node *const film = aur_node_object(nodes, sensor, "film", "hdrfilm");
    const double longer = fmax(width, height);
    aur_node_property(nodes, film, "integer", "width", "%d", (int)fmax(SIDE * width / longer + 0.5, 1.0));
    aur_node_property(nodes, film, "integer", "height", "%d", (int)fmax(SIDE * height / longer + 0.5, 1.0));
    return nodes->result;
}

aur_result aur_rad_read_view(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data) {
    /* Adds a zero byte, which terminates numbers. */
    char *const text = malloc(size + 1);
    if (text == NULL)
        return aur_fail_memory(nodes->error);
    memcpy(text, data, size);
    text[size] = '\0';
    aur_rad self = {
        .nodes = nodes, .parent = parent, .at = text, .end = text + size, .line = 1, .error = nodes->error};
    view parsed = {.direction = {0.0, 1.0, 0.0}, .up = {0.0, 0.0, 1.0}, .across = {45.0, 45.0}};
    aur_result result = AUR_OK;
    for (aur_rad_word word; result == AUR_OK && aur_rad_next_word(&self, &word);)
        result = read_option(&self, word, &parsed);
    nodes->location.line = 1;
    if (result == AUR_OK)
        result = add_sensor(&self, &parsed);
    free(text);
    return result;
}
