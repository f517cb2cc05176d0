#include "render/scene/importers/model/import.h"

#include <string.h>

#include "render/scene/importers/model/message.h"

/* The text at *at, without control characters, or NULL. */
static const char *next_text(const char **at, const char *end) {
    const char *const text = *at, *c = text;
    while (c < end && (unsigned char)*c >= 32 && *c != 127)
        ++c;
    if (c == end || *c != '\0')
        return NULL;
    *at = c + 1;
    return text;
}

bool aur_node_records_read(aur_nodes *nodes, aur_xml_node *parent, size_t size, const char *data) {
    enum { DEEPEST = 100 };
    aur_xml_node *open[DEEPEST + 1] = {parent};
    size_t depth = 0;
    const char *at = aur_arena_copy(&nodes->tree->arena, data, size);
    const char *const end = at + size;
    if (at == NULL)
        nodes->result = aur_fail_memory(nodes->error);
    while (nodes->result == AUR_OK && at < end) {
        const char *const text = next_text(&at, end), *value;
        const char kind = text != NULL ? text[0] : '\0';
        if (kind == AUR_IMPORT_ELEMENT && depth < DEEPEST) {
            open[depth + 1] = aur_node_add(nodes, open[depth], text + 1);
            ++depth;
        } else if (kind == AUR_IMPORT_ATTRIBUTE && depth > 0 && (value = next_text(&at, end)) != NULL) {
            aur_node_set(nodes, open[depth], text + 1, "%s", value);
        } else if (kind == AUR_IMPORT_END && depth > 0) {
            --depth;
        } else {
            return false;
        }
    }
    return nodes->result == AUR_OK && depth == 0;
}
