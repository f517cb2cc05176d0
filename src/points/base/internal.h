/* Marks what a library shows to the other libraries of this tree. Such names have a symbol version of one
 * release, so that no other program can come to depend on them, and public headers have none of them. */
#pragma once

#include <aureole/core.h>

#define AUR_INTERNAL AUR_API
