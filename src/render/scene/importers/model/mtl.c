#include "render/scene/importers/model/mtl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/array.h"
#include "render/scene/importers/meshes/text_scanner.h"

/* --- materials */

aur_mtl_material *aur_mtl_add(aur_mtl_library *library, const char *name, size_t length) {
    char *const copy = strndup(name, length);
    if (copy == NULL || !aur_array_reserve(&library->materials, &library->capacity, library->count + 1,
                                           sizeof *library->materials)) {
        free(copy);
        return NULL;
    }
    aur_mtl_material *const added = &library->materials[library->count++];
    *added = (aur_mtl_material){.name = copy,
                                .diffuse = {NAN, NAN, NAN},
                                .specular = {NAN, NAN, NAN},
                                .emission = {NAN, NAN, NAN},
                                .shininess = NAN,
                                .opacity = NAN,
                                .roughness = NAN,
                                .metal = NAN};
    return added;
}

aur_mtl_material *aur_mtl_find(const aur_mtl_library *library, const char *name) {
    for (size_t i = 0; i < library->count; ++i)
        if (strcmp(library->materials[i].name, name) == 0)
            return &library->materials[i];
    return NULL;
}

void aur_mtl_release(aur_mtl_library *library) {
    for (size_t i = 0; i < library->count; ++i) {
        free(library->materials[i].name);
        for (size_t map = 0; map < AUR_MTL_MAP_COUNT; ++map)
            free(library->materials[i].images[map].name);
    }
    free(library->materials);
    *library = (aur_mtl_library){0};
}

/* --- lines */

static bool is_word(aur_word word, const char *name) {
    return strlen(name) == word.length && strncasecmp(word.text, name, word.length) == 0;
}

static void read_number(aur_scanner *scanner, double *value) {
    double number;
    if (aur_scan_double(scanner, &number) && fabs(number) <= 1e30)
        *value = number;
}

/* A single number is grey. */
static void read_color(aur_scanner *scanner, double color[3]) {
    double values[3];
    size_t count = 0;
    while (count < 3 && aur_scan_double(scanner, &values[count]) && fabs(values[count]) <= 1e30)
        ++count;
    for (size_t i = 0; count > 0 && i < 3; ++i)
        color[i] = fmax(values[count == 3 ? i : 0], 0.0);
}

/* Skips an option of a map, which begins with a minus, and its values. */
static void skip_option(aur_scanner *scanner, aur_mtl_image *image) {
    static const struct {
        const char *name;
        size_t words, numbers; /* maximum count of numbers */
    } options[] = {{"-o", 0, 3},       {"-s", 0, 3},      {"-t", 0, 3},   {"-mm", 0, 2}, {"-blendu", 1, 0},
                   {"-blendv", 1, 0},  {"-boost", 0, 1},  {"-bm", 0, 1},  {"-cc", 1, 0}, {"-clamp", 1, 0},
                   {"-imfchan", 1, 0}, {"-texres", 1, 0}, {"-type", 1, 0}};
    const aur_word name = aur_scan_word(scanner);
    for (size_t i = 0; i < sizeof options / sizeof options[0]; ++i) {
        if (!is_word(name, options[i].name))
            continue;
        if (options[i].words > 0 && is_word(aur_scan_word(scanner), "on") && is_word(name, "-clamp"))
            image->clamped = true;
        double number;
        for (size_t k = 0; k < options[i].numbers && aur_scan_double(scanner, &number); ++k)
            continue;
    }
}

static bool read_image(aur_scanner *scanner, aur_mtl_image *image) {
    aur_scan_blanks(scanner);
    while (*scanner->at == '-') {
        skip_option(scanner, image);
        aur_scan_blanks(scanner);
    }
    const aur_word word = aur_scan_rest(scanner);
    if (word.length == 0)
        return true;
    free(image->name);
    image->name = strndup(word.text, word.length);
    for (char *c = image->name; c != NULL && *c != '\0'; ++c) /* Windows paths */
        if (*c == '\\')
            *c = '/';
    return image->name != NULL;
}

static bool read_material_line(aur_scanner *scanner, aur_word word, aur_mtl_material *material) {
    static const char *const maps[][2] = {
        [AUR_MTL_DIFFUSE] = {"map_Kd", NULL}, [AUR_MTL_EMISSION] = {"map_Ke", NULL},
        [AUR_MTL_OPACITY] = {"map_d", NULL},  [AUR_MTL_ROUGHNESS] = {"map_Pr", NULL},
        [AUR_MTL_METAL] = {"map_Pm", NULL},   [AUR_MTL_NORMAL] = {"norm", "map_Kn"}};
    for (size_t map = 0; map < AUR_MTL_MAP_COUNT; ++map)
        if (is_word(word, maps[map][0]) || (maps[map][1] != NULL && is_word(word, maps[map][1])))
            return read_image(scanner, &material->images[map]);
    double transparency = NAN;
    if (is_word(word, "Kd"))
        read_color(scanner, material->diffuse);
    else if (is_word(word, "Ks"))
        read_color(scanner, material->specular);
    else if (is_word(word, "Ke"))
        read_color(scanner, material->emission);
    else if (is_word(word, "Ns"))
        read_number(scanner, &material->shininess);
    else if (is_word(word, "d"))
        read_number(scanner, &material->opacity);
    else if (is_word(word, "Pr"))
        read_number(scanner, &material->roughness);
    else if (is_word(word, "Pm"))
        read_number(scanner, &material->metal);
    else if (is_word(word, "Tr"))
        read_number(scanner, &transparency);
    /* Some programs, such as MeshLab, write "Tr 1" for opaque surfaces: fully transparent is never intended.
     */
    if (!isnan(transparency))
        material->opacity = transparency == 1.0 ? 1.0 : 1.0 - transparency;
    return true;
}

aur_result aur_mtl_read(aur_mtl_library *library, size_t size, const char *text, aur_error *error) {
    aur_scanner scanner = {text, text + size, 1};
    const size_t first = library->count;
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        scanner.at += 3;
    for (; scanner.at < scanner.end; aur_scan_next_line(&scanner)) {
        const aur_word word = aur_scan_line_done(&scanner) ? (aur_word){0, ""} : aur_scan_word(&scanner);
        bool good = true;
        if (is_word(word, "newmtl")) {
            const aur_word name = aur_scan_rest(&scanner);
            good = aur_mtl_add(library, name.text, name.length) != NULL;
        } else if (word.length > 0 && library->count > first) {
            good = read_material_line(&scanner, word, &library->materials[library->count - 1]);
        }
        if (!good)
            return aur_fail_memory(error);
    }
    return AUR_OK;
}
