/* Places on the network: read from text, listened at, connected to. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

enum { WATCH_HOST_CAPACITY = 256 };

typedef struct watch_place {
    char host[WATCH_HOST_CAPACITY]; /* without brackets */
    unsigned port;
} watch_place;

/* Reads "PORT", "HOST:PORT" or "[HOST]:PORT"; without a host `place` keeps the one that it has, and with an
 * empty text its port too. `option` stands in messages. Errors: ARGUMENT. */
aur_result watch_place_read(const char *option, const char *text, watch_place *place, aur_error *error);

/* "127.0.0.1:8080", with brackets about a host that has colons. */
void watch_place_write(const watch_place *place, size_t capacity, char *text);

/* A socket that listens there, closed by the caller; port 0 becomes the free one that was found. Errors:
 * OPEN.
 */
aur_result watch_listen(const char *option, watch_place *place, int *listener, aur_error *error);
/* A socket that is connected. Errors: OPEN. */
aur_result watch_connect(const char *option, const watch_place *place, int *connection, aur_error *error);
