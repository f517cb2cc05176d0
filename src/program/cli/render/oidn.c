#include "program/cli/render/denoise.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The declarations of oidn.h, versions 1.4 and 2, that are used: devices and filters are handles. */
enum { OIDN_DEVICE_CPU = 1, OIDN_FORMAT_FLOAT3 = 3 };

typedef struct oidn_device oidn_device;
typedef struct oidn_filter oidn_filter;

struct cli_oidn {
    void *library;
    oidn_device *(*new_device)(int type);
    void (*commit_device)(oidn_device *device);
    void (*release_device)(oidn_device *device);
    int (*get_device_error)(oidn_device *device, const char **message);
    oidn_filter *(*new_filter)(oidn_device *device, const char *type);
    void (*set_image)(oidn_filter *filter, const char *name, void *data, int format, size_t width,
                      size_t height, size_t offset, size_t pixel_stride, size_t row_stride);
    void (*set_bool)(oidn_filter *filter, const char *name, bool value);
    void (*commit_filter)(oidn_filter *filter);
    void (*execute_filter)(oidn_filter *filter);
    void (*release_filter)(oidn_filter *filter);
};

/* Resolves a function by one of its names; `function` points to a function pointer. */
static bool find(void *library, const char *name, const char *other_name, void *function) {
    void *found = dlsym(library, name);
    if (found == NULL && other_name != NULL)
        found = dlsym(library, other_name);
    memcpy(function, &found, sizeof found);
    return found != NULL;
}

static bool find_all(cli_oidn *oidn) {
    void *const library = oidn->library;
    return find(library, "oidnNewDevice", NULL, &oidn->new_device) &&
           find(library, "oidnCommitDevice", NULL, &oidn->commit_device) &&
           find(library, "oidnReleaseDevice", NULL, &oidn->release_device) &&
           find(library, "oidnGetDeviceError", NULL, &oidn->get_device_error) &&
           find(library, "oidnNewFilter", NULL, &oidn->new_filter) &&
           find(library, "oidnSetSharedFilterImage", NULL, &oidn->set_image) &&
           find(library, "oidnSetFilterBool", "oidnSetFilter1b", &oidn->set_bool) &&
           find(library, "oidnCommitFilter", NULL, &oidn->commit_filter) &&
           find(library, "oidnExecuteFilter", NULL, &oidn->execute_filter) &&
           find(library, "oidnReleaseFilter", NULL, &oidn->release_filter);
}

static const char *const files[] = {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1",
                                    "libOpenImageDenoise.so"};
enum { FILE_COUNT = sizeof files / sizeof files[0] };

/* Loads the library next to an oidnDenoise in PATH: release archives have it in ../lib. */
static void *open_next_to_program(void) {
    const char *const path = getenv("PATH");
    for (const char *at = path != NULL ? path : ""; *at != '\0';) {
        const size_t length = strcspn(at, ":");
        char name[PATH_MAX];
        snprintf(name, sizeof name, "%.*s/oidnDenoise", (int)length, at);
        for (size_t i = 0; i < FILE_COUNT && access(name, X_OK) == 0; ++i) {
            char file[PATH_MAX];
            snprintf(file, sizeof file, "%.*s/../lib/%s", (int)length, at, files[i]);
            void *const library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
            if (library != NULL)
                return library;
        }
        at += length + (at[length] == ':');
    }
    return NULL;
}

static void *open_library(const char *named) {
    if (named != NULL && named[0] != '\0')
        return dlopen(named, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; i < FILE_COUNT; ++i) {
        void *const library = dlopen(files[i], RTLD_NOW | RTLD_LOCAL);
        if (library != NULL)
            return library;
    }
    return open_next_to_program();
}

aur_result cli_oidn_open(cli_oidn **created, aur_error *error) {
    const char *const named = getenv("AUREOLE_OIDN");
    cli_oidn loaded = {.library = open_library(named)};
    if (loaded.library == NULL && named != NULL && named[0] != '\0')
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "--denoise: the library in AUREOLE_OIDN: %s",
                        dlerror());
    if (loaded.library == NULL)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "--denoise: Open Image Denoise not found: install the PyPI package pyoidn, and name its "
            "library in AUREOLE_OIDN, such as .../pyoidn/lib/libOpenImageDenoise.so.2");
    cli_oidn *const oidn = find_all(&loaded) ? malloc(sizeof *oidn) : NULL;
    if (oidn == NULL) {
        dlclose(loaded.library);
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "--denoise: the library is not Open Image Denoise 1.4 or 2");
    }
    *oidn = loaded;
    *created = oidn;
    return AUR_OK;
}

void cli_oidn_close(cli_oidn *oidn) {
    if (oidn == NULL)
        return;
    dlclose(oidn->library);
    free(oidn);
}

static void set_image(const cli_oidn *oidn, oidn_filter *filter, const char *name, aur_image *image,
                      size_t channel) {
    const size_t stride = aur_image_channel_count(image) * sizeof(float);
    oidn->set_image(filter, name, aur_image_data(image), OIDN_FORMAT_FLOAT3, aur_image_width(image),
                    aur_image_height(image), channel * sizeof(float), stride,
                    stride * aur_image_width(image));
}

aur_result cli_oidn_run(const cli_oidn *oidn, aur_image *image, aur_image *features, aur_image *out,
                        aur_error *error) {
    const char *message = NULL;
    oidn_device *const device = oidn->new_device(OIDN_DEVICE_CPU);
    if (device == NULL) {
        oidn->get_device_error(NULL, &message);
        return aur_fail(error, AUR_ERROR_INTERNAL, "--denoise: Open Image Denoise: %s",
                        message != NULL ? message : "no device");
    }
    oidn->commit_device(device);
    oidn_filter *const filter = oidn->new_filter(device, "RT");
    if (filter != NULL) {
        set_image(oidn, filter, "color", image, 0);
        set_image(oidn, filter, "albedo", features, 3);
        set_image(oidn, filter, "normal", features, 6);
        set_image(oidn, filter, "output", out, 0);
        oidn->set_bool(filter, "hdr", true);
        oidn->set_bool(filter, "cleanAux", true);
        oidn->commit_filter(filter);
        oidn->execute_filter(filter);
        oidn->release_filter(filter);
    }
    const int failed = oidn->get_device_error(device, &message);
    const aur_result result = failed == 0 && filter != NULL
                                  ? AUR_OK
                                  : aur_fail(error, AUR_ERROR_INTERNAL, "--denoise: Open Image Denoise: %s",
                                             message != NULL ? message : "no filter");
    oidn->release_device(device);
    return result;
}
