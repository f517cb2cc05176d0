#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* dladdr */
#endif
#include "points/base/file.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* The folder of the library that contains this code, with the slash; empty if unknown. */
static void find_folder(char folder[PATH_MAX]) {
    static const char here = 0;
    Dl_info info;
    folder[0] = '\0';
    if (dladdr(&here, &info) != 0 && info.dli_fname != NULL)
        snprintf(folder, PATH_MAX, "%s", info.dli_fname);
    if (strchr(folder, '/') == NULL) { /* this code is in a program found in PATH */
        const ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
        folder[length > 0 ? length : 0] = '\0';
    }
    char *const slash = strrchr(folder, '/');
    *(slash != NULL ? slash + 1 : folder) = '\0';
}

static void *open_module(const char *file, int mode) {
    char folder[PATH_MAX], path[PATH_MAX + NAME_MAX];
    find_folder(folder);
    snprintf(path, sizeof path, "%s%s", folder, file);
    void *const module = dlopen(path, mode);
    return module != NULL ? module : dlopen(file, mode);
}

bool aur_module_find_program(const char *file, size_t capacity, char *path) {
    /* In the build folder and in a wheel; installed; installed next to a static program. */
    static const char *const folders[] = {"", "aureole/", "../lib/aureole/"};
    char folder[PATH_MAX];
    find_folder(folder);
    for (size_t i = 0; folder[0] != '\0' && i < sizeof folders / sizeof folders[0]; ++i) {
        const int length = snprintf(path, capacity, "%s%s%s", folder, folders[i], file);
        if (length > 0 && (size_t)length < capacity && access(path, X_OK) == 0)
            return true;
    }
    return false;
}

void (*aur_module_find(const char *file, const char *symbol, bool global))(void) {
    void *const module = open_module(file, RTLD_NOW | (global ? RTLD_GLOBAL : RTLD_LOCAL));
    void *const found = module != NULL ? dlsym(module, symbol) : NULL;
    void (*function)(void);
    memcpy(&function, &found, sizeof function);
    return function;
}
