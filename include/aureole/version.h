/* The version of these headers, for the preprocessor. CMake reads the three numbers from here, their only
 * source. aur_version() returns the version of the library in use. */
#ifndef AUREOLE_VERSION_H
#define AUREOLE_VERSION_H

#define AUREOLE_VERSION_MAJOR 0
#define AUREOLE_VERSION_MINOR 2
#define AUREOLE_VERSION_PATCH 0

/* One number that grows with the version: 0xMMmmpp. */
#define AUREOLE_VERSION_NUMBER                                                                               \
    (AUREOLE_VERSION_MAJOR * 0x10000 + AUREOLE_VERSION_MINOR * 0x100 + AUREOLE_VERSION_PATCH)

#endif
