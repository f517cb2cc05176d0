/* What aureole-scenes makes: one row a file in the table of main.c. */
#pragma once

#include <aureole-render/image.h>

#include "mesh.h"

typedef struct product {
    const char *file;    /* its name in the folder */
    const char *summary; /* one line */
    void (*build)(mesh *m);
    aur_result (*paint)(aur_image **image, aur_error *error); /* instead of build: a picture */
} product;
