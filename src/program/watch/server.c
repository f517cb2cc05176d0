#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* dladdr */
#endif
#include "program/watch/server.h"

#include <aureole/core.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

#include <aureole/text.h>

/* In the folder of the library, or of the program if linked statically; otherwise from the system. An rpath
 * alone is not enough: sanitizers intercept dlopen. */
static void *open_module(const char *file) {
    const char *(*const inside)(void) = aur_version;
    void *address;
    Dl_info info;
    char path[PATH_MAX] = "";
    memcpy(&address, &inside, sizeof address);
    if (dladdr(address, &info) != 0 && info.dli_fname != NULL && strrchr(info.dli_fname, '/') != NULL)
        aur_format(path, sizeof path, "%.*s/%s", (int)(strrchr(info.dli_fname, '/') - info.dli_fname),
                   info.dli_fname, file);
    void *const module = path[0] != '\0' ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    return module != NULL ? module : dlopen(file, RTLD_NOW | RTLD_LOCAL);
}

/* Stays loaded until the process ends. */
static const watch_server_module *find_module(void) {
    void *const module = open_module("aureole-serve.so");
    return module != NULL ? dlsym(module, "aureole_serve") : NULL;
}

aur_result watch_server_create(const char *option, watch_endpoint *endpoint, watch_handler *handler,
                               void *user, watch_server **server, aur_error *error) {
    const watch_server_module *const module = find_module();
    if (module == NULL) {
        const char *const why = dlerror();
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "--%s needs the module aureole-serve.so in the folder of the libraries: %s", option,
                        why != NULL ? why : "it is of another version");
    }
    int listener = -1;
    const aur_result result = watch_listen(option, endpoint, &listener, error);
    if (result != AUR_OK)
        return result;
    if (!module->create(listener, handler, user, server))
        return aur_fail(error, AUR_ERROR_OPEN, "--%s: cannot serve: %s", option, strerror(errno));
    return AUR_OK;
}

void watch_server_wake(watch_server *server) {
    if (server != NULL)
        server->module->wake(server);
}

void watch_server_destroy(watch_server *server) {
    if (server != NULL)
        server->module->destroy(server);
}
