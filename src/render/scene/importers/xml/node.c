/* What elements have, and what is wrong with them. */
#include <stdarg.h>
#include <string.h>

#include "points/base/names.h"
#include "points/base/text.h"
#include "render/scene/importers/xml/xml.h"

const char *aur_xml_attribute_value(const aur_xml_node *node, const char *name) {
    for (size_t i = 0; i < node->attribute_count; ++i)
        if (strcmp(node->attributes[i].name, name) == 0)
            return node->attributes[i].value;
    return NULL;
}

aur_result aur_xml_fail(const aur_xml_node *node, aur_error *error, const char *format, ...) {
    char text[AUR_ERROR_MESSAGE_CAPACITY];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    return aur_fail_at(error, node->location, AUR_ERROR_FORMAT, "%s", text);
}

aur_result aur_xml_check(const aur_xml_node *node, const aur_xml_rule *rule, aur_error *error) {
    aur_names names = aur_names_of(0, rule->names);
    while (rule->names[names.count] != NULL)
        ++names.count;
    for (size_t i = 0; i < node->attribute_count; ++i) {
        const char *const name = node->attributes[i].name;
        char hint[AUR_HINT_CAPACITY];
        if (aur_names_find(names, name) == names.count)
            return aur_fail_at(error, node->location, AUR_ERROR_NAME, "<%s> has no attribute '%s'%s",
                               node->tag, name, aur_names_hint(names, name, "''", hint));
    }
    for (size_t i = 0; i < rule->required; ++i)
        if (aur_xml_attribute_value(node, rule->names[i]) == NULL)
            return aur_xml_fail(node, error, "<%s> needs the attribute '%s'", node->tag, rule->names[i]);
    return AUR_OK;
}

aur_result aur_xml_fail_tag(const aur_xml_node *node, size_t count, const char *const *names,
                            aur_error *error) {
    char hint[AUR_HINT_CAPACITY];
    return aur_fail_at(error, node->location, AUR_ERROR_NAME, "unknown element <%s>%s", node->tag,
                       aur_names_hint(aur_names_of(count, names), node->tag, "<>", hint));
}
