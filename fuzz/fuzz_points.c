/* Files of points, CSV and NPY, on any domain: the length of the input selects the domain and whether it is
 * read from a file. */
#include <aureole/pointset.h>
#include <stdbool.h>

#include "fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_points *points;
    aur_error error = {0};
    const aur_domain domain = (aur_domain)(size % 8);
    const bool anywhere = domain > AUR_DOMAIN_ROTATIONS;
    aur_result result;
    if (size / 8 % 2 == 0) {
        result =
            aur_points_read_memory("fuzz-points", size, data, anywhere ? NULL : &domain, &points, &error);
    } else {
        char path[64];
        snprintf(path, sizeof path, "fuzz-points-%ld", (long)getpid());
        fuzz_write_file(path, data, size);
        result = aur_points_read(path, anywhere ? NULL : &domain, &points, &error);
        unlink(path);
    }
    if (result != AUR_OK) {
        fuzz_require(error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_OPEN, "a failure of the wrong kind");
        return 0;
    }
    const aur_points_view *const view = aur_points_get_view(points);
    fuzz_require(view->dimension > 0 && view->coordinates != NULL, "points without coordinates");
    double sum = 0.0; /* every value can be read and is finite */
    for (size_t i = 0; i < view->count * view->dimension; ++i)
        sum += view->coordinates[i] * 0.0;
    for (size_t i = 0; i < view->count && view->weights != NULL; ++i)
        sum += view->weights[i] * 0.0;
    fuzz_require(sum == 0.0, "a value that is not finite");
    aur_points_destroy(points);
    return 0;
}

static size_t npy_seed(size_t capacity, uint8_t *data) {
    static const char header[] = "\x93NUMPY\x01\x00\x76\x00"
                                 "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 2), }";
    const size_t start = 128;
    fuzz_require(capacity >= start + 64, "a seed is too long");
    memset(data, ' ', start);
    memcpy(data, header, sizeof header - 1);
    data[start - 1] = '\n';
    for (size_t i = 0; i < 8; ++i) {
        const double value = (double)i / 8.0;
        memcpy(data + start + 8 * i, &value, sizeof value);
    }
    return start + 64;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const char *const texts[] = {
        "u,v\n0,0\n0.5,0.25\n0.25,0.75\n",
        "x,y,z,w\n0,0,1,0.5\n1,0,0,2.5e-1\n0,0.6,0.8,1\n",
        "# from a program\n0.125 0.5\n0.375\t0.75\n\n",
        "x,y,z\r\n0,0,-1\r\n-0.6,0,0.8\r\n",
        "u1,u2,u3,u4,u5\n0,0.1,0.2,0.3,0.4\n0.5,0.6,0.7,0.8,0.9\n",
    };
    const size_t count = sizeof texts / sizeof texts[0];
    return index == count ? npy_seed(capacity, data) : fuzz_text_seed(count, texts, index, capacity, data);
}
