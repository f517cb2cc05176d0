#include "watch/http.h"

#include <string.h>
#include <strings.h>

const char *watch_status_words(int status) {
    switch (status) {
    case 200:
        return "OK";
    case 400:
        return "Bad Request";
    case 404:
        return "Not Found";
    case 405:
        return "Method Not Allowed";
    case 413:
        return "Content Too Large";
    case 414:
        return "URI Too Long";
    case 431:
        return "Request Header Fields Too Large";
    case 503:
        return "Service Unavailable";
    case 505:
        return "HTTP Version Not Supported";
    default:
        return "Internal Server Error";
    }
}

static watch_request_state refuse(watch_request *request, int status) {
    request->status = status;
    return WATCH_REQUEST_BAD;
}

static const char *find(size_t size, const char *bytes, const char *text) {
    const size_t length = strlen(text);
    for (size_t i = 0; i + length <= size; ++i)
        if (memcmp(bytes + i, text, length) == 0)
            return bytes + i;
    return NULL;
}

static bool is_text(size_t size, const char *bytes, const char *text) {
    return size == strlen(text) && memcmp(bytes, text, size) == 0;
}

/* "GET /target HTTP/1.1" */
static watch_request_state read_line(size_t size, const char *line, watch_request *request) {
    const char *const first = memchr(line, ' ', size);
    const char *const second =
        first != NULL ? memchr(first + 1, ' ', size - (size_t)(first + 1 - line)) : NULL;
    if (second == NULL)
        return refuse(request, 400);
    const size_t method = (size_t)(first - line), target = (size_t)(second - first - 1);
    const size_t version = size - (size_t)(second + 1 - line);
    if (version != 8 || memcmp(second + 1, "HTTP/", 5) != 0)
        return refuse(request, 400);
    if (!is_text(version, second + 1, "HTTP/1.1") && !is_text(version, second + 1, "HTTP/1.0"))
        return refuse(request, 505);
    if (target >= WATCH_TARGET_CAPACITY)
        return refuse(request, 414);
    for (size_t i = 0; i < target; ++i)
        if (first[1 + i] <= ' ' || first[1 + i] > '~')
            return refuse(request, 400);
    if (target == 0 || first[1] != '/' || method == 0)
        return refuse(request, 400);
    memcpy(request->target, first + 1, target);
    request->target[target] = '\0';
    request->method = is_text(method, line, "GET")    ? WATCH_GET
                      : is_text(method, line, "HEAD") ? WATCH_HEAD
                      : is_text(method, line, "POST") ? WATCH_POST
                                                      : WATCH_OTHER;
    return WATCH_REQUEST_WHOLE;
}

/* "Name: value". Bodies are for nothing here. */
static int check_field(size_t size, const char *field) {
    const char *const colon = memchr(field, ':', size);
    if (colon == NULL || colon == field)
        return 400;
    for (const char *c = field; c < colon; ++c)
        if (*c <= ' ' || *c > '~')
            return 400;
    const size_t name = (size_t)(colon - field);
    const char *value = colon + 1, *const end = field + size;
    while (value < end && (*value == ' ' || *value == '\t'))
        ++value;
    if (name == strlen("Transfer-Encoding") && strncasecmp(field, "Transfer-Encoding", name) == 0)
        return 413;
    if (name == strlen("Content-Length") && strncasecmp(field, "Content-Length", name) == 0)
        return end - value == 1 && *value == '0' ? 0 : 413;
    return 0;
}

watch_request_state watch_request_read(size_t size, const char *bytes, watch_request *request) {
    *request = (watch_request){.method = WATCH_OTHER};
    const char *const end = find(size, bytes, "\r\n\r\n");
    if (end == NULL)
        return size < WATCH_REQUEST_CAPACITY ? WATCH_REQUEST_PARTIAL : refuse(request, 431);
    const size_t head = (size_t)(end - bytes);
    if (memchr(bytes, '\0', head) != NULL)
        return refuse(request, 400);
    const char *const first = find(head + 2, bytes, "\r\n");
    const watch_request_state state = read_line((size_t)(first - bytes), bytes, request);
    if (state != WATCH_REQUEST_WHOLE)
        return state;
    for (const char *field = first + 2; field < end;) {
        const char *const next = find((size_t)(end + 2 - field), field, "\r\n");
        const int status = check_field((size_t)(next - field), field);
        if (status != 0)
            return refuse(request, status);
        field = next + 2;
    }
    return WATCH_REQUEST_WHOLE;
}
