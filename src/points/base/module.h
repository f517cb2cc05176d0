/* Modules: what stands beside the libraries in a file of its own, so that only those who need it pay for what
 * it links. A build may lack one. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>
#include <stddef.h>

/* The function `symbol` of the module `file`, which is looked for in the folder of the library and then where
 * the system looks; NULL where there is none. `global`: what the module loads itself looks for its names. A
 * module stays loaded until the process ends. */
void (*aur_module_find(const char *file, const char *symbol, bool global))(void);

/* The path of a program of ours that stands beside the library; false where there is none. */
bool aur_module_find_program(const char *file, size_t capacity, char *path) AUR_NONNULL(1, 3);
