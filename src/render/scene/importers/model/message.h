/* What the library and the program aureole-import, which reads models by assimp, send to each other through a
 * socket. Each message is a header and `size` bytes. Both come from one build: the first message names the
 * version, and numbers are as the machine has them. */
#pragma once

#include <stdint.h>

typedef enum aur_import_kind {
    /* From the library. */
    AUR_IMPORT_START = 1, /* value: number of the first part; four texts, each with its zero byte: version,
                             name of the model, time in seconds or "", variant or "" */
    AUR_IMPORT_ANSWER,    /* to OPEN, FIND and PICTURE; value: whether it is there; bytes: what it is */
    /* From the program. */
    AUR_IMPORT_OPEN,    /* a name: asks for the bytes of a file that the model names, or of its own */
    AUR_IMPORT_FIND,    /* a name: asks under which name an image can be read */
    AUR_IMPORT_MESH,    /* a part: a PLY file. Parts are numbered as they come */
    AUR_IMPORT_PICTURE, /* a part: an image file; asks whether it can be read: if not, it is no part */
    AUR_IMPORT_NOTE,    /* a warning */
    AUR_IMPORT_FAIL,    /* value: -result; a text for a person */
    AUR_IMPORT_SCENE    /* an aur_import_camera, and records of the scene's elements; the last message */
} aur_import_kind;

/* Elements are records: texts that begin with one of these characters and end with a zero byte. */
enum {
    AUR_IMPORT_ELEMENT = '<',   /* a tag: an element inside of those that are open, open until its END */
    AUR_IMPORT_ATTRIBUTE = '=', /* a name, and its value in one more text */
    AUR_IMPORT_END = '>'
};

typedef struct aur_import_header {
    uint32_t kind, value;
    uint64_t size;
} aur_import_header;

typedef struct aur_import_camera {
    double origin[3], direction[3], up[3]; /* in the world */
    double angle;                          /* of view across the axis that is meant, in degrees */
    double half_width;                     /* of an orthographic image, in the world; 0: in perspective */
    double aspect;                         /* width by height; 0: unknown */
    uint32_t angle_is_vertical;
    uint32_t is_there;
} aur_import_camera;
