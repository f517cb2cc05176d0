/* The picture sent to an image viewer on the network, by the protocol of tev (Müller), which pbrt-v4 speaks
 * too: little-endian packets over TCP, each the count of its bytes (uint32), a kind (uint8) and what belongs
 * to it. */
#pragma once

#include <aureole-render/image.h>

typedef struct watch_display watch_display;

/* Connects to "PORT" or "HOST:PORT"; `name` is the picture's there, where an earlier one of that name is
 * closed. Errors: ARGUMENT, OPEN, MEMORY. */
aur_result watch_display_create(const char *where, const char *name, watch_display **display,
                                aur_error *error);
void watch_display_destroy(watch_display *display); /* NULL is allowed */

/* Whether another picture would be sent at once. */
bool watch_display_is_free(watch_display *display);
/* Sends what has changed since the last picture; takes the picture over. From any thread. */
void watch_display_show(watch_display *display, aur_image *image);
/* Waits until all is sent or nothing can be; then nothing more is to be shown. */
void watch_display_finish(watch_display *display);
/* Why nothing is sent any more: text[capacity]; false where all is well. */
bool watch_display_has_failed(watch_display *display, size_t capacity, char *text);
