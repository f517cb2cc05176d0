/* Loads scenes and meshes from texts in tests. */
#pragma once

#include "check.h"
#include "render/scene/scene_data.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "render/scene/scene.h"

/* A private folder for a test program; removed by leave_folder. */
static char scene_folder[64];

static inline int enter_folder(void **state) {
    (void)state;
    strcpy(scene_folder, "/tmp/aureole-test-XXXXXX");
    return mkdtemp(scene_folder) == NULL;
}

static inline int leave_folder(void **state) {
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", scene_folder);
    return system(command);
}

static inline const char *write_file(const char *name, const void *data, size_t size) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", scene_folder, name);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline const char *write_text(const char *name, const char *text) {
    return write_file(name, text, strlen(text));
}

/* <scene version="3.0.0"> + body + a sensor + </scene>. */
static inline aur_result load_body(const char *body, const aur_scene_options *options, aur_scene **scene,
                                   aur_error *error) {
    static const char *const head = "<scene version=\"3.0.0\">\n";
    static const char *const tail =
        "\n<sensor type=\"perspective\"><float name=\"fov\" value=\"45\"/></sensor></scene>";
    char *const text = malloc(strlen(head) + strlen(body) + strlen(tail) + 1);
    strcpy(text, head);
    strcat(text, body);
    strcat(text, tail);
    const aur_result result = aur_scene_load(write_text("scene.xml", text), options, scene, error);
    free(text);
    return result;
}

/* As must_load_body, with surfaces in one plane as they are. */
static inline aur_scene *must_load_uncut(const char *body) {
    char text[1 << 14];
    const int length = snprintf(
        text, sizeof text, "<scene version=\"3.0.0\">\n%s\n<sensor type=\"perspective\"/></scene>", body);
    aur_scene *scene = NULL;
    assert_in_range(length, 1, sizeof text - 1);
    assert_int_equal(aur_scene_load_with_points(write_text("uncut.xml", text), (size_t)length, text,
                                                AUR_OVERLAPS_STAY, NULL, &scene, NULL),
                     AUR_OK);
    return scene;
}

static inline aur_scene *must_load_body(const char *body) {
    aur_scene *scene = NULL;
    aur_error error = {0};
    if (load_body(body, NULL, &scene, &error) != AUR_OK) {
        char text[1024];
        aur_error_format(&error, sizeof text, text);
        fail_msg("%s", text);
    }
    return scene;
}
