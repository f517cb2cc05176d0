/* Where a build has MPI, it is a module beside the library, which is looked for when several processes were
 * started; where it has none, this file is the same and finds nothing. */
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* dladdr */
#endif
#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/ranks.h"

#define MODULE "aureole-mpi.so"

/* The module in the folder of the library that this code is in. */
static void *open_module(void) {
    static const char here = 0;
    char path[PATH_MAX];
    Dl_info info;
    if (dladdr(&here, &info) == 0 || info.dli_fname == NULL)
        return NULL;
    const char *const slash = strrchr(info.dli_fname, '/');
    const int folder = slash != NULL ? (int)(slash - info.dli_fname) + 1 : 0;
    snprintf(path, sizeof path, "%.*s" MODULE, folder, info.dli_fname);
    /* MPI's own parts, which it loads itself, look for its names. */
    void *const module = dlopen(path, RTLD_NOW | RTLD_GLOBAL);
    return module != NULL ? module : dlopen(MODULE, RTLD_NOW | RTLD_GLOBAL);
}

aur_result aur_carrier_find(aur_carrier *carrier, aur_error *error) {
    void *const module = open_module();
    void *const symbol = module != NULL ? dlsym(module, "aur_carrier_open") : NULL;
    if (symbol == NULL)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "started with several ranks, but built without MPI: render parts by '--shard i/n' and put "
            "them together by 'aureole merge'");
    aur_carrier_open_function open;
    memcpy(&open, &symbol, sizeof open);
    return open(carrier, error);
}
