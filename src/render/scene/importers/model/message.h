/* Protocol between the library and aureole-import, which reads models by assimp, over a socket. Each message
 * is a header and `size` bytes. Both programs come from the same build: the first message carries the
 * version, and numbers are in native format. */
#pragma once

#include <stdint.h>

typedef enum aur_import_kind {
    /* From the library: */
    AUR_IMPORT_START = 1, /* value: number of the first part; four texts, each with its zero byte: version,
                             name of the model, time in seconds or "", variant or "" */
    AUR_IMPORT_ANSWER,    /* to OPEN, FIND and IMAGE; value: whether it exists; bytes: its content or name */
    /* From the program: */
    AUR_IMPORT_OPEN, /* a name: requests the bytes of a file that the model references, or of the model itself
                      */
    AUR_IMPORT_FIND, /* a name: requests the name under which an image can be read */
    AUR_IMPORT_MESH, /* a part: a PLY file. Parts are numbered in the order sent */
    AUR_IMPORT_IMAGE, /* a part: an image file; requests whether it can be read. Unreadable images are not
                           parts */
    AUR_IMPORT_NOTE,  /* a warning */
    AUR_IMPORT_FAIL,  /* value: -result; a message for the user */
    AUR_IMPORT_SCENE  /* an aur_import_camera, and records of the scene's elements; the last message */
} aur_import_kind;

/* Elements are records: strings that begin with one of these characters and end with a zero byte. */
enum {
    AUR_IMPORT_ELEMENT = '<',   /* a tag: opens a child of the current element, until the matching END */
    AUR_IMPORT_ATTRIBUTE = '=', /* a name; its value is the next string */
    AUR_IMPORT_END = '>'
};

typedef struct aur_import_header {
    uint32_t kind, value;
    uint64_t size;
} aur_import_header;

typedef struct aur_import_camera {
    double origin[3], direction[3], up[3]; /* world coordinates */
    double angle;                          /* field of view in degrees across the axis in use */
    double half_width;                     /* size of an orthographic image, in world units; 0: perspective */
    double aspect;                         /* width over height; 0: unspecified */
    uint32_t angle_is_vertical;
    uint32_t is_there;
} aur_import_camera;
