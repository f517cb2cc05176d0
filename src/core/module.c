#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* dladdr */
#endif
#include "core/module.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

/* The module in the folder of the library that this code is in. */
static void *open_module(const char *file, int mode) {
    static const char here = 0;
    char path[PATH_MAX];
    Dl_info info;
    if (dladdr(&here, &info) == 0 || info.dli_fname == NULL)
        return NULL;
    const char *const slash = strrchr(info.dli_fname, '/');
    const int folder = slash != NULL ? (int)(slash - info.dli_fname) + 1 : 0;
    snprintf(path, sizeof path, "%.*s%s", folder, info.dli_fname, file);
    void *const module = dlopen(path, mode);
    return module != NULL ? module : dlopen(file, mode);
}

void (*aur_module_find(const char *file, const char *symbol, bool global))(void) {
    void *const module = open_module(file, RTLD_NOW | (global ? RTLD_GLOBAL : RTLD_LOCAL));
    void *const found = module != NULL ? dlsym(module, symbol) : NULL;
    void (*function)(void);
    memcpy(&function, &found, sizeof function);
    return function;
}
