/* Photometric data files of luminaires. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "render/scene/lights/photometry.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_photometry photometry;
    const aur_result result = aur_photometry_parse("lamp", size, (const char *)data, &photometry, &error);
    if (result != AUR_OK) {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        return 0;
    }
    for (int i = 0; i < 27; ++i) {
        const double way[3] = {i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
        if (i != 13)
            fuzz_require(aur_photometry_intensity(&photometry, way) >= 0.0, "an intensity below 0, or none");
    }
    aur_photometry_release(&photometry);
    return 0;
}

static const char *const seeds[] = {
    "IESNA:LM-63-2002\n[TEST] 1\nTILT=NONE\n1 1000 1 3 2 1 1 .1 .2 0\n1 1 50\n0 90 180\n0 90\n9 8 7\n6 5 4\n",
    "TILT=INCLUDE\n1 2\n0 90\n1 .9\n1 -1 2 2 2 2 2 -1 0 0 1 1 9\n-90 90\n0 90\n1 2 3 4\n",
    "m\n1\n1\n4\n90\n2\n180\nr\nn\nx\nf\nd\n1\n0\n1\n1\n0\n0\n0\n0\n0\n100\n80,"
    "5\n1\n0\n1\n1\nt\n1000\nc\nr\n9\n"
    "1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n0\n90\n180\n270\n0\n180\n100\n50\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof seeds / sizeof seeds[0], seeds, index, capacity, data);
}
