/* For engines that read seeds only from folders: with AUREOLE_FUZZ_SEEDS=FOLDER a harness writes its seeds
 * there and ends. Engines call this before the first input. */
#include <errno.h>
#include <sys/stat.h>

#include "fuzz.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    enum { CAPACITY = 1 << 16 };
    const char *const folder = getenv("AUREOLE_FUZZ_SEEDS");
    if (folder == NULL)
        return 0;
    fuzz_require(mkdir(folder, 0777) == 0 || errno == EEXIST, "the folder for seeds cannot be made");
    uint8_t *const data = malloc(CAPACITY);
    fuzz_require(data != NULL, "out of memory");
    size_t size;
    for (size_t i = 0; (size = aur_fuzz_seed(i, CAPACITY, data)) > 0; ++i) {
        char path[4096];
        fuzz_require(snprintf(path, sizeof path, "%s/seed-%zu", folder, i) < (int)sizeof path, "a long path");
        fuzz_write_file(path, data, size);
    }
    free(data);
    exit(0);
}
