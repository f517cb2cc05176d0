/* Ids of objects, and their aliases. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/importers/xml/xml.h"

static int compare_ids(const void *a, const void *b) {
    const aur_xml_id *const x = a, *const y = b;
    const int order = strcmp(x->id, y->id);
    return order != 0 ? order : (x->order > y->order) - (x->order < y->order);
}

static int compare_id_to_key(const void *key, const void *item) {
    return strcmp(key, ((const aur_xml_id *)item)->id);
}

aur_xml_id *aur_xml_find_id(const aur_xml_document *document, const char *id) {
    return document->tree.id_count == 0 ? NULL
                                        : bsearch(id, document->tree.ids, document->tree.id_count,
                                                  sizeof *document->tree.ids, compare_id_to_key);
}

static aur_result sort_ids(const aur_xml_document *document, aur_error *error) {
    if (document->tree.id_count > 1)
        qsort(document->tree.ids, document->tree.id_count, sizeof *document->tree.ids, compare_ids);
    for (size_t i = 1; i < document->tree.id_count; ++i) {
        const aur_location first = document->tree.ids[i - 1].node->location;
        if (strcmp(document->tree.ids[i - 1].id, document->tree.ids[i].id) == 0)
            return aur_xml_fail(document->tree.ids[i].node, error,
                                "id '%s' is given twice, first at %s:%zu:%zu", document->tree.ids[i].id,
                                first.file, first.line, first.column);
    }
    return AUR_OK;
}

/* The id that an alias refers to, or NULL. */
static aur_xml_id *next_id(const aur_xml_document *document, const aur_xml_id *alias) {
    return aur_xml_find_id(document, aur_xml_attribute_value(alias->node, "id"));
}

/* Stores the object in every alias on the way, so that a chain of aliases is resolved once. */
static aur_result resolve_aliases(const aur_xml_document *document, aur_error *error) {
    for (size_t i = 0; i < document->tree.id_count; ++i) {
        aur_xml_id *const first = &document->tree.ids[i];
        const aur_xml_id *last = first;
        for (size_t hops = 0; strcmp(last->node->tag, "alias") == 0; ++hops) {
            const aur_xml_id *const next = next_id(document, last);
            if (next == NULL || hops > document->tree.id_count)
                return aur_fail_at(error, first->node->location, AUR_ERROR_NAME, "<alias>: unknown id '%s'",
                                   aur_xml_attribute_value(last->node, "id"));
            last = next;
        }
        for (aur_xml_id *item = first; strcmp(item->node->tag, "alias") == 0;) {
            aur_xml_id *const next = next_id(document, item);
            item->node = last->node;
            item = next;
        }
    }
    return AUR_OK;
}

aur_result aur_xml_settle_ids(const aur_xml_document *document, aur_error *error) {
    const aur_result result = sort_ids(document, error);
    return result == AUR_OK ? resolve_aliases(document, error) : result;
}
