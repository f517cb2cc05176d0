/* Requests that the page of a watched render is sent. */
#include "watch/http.h"

#include "fuzz.h"

/* Every status that the page answers with has words of its own. */
static void require_words(void) {
    static const int statuses[] = {200, 400, 404, 405, 413, 414, 431, 503, 505};
    for (size_t i = 0; i < sizeof statuses / sizeof statuses[0]; ++i)
        fuzz_require(strcmp(watch_status_words(statuses[i]), watch_status_words(500)) != 0,
                     "a status without words");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size > WATCH_REQUEST_CAPACITY)
        size = WATCH_REQUEST_CAPACITY;
    char *const bytes = malloc(size + 1); /* so that a byte beyond the end is seen */
    fuzz_require(bytes != NULL, "out of memory");
    if (size > 0)
        memcpy(bytes, data, size);
    require_words();
    watch_request request, earlier;
    const watch_request_state state = watch_request_read(size, bytes, &request);
    if (state == WATCH_REQUEST_WHOLE) {
        const size_t length = strlen(request.target);
        fuzz_require(length > 0 && length < WATCH_TARGET_CAPACITY && request.target[0] == '/',
                     "a bad target");
        for (size_t i = 0; i < length; ++i)
            fuzz_require(request.target[i] > ' ' && request.target[i] <= '~', "a target with other bytes");
    } else if (state == WATCH_REQUEST_BAD) {
        fuzz_require(request.status >= 400 && request.status < 600 &&
                         strcmp(watch_status_words(request.status), watch_status_words(500)) != 0,
                     "a refusal without a status");
    } else {
        fuzz_require(size < WATCH_REQUEST_CAPACITY, "a request that never ends");
    }
    /* Bytes that come one by one are the same request as soon as it is one. */
    for (size_t part = size > 40 ? size - 40 : 0; part < size; ++part)
        if (watch_request_read(part, bytes, &earlier) == WATCH_REQUEST_WHOLE)
            fuzz_require(state == WATCH_REQUEST_WHOLE && strcmp(earlier.target, request.target) == 0,
                         "a request that becomes another one");
    free(bytes);
    return 0;
}

static const char *const requests[] = {
    "GET /0123456789abcdef0123456789abcdef/ HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nAccept: */*\r\n\r\n",
    "GET /0123456789abcdef0123456789abcdef/state/4711/3 HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "HEAD /picture/0 HTTP/1.0\r\n\r\n",
    "POST /stop HTTP/1.1\r\nHost: a\r\nContent-Length: 0\r\n\r\n",
    "POST /stop HTTP/1.1\r\nHost: a\r\nContent-Length: 12\r\n\r\nsome content",
    "POST /stop HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
    "PUT /x HTTP/2.0\r\n\r\n",
    "GET http://elsewhere/ HTTP/1.1\r\n\r\n",
    "GET / HTTP/1.1\r\nno field\r\n\r\n",
    "GET / HTTP/1.1\r\nfield :x\r\n folded\r\n\r\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof requests / sizeof requests[0], requests, index, capacity, data);
}
