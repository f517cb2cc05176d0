#include "points/sphere/repulsion/push_body.h"

aur_push aur_push_portable(const aur_charges *charges, size_t index, size_t first, size_t last) {
    return push(charges, index, first, last);
}
