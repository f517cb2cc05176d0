#include "points/base/io.h"

static _Thread_local const aur_io *here;

const aur_io *aur_io_use(const aur_io *io) {
    const aur_io *const before = here;
    here = io;
    return before;
}

const aur_io *aur_io_here(void) {
    return here;
}

bool aur_io_leads(void) {
    return here == NULL || here->rank == 0;
}

aur_result aur_io_agree(size_t size, void *data, aur_error *error) {
    return here != NULL ? here->agree(here->user, size, data, error) : AUR_OK;
}
