#include "program/watch/server.h"

#include <dlfcn.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

/* Found by the run path of the program, which is where the libraries are; loaded once, for the whole process.
 */
static const watch_server_module *find_module(void) {
    void *const module = dlopen("aureole-serve.so", RTLD_NOW | RTLD_LOCAL);
    return module != NULL ? dlsym(module, "aureole_serve") : NULL;
}

aur_result watch_server_create(const char *option, watch_place *place, watch_handler *handler, void *user,
                               watch_server **server, aur_error *error) {
    const watch_server_module *const module = find_module();
    if (module == NULL) {
        const char *const why = dlerror();
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "--%s needs the module aureole-serve.so beside the libraries: %s", option,
                        why != NULL ? why : "it is of another version");
    }
    int listener = -1;
    const aur_result result = watch_listen(option, place, &listener, error);
    if (result != AUR_OK)
        return result;
    if (!module->create(listener, handler, user, server))
        return aur_fail(error, AUR_ERROR_OPEN, "--%s: cannot serve: %s", option, strerror(errno));
    return AUR_OK;
}

void watch_server_wake(watch_server *server) {
    if (server != NULL)
        find_module()->wake(server);
}

void watch_server_destroy(watch_server *server) {
    if (server != NULL)
        find_module()->destroy(server);
}
