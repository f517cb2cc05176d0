/* Requests of HTTP/1.1 (RFC 9112), as much of it as a page of our own needs: a line, header fields that are
 * passed over, and no body. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

enum { WATCH_REQUEST_CAPACITY = 8192, WATCH_TARGET_CAPACITY = 256 };

typedef enum watch_request_state {
    WATCH_REQUEST_PARTIAL, /* more bytes are wanted */
    WATCH_REQUEST_WHOLE,
    WATCH_REQUEST_BAD
} watch_request_state;

typedef enum watch_method { WATCH_GET, WATCH_HEAD, WATCH_POST, WATCH_OTHER } watch_method;

typedef struct watch_request {
    watch_method method;
    char target[WATCH_TARGET_CAPACITY]; /* begins with '/'; visible ASCII */
    int status;                         /* of a bad request: what it is answered with */
} watch_request;

/* Reads a request from bytes[size], which may come to WATCH_REQUEST_CAPACITY. */
watch_request_state watch_request_read(size_t size, const char *bytes, watch_request *request);

/* The words that belong to a status: "Not Found". */
const char *watch_status_words(int status);
