/* A stand-in for Open Image Denoise: half of the colour, a quarter of the albedo, an eighth of the normal;
 * or, with STUB_BLURS in the environment, the mean colour of 5 x 5 pixels. */
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { COLOR, ALBEDO, NORMAL, OUTPUT, COUNT };

static struct stub_filter {
    struct {
        char *data;
        size_t offset, pixel_stride, row_stride;
    } images[COUNT];
    size_t width, height;
    bool hdr, clean, committed;
} filter;
static int device;
static const char *wrong = NULL;

void *oidnNewDevice(int type);
void oidnCommitDevice(void *of);
void oidnReleaseDevice(void *of);
int oidnGetDeviceError(void *of, const char **message);
void *oidnNewFilter(void *of, const char *type);
void oidnSetSharedFilterImage(void *of, const char *name, void *data, int format, size_t width, size_t height,
                              size_t offset, size_t pixel_stride, size_t row_stride);
void oidnSetFilterBool(void *of, const char *name, bool value);
void oidnCommitFilter(void *of);
void oidnExecuteFilter(void *of);
void oidnReleaseFilter(void *of);

void *oidnNewDevice(int type) {
    return type == 1 ? &device : NULL;
}

void oidnCommitDevice(void *of) {
    (void)of;
}

void oidnReleaseDevice(void *of) {
    (void)of;
}

int oidnGetDeviceError(void *of, const char **message) {
    (void)of;
    *message = wrong;
    return wrong != NULL;
}

void *oidnNewFilter(void *of, const char *type) {
    return of == &device && strcmp(type, "RT") == 0 ? &filter : NULL;
}

void oidnSetSharedFilterImage(void *of, const char *name, void *data, int format, size_t width, size_t height,
                              size_t offset, size_t pixel_stride, size_t row_stride) {
    static const char *const names[COUNT] = {"color", "albedo", "normal", "output"};
    struct stub_filter *const self = of;
    for (size_t i = 0; i < COUNT; ++i) {
        if (strcmp(names[i], name) != 0)
            continue;
        self->images[i].data = data;
        self->images[i].offset = offset;
        self->images[i].pixel_stride = pixel_stride;
        self->images[i].row_stride = row_stride;
    }
    if (format != 3 || (self->width != 0 && (self->width != width || self->height != height)))
        wrong = "a bad image";
    self->width = width;
    self->height = height;
}

void oidnSetFilterBool(void *of, const char *name, bool value) {
    struct stub_filter *const self = of;
    self->hdr = self->hdr || (strcmp(name, "hdr") == 0 && value);
    self->clean = self->clean || (strcmp(name, "cleanAux") == 0 && value);
}

void oidnCommitFilter(void *of) {
    ((struct stub_filter *)of)->committed = true;
}

static float *value(size_t image, size_t x, size_t y) {
    return (float *)(void *)(filter.images[image].data + filter.images[image].offset +
                             y * filter.images[image].row_stride + x * filter.images[image].pixel_stride);
}

static float blurred(size_t x, size_t y, size_t c) {
    enum { REACH = 2 };
    float sum = 0.0f, count = 0.0f;
    for (size_t v = y > REACH ? y - REACH : 0; v < filter.height && v <= y + REACH; ++v)
        for (size_t u = x > REACH ? x - REACH : 0; u < filter.width && u <= x + REACH; ++u, count += 1.0f)
            sum += value(COLOR, u, v)[c];
    return sum / count;
}

void oidnExecuteFilter(void *of) {
    (void)of;
    if (!filter.committed || !filter.hdr || !filter.clean)
        wrong = "not committed";
    for (size_t y = 0; y < filter.height; ++y)
        for (size_t x = 0; x < filter.width; ++x)
            for (size_t c = 0; c < 3; ++c)
                value(OUTPUT, x, y)[c] = getenv("STUB_BLURS") != NULL
                                             ? blurred(x, y, c)
                                             : 0.5f * value(COLOR, x, y)[c] + 0.25f * value(ALBEDO, x, y)[c] +
                                                   0.125f * value(NORMAL, x, y)[c];
}

void oidnReleaseFilter(void *of) {
    (void)of;
}
