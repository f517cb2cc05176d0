/* Vertex and face attributes of PLY files. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/scene/importers/meshes/ply.h"

enum { MOST_WIDTH = 4 };

/* The properties of an attribute. */
typedef struct set {
    char name[64]; /* without "vertex_" or "face_" */
    size_t count;
    aur_ply_property *properties[MOST_WIDTH];
} set;

static bool is_free(const aur_ply_property *property) {
    return property->role == AUR_PLY_OTHER && !property->list && property->values == NULL;
}

/* The property of either name, or NULL. */
static aur_ply_property *find(aur_ply_element *element, const char *name, const char *other) {
    for (size_t i = 0; i < element->property_count; ++i) {
        aur_ply_property *const property = &element->properties[i];
        if (is_free(property) && (strcmp(property->name, name) == 0 || strcmp(property->name, other) == 0))
            return property;
    }
    return NULL;
}

static bool find_color(aur_ply_element *element, set *found) {
    *found = (set){
        .name = "color",
        .count = 3,
        .properties = {find(element, "r", "red"), find(element, "g", "green"), find(element, "b", "blue")}};
    return found->properties[0] != NULL && found->properties[1] != NULL && found->properties[2] != NULL;
}

/* Finds properties with the first one's prefix and this set of suffixes. */
static bool find_ends(aur_ply_element *element, const aur_ply_property *first, set *found) {
    static const char *const kinds[] = {"0123", "1234", "xyzw", "rgba"};
    const char *const last = strrchr(first->name, '_');
    if (!is_free(first) || last == NULL || last == first->name || strlen(last) != 2)
        return false;
    char name[sizeof first->name];
    memcpy(name, first->name, sizeof name);
    char *const end = &name[last - first->name + 1];
    for (size_t kind = 0; kind < sizeof kinds / sizeof kinds[0]; ++kind) {
        *found = (set){.count = 0};
        for (*end = kinds[kind][0]; found->count < MOST_WIDTH;
             ++found->count, *end = kinds[kind][found->count]) {
            aur_ply_property *const property = find(element, name, name);
            if (property == NULL)
                break;
            found->properties[found->count] = property;
        }
        if (found->count == 0 || found->properties[0] != first)
            continue;
        (void)snprintf(found->name, sizeof found->name, "%.*s%s", (int)(last - first->name), name,
                       kinds[kind][0] == 'r' ? "_color" : "");
        return true;
    }
    return false;
}

static aur_result add(aur_ply *self, const aur_ply_element *element, const set *found) {
    aur_mesh_data *const data = self->reader->data;
    aur_mesh_attribute *const grown = realloc(data->attributes, (data->attribute_count + 1) * sizeof *grown);
    if (grown == NULL)
        return aur_fail_memory(self->reader->error);
    data->attributes = grown;
    aur_mesh_attribute *const attribute = &grown[data->attribute_count];
    *attribute = (aur_mesh_attribute){.of_faces = element == self->faces, .width = found->count};
    (void)snprintf(attribute->name, sizeof attribute->name, "%s_%.50s",
                   attribute->of_faces ? "face" : "vertex", found->name);
    attribute->values = calloc(found->count * element->count + 1, sizeof *attribute->values);
    if (attribute->values == NULL)
        return aur_fail_memory(self->reader->error);
    ++data->attribute_count;
    for (size_t i = 0; i < found->count; ++i) {
        found->properties[i]->values = attribute->values + i;
        found->properties[i]->stride = found->count;
    }
    return AUR_OK;
}

aur_result aur_ply_find_attributes(aur_ply *self) {
    aur_ply_element *const elements[2] = {self->vertices, self->faces};
    for (size_t e = 0; e < 2; ++e) {
        set found;
        aur_result result = find_color(elements[e], &found) ? add(self, elements[e], &found) : AUR_OK;
        for (size_t i = 0; i < elements[e]->property_count && result == AUR_OK; ++i)
            if (find_ends(elements[e], &elements[e]->properties[i], &found))
                result = add(self, elements[e], &found);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}
