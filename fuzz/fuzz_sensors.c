/* Sensor positions: text, NPY and meshes, distinguished by the file name's extension. Of meshes at facets or
 * vertices, with or without an offset. The first byte selects the case. */
#include <aureole-lighting/irradiance.h>
#include <math.h>

#include "fuzz.h"

static const char *const endings[] = {"pts", "npy", "obj", "ply"};

static void on_warning(void *context, const char *message) {
    (void)context;
    fuzz_require(message[0] != '\0', "a warning without words");
}

static const char *path_of(const char *ending) {
    static char path[64];
    snprintf(path, sizeof path, "fuzz-sensors-%ld.%s", (long)getpid(), ending);
    return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size == 0)
        return 0;
    const char *const path = path_of(endings[data[0] % 4]);
    fuzz_write_file(path, data + 1, size - 1);
    aur_sensors *sensors = NULL;
    const aur_sensors_options options = {.size = sizeof options,
                                         .place = data[0] / 8 % 2 == 0 ? AUR_SENSORS_ON_FACES
                                                                       : AUR_SENSORS_ON_VERTICES,
                                         .lift = data[0] / 16 % 2 == 0 ? 0.0 : 0.25,
                                         .warnings = {.function = on_warning}};
    aur_error error = {0};
    const aur_result result = aur_sensors_read(path, &options, &sensors, &error);
    unlink(path);
    if (result != AUR_OK) {
        fuzz_require(sensors == NULL, "a failed read left sensors");
        fuzz_require(error.result == result && error.message[0] != '\0' && error.file[0] != '\0',
                     "a failure without a message or a place");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
        return 0;
    }
    const aur_sensors_view *const view = aur_sensors_get_view(sensors);
    fuzz_require(view->count > 0, "sensors that are none");
    for (size_t i = 0; i < view->count; ++i) {
        const double *const n = view->normals + 3 * i;
        fuzz_require(fabs(n[0]) + fabs(n[1]) + fabs(n[2]) > 0.0, "a normal without a direction");
        for (size_t k = 0; k < 3; ++k)
            fuzz_require(isfinite(view->positions[3 * i + k]) && isfinite(n[k]),
                         "a number that is not finite");
    }
    aur_sensors_destroy(sensors);
    return 0;
}

static const char *const texts[] = {
    "\4x,y,z,nx,ny,nz\n0,0,1,0,0,1\n1, 2, 3, 0, 1, 0\n",
    "\4# a comment\n0 0 1 0 0 1\n\n1.5e1 -2 3.25 .5 .5 0\n",
    "\6v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
    ("\7ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"),
    "\36o a\nv 0 0 0\nv 9 9 9\nv 1 0 0\nv 1 1 1\nv 0 1 0\ng b\nf 1 3 4\nf 1 4 5\n",
    ("\2v 0 0 0\nv 1 0 0\nv 1 1 0\no c\ng a\nf 1 2 3\ng b\nf 1 2 3\ng a\nf 1 \\\n2 3\ng\nf 3 2 1\no d\nf 3 2 "
     "1\n"),
    "\40 0 0 1 0 0\n1 2 3 4 5\n",
    "\20 0 0 1 0 0 0\n",
    "\24 0 0 1 0 0 2\n",
};

enum { TEXTS = sizeof texts / sizeof texts[0] };

/* Texts, and NPY arrays in C and Fortran order. */
size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index < TEXTS)
        return fuzz_text_seed(TEXTS, texts, index, capacity, data);
    if (index > TEXTS + 1)
        return 0;
    char head[128];
    const int length = snprintf(
        head, sizeof head, "\005\x93NUMPY\001%c\166%c{'descr': '<f8', 'fortran_order': %s, 'shape': (2, 6)}",
        0, 0, index == TEXTS ? "False" : "True");
    const double rows[12] = {0, 0, 1, 0, 0, 1, 1, 2, 3, 0, 1, 0};
    const size_t size = 1 + 128; /* the header of 10 bytes and a text of 118 end on a multiple of 64 */
    fuzz_require(size + sizeof rows <= capacity, "a seed is too large");
    memset(data, ' ', size);
    memcpy(data, head, (size_t)length);
    data[size - 1] = '\n';
    memcpy(data + size, rows, sizeof rows);
    return size + sizeof rows;
}
