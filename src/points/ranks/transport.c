/* MPI is in a module next to the library, which is loaded when several processes were started. In builds
 * without MPI this file is the same and finds no module. */
#include "points/base/file.h"
#include "points/ranks/ranks.h"

aur_result aur_transport_find(aur_transport *transport, aur_error *error) {
    /* Components that MPI loads need its symbols. */
    const aur_transport_open_function open =
        (aur_transport_open_function)aur_module_find(AUR_TRANSPORT_MODULE, "aur_transport_open", true);
    if (open == NULL)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "started with several ranks, but built without MPI: render parts by '--shard i/n' and put "
            "them together by 'aureole merge'");
    return open(transport, error);
}
