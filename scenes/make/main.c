/* aureole-scenes [--folder DIR] [--again] [FILE...]: the meshes and environments of the bundled scenes that
 * are too large to be kept with them.
 *
 * A file that is there is left as it is, unless --again asks for it: files appear whole or not at all, so
 * what is there is whole. The same program makes the same bytes. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "product.h"

extern const product product_hare;
extern const product product_statue;
extern const product product_teapot;
extern const product product_cups;
extern const product product_tea;
extern const product product_bowl;
extern const product product_apples;
extern const product product_oranges;
extern const product product_pears;
extern const product product_grapes;
extern const product product_stems;
extern const product product_cloth;
extern const product product_wood;
extern const product product_car_body;
extern const product product_car_chrome;
extern const product product_car_glass;
extern const product product_car_tyres;
extern const product product_car_headlights;
extern const product product_plate;
extern const product product_seeds;
extern const product product_temple;
extern const product product_sky;
extern const product product_studio;

static const product *const products[] = {
    &product_hare,      &product_statue,    &product_teapot,         &product_cups,     &product_tea,
    &product_bowl,      &product_apples,    &product_oranges,        &product_pears,    &product_grapes,
    &product_stems,     &product_cloth,     &product_wood,           &product_car_body, &product_car_chrome,
    &product_car_glass, &product_car_tyres, &product_car_headlights, &product_plate,    &product_seeds,
    &product_temple,    &product_sky,       &product_studio,
};

enum { PRODUCT_COUNT = sizeof products / sizeof products[0], EXIT_USAGE = 2, EXIT_FAILED = 3 };

static aur_result make_mesh(const product *p, const char *path, aur_error *error) {
    mesh m = {0};
    p->build(&m);
    const aur_result result = mesh_write(&m, path, error);
    if (result == AUR_OK)
        printf("%s: %zu triangles\n", path, m.triangle_count);
    mesh_release(&m);
    return result;
}

static aur_result make_image(const product *p, const char *path, aur_error *error) {
    aur_image *image = NULL;
    aur_result result = p->paint(&image, error);
    if (result == AUR_OK)
        result = aur_image_write(path, image, NULL, error);
    if (result == AUR_OK)
        printf("%s: %zu x %zu\n", path, aur_image_width(image), aur_image_height(image));
    aur_image_destroy(image);
    return result;
}

static int make(const product *p, const char *folder, bool again) {
    char path[1024];
    if (snprintf(path, sizeof path, "%s/%s", folder, p->file) >= (int)sizeof path) {
        fprintf(stderr, "aureole-scenes: the folder's name is too long\n");
        return EXIT_USAGE;
    }
    if (!again && access(path, F_OK) == 0) {
        printf("%s: is there\n", path);
        return 0;
    }
    aur_error error = {0};
    if ((p->build != NULL ? make_mesh(p, path, &error) : make_image(p, path, &error)) == AUR_OK)
        return 0;
    char text[AUR_ERROR_FILE_CAPACITY + AUR_ERROR_MESSAGE_CAPACITY];
    aur_error_format(&error, sizeof text, text);
    fprintf(stderr, "aureole-scenes: %s\n", text);
    return EXIT_FAILED;
}

static const product *find(const char *name) {
    for (size_t i = 0; i < PRODUCT_COUNT; ++i)
        if (strcmp(products[i]->file, name) == 0)
            return products[i];
    return NULL;
}

static int usage(const char *unknown) {
    if (unknown != NULL)
        fprintf(stderr, "aureole-scenes: unknown file or option '%s'\n", unknown);
    fprintf(stderr, "usage: aureole-scenes [--folder DIR] [--again] [FILE...]; the files are:\n");
    for (size_t i = 0; i < PRODUCT_COUNT; ++i)
        fprintf(stderr, "  %-16s %s\n", products[i]->file, products[i]->summary);
    return EXIT_USAGE;
}

int main(int argc, char **argv) {
    const char *folder = AUR_SCENES_FOLDER "/generated";
    bool again = false;
    int named = argc; /* the first FILE */
    for (int i = 1; i < argc && named == argc; ++i) {
        if (strcmp(argv[i], "--again") == 0)
            again = true;
        else if (strcmp(argv[i], "--folder") == 0 && i + 1 < argc)
            folder = argv[++i];
        else if (find(argv[i]) != NULL)
            named = i;
        else
            return usage(argv[i]);
    }
    for (int i = named; i < argc; ++i)
        if (find(argv[i]) == NULL)
            return usage(argv[i]);
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "aureole-scenes: cannot make the folder %s: %s\n", folder, strerror(errno));
        return EXIT_FAILED;
    }
    int status = 0;
    for (size_t i = 0; i < PRODUCT_COUNT && named == argc && status == 0; ++i)
        status = make(products[i], folder, again);
    for (int i = named; i < argc && status == 0; ++i)
        status = make(find(argv[i]), folder, again);
    return status;
}
