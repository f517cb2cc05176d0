/* Identification of mesh file formats. */
#include <string.h>
#include <strings.h>

#include "points/base/text.h"
#include "render/scene/importers/meshes/mesh_reader.h"

aur_mesh_format aur_mesh_format_of_name(const char *path) {
    static const char *const endings[AUR_MESH_FORMAT_COUNT] = {
        [AUR_MESH_OBJ] = ".obj", [AUR_MESH_PLY] = ".ply", [AUR_MESH_STL] = ".stl", [AUR_MESH_OFF] = ".off"};
    const char *const dot = strrchr(path, '.');
    aur_mesh_format format = 0;
    while (format < AUR_MESH_FORMAT_COUNT && (dot == NULL || strcasecmp(dot, endings[format]) != 0))
        ++format;
    return format;
}

static bool is_binary_stl(size_t size, const char *data) {
    return size >= AUR_STL_HEAD + AUR_STL_FACET &&
           size == AUR_STL_HEAD + AUR_STL_FACET * (size_t)aur_stl_count(data);
}

/* Whether `solid` and `facet` begin the text as in ascii STL, possibly with a name between. */
static bool is_ascii_stl(const char *text) {
    if (strncasecmp(text, "solid", 5) != 0)
        return false;
    aur_scanner scanner = {text, text + strlen(text), 1};
    for (size_t i = 0; i < 8 && scanner.at < scanner.end; ++i) {
        aur_scan_next_line(&scanner);
        const aur_word word = aur_scan_word(&scanner);
        if (word.length >= 5 &&
            (strncasecmp(word.text, "facet", 5) == 0 || strncasecmp(word.text, "endso", 5) == 0))
            return true;
    }
    return false;
}

static bool is_off(const char *text) {
    static const char *const prefixes[] = {"ST", "C", "N", "4", "n"};
    for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; ++i)
        if (strncmp(text, prefixes[i], strlen(prefixes[i])) == 0)
            text += strlen(prefixes[i]);
    return strncmp(text, "OFF", 3) == 0;
}

aur_mesh_format aur_mesh_format_of_bytes(size_t size, const char *data) {
    if (is_binary_stl(size, data))
        return AUR_MESH_STL;
    const char *const text = data + (strncmp(data, "\xef\xbb\xbf", 3) == 0 ? 3 : 0);
    if (strncmp(text, "ply", 3) == 0 && (aur_is_line_end(text[3]) || aur_is_blank(text[3])))
        return AUR_MESH_PLY;
    if (is_ascii_stl(aur_skip_spaces(text)))
        return AUR_MESH_STL;
    return is_off(aur_skip_spaces(text)) ? AUR_MESH_OFF : AUR_MESH_FORMAT_COUNT;
}
