/* The messages of the importer process, which a malicious model may have taken over. */
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "fuzz.h"
#include "render/scene/importers/model/import.h"
#include "render/scene/importers/model/message.h"

static aur_result find(void *state, const char *name, char **used, char **path, aur_error *error) {
    (void)state, (void)error;
    *path = NULL;
    *used = name[0] == 'a' ? strdup(name) : NULL;
    return AUR_OK;
}

/* Sends everything before the conversation begins and ignores the answers. */
static bool converse(const uint8_t *data, size_t size, aur_model_files *files, aur_nodes *nodes) {
    int ends[2];
    fuzz_require(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "no socket");
    const bool sent = send(ends[1], data, size, MSG_DONTWAIT | MSG_NOSIGNAL) == (ssize_t)size;
    shutdown(ends[1], SHUT_WR);
    aur_child child = {.program = "fuzz", .socket = ends[0], .seconds = 0.1, .patience = 1.0, .status = -1};
    aur_model_stage stage = {0};
    const aur_model_source source = {.name = "a.fbx",
                                     .size = 4,
                                     .data = "FBX",
                                     .stage = &stage,
                                     .location = {.file = "a.fbx"},
                                     .find = find};
    const aur_error *const error = nodes->error;
    aur_xml_node *const root = aur_node_add(nodes, NULL, "scene");
    const aur_result result =
        sent ? aur_model_converse(&child, &source, files, nodes, root) : AUR_ERROR_FORMAT;
    close(sent ? ends[1] : ends[0]);
    if (!sent)
        close(ends[1]);
    fuzz_require(!sent || child.socket == -1, "the socket stays open");
    fuzz_require(!sent || result == AUR_OK || (error->result == result && error->message[0] != '\0'),
                 "a failure without a message");
    fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT, "a failure of the wrong kind");
    return result == AUR_OK;
}

/* Texts must have no control characters; ids must belong to their elements. */
static void check_node(const aur_xml_node *node, size_t depth) {
    fuzz_require(depth <= 102, "a tree that is too deep");
    for (const aur_xml_node *child = node->first_child; child != NULL; child = child->next) {
        for (size_t i = 0; i < child->attribute_count; ++i)
            for (const char *c = child->attributes[i].value; *c != '\0'; ++c)
                fuzz_require((unsigned char)*c >= 32 && *c != 127, "a control character");
        check_node(child, depth + 1);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_model_files files = {0};
    aur_xml_tree tree = {0};
    aur_xml_variables variables = {.arena = &tree.arena};
    aur_nodes nodes = {.tree = &tree, .variables = &variables, .error = &error};
    if (converse(data, size, &files, &nodes))
        check_node(tree.root, 0);
    for (size_t i = 0; i < tree.id_count; ++i)
        fuzz_require(aur_xml_attribute_value(tree.ids[i].node, "id") != NULL, "an id of no element");
    for (size_t i = 0; i < files.count; ++i)
        fuzz_require(files.items[i].name != NULL && files.items[i].data[files.items[i].size] == '\0',
                     "a part that is none");
    free(variables.items);
    aur_xml_tree_release(&tree);
    aur_model_release_files(&files);
    return 0;
}

/* --- seeds */

static uint8_t *put(uint8_t *at, aur_import_kind kind, uint32_t value, size_t size, const void *data) {
    const aur_import_header header = {kind, value, size};
    memcpy(at, &header, sizeof header);
    memcpy(at + sizeof header, data, size);
    return at + sizeof header + size;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    /* including the zero byte of the last one */
    static const char records[] = "<shape\0=type\0sphere\0=id\0a\0<float\0=name\0radius\0=value\0"
                                  "1\0>\0>\0<ref\0>";
    aur_import_camera scene = {.aspect = 1.0};
    uint8_t last[sizeof scene + sizeof records];
    uint8_t *at = data;
    if (index > 1)
        return 0;
    fuzz_require(capacity >= 1024, "a seed is too large");
    if (index == 1) {
        scene = (aur_import_camera){.is_there = 1, .direction = {0.0, 1.0, 0.0}, .aspect = 1.5};
        at = put(at, AUR_IMPORT_FAIL, 20, 9, "no\nfile\0!");
    }
    at = put(at, AUR_IMPORT_OPEN, 0, 5, "a.fbx");
    at = put(at, AUR_IMPORT_OPEN, 0, 5, "b.mtl");
    at = put(at, AUR_IMPORT_FIND, 0, 5, "c.png");
    at = put(at, AUR_IMPORT_NOTE, 0, 6, "\x1b[31mx");
    at = put(at, AUR_IMPORT_MESH, 0, 4, "ply\n");
    at = put(at, AUR_IMPORT_IMAGE, 0, 8, "\x89PNG\r\n\x1a\n");
    memcpy(last, &scene, sizeof scene);
    memcpy(last + sizeof scene, records, sizeof records);
    at = put(at, AUR_IMPORT_SCENE, 0, sizeof last, last);
    return (size_t)(at - data);
}
