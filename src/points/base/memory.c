#include "points/base/memory.h"

#include <stdint.h>
#include <unistd.h>

double aur_machine_memory(void) {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGESIZE);
    return pages > 0 && page_size > 0 ? (double)pages * (double)page_size : 0.5 * (double)SIZE_MAX;
}
