#include "program/watch/server.h"

#include <aureole/text.h>
#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

aur_result watch_endpoint_parse(const char *option, const char *text, watch_endpoint *endpoint,
                                aur_error *error) {
    if (text[0] == '\0')
        return AUR_OK;
    const char *const colon = strrchr(text, ':');
    const char *const port = colon != NULL ? colon + 1 : text;
    const char *host = text;
    size_t length = colon != NULL ? (size_t)(colon - text) : 0;
    const bool bracketed = length > 2 && host[0] == '[' && host[length - 1] == ']';
    if (bracketed) {
        ++host;
        length -= 2;
    }
    uint64_t number = 0;
    const bool good = aur_parse_integer(port, 65535, &number) && length < sizeof endpoint->host &&
                      (colon == NULL || length > 0) &&
                      (bracketed || colon == NULL || memchr(text, ':', length) == NULL);
    if (!good)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "--%s: expected PORT, HOST:PORT or [HOST]:PORT, with a port of at most 65535, not '%s'", option,
            text);
    endpoint->port = (unsigned)number;
    if (colon != NULL) {
        memcpy(endpoint->host, host, length);
        endpoint->host[length] = '\0';
    }
    return AUR_OK;
}

void watch_endpoint_format(const watch_endpoint *endpoint, size_t capacity, char *text) {
    const bool bracketed = strchr(endpoint->host, ':') != NULL;
    aur_format(text, capacity, "%s%s%s:%u", bracketed ? "[" : "", endpoint->host, bracketed ? "]" : "",
               endpoint->port);
}

typedef int socket_action(int socket, const struct sockaddr *address, socklen_t size);

static int bind_and_listen(int socket, const struct sockaddr *address, socklen_t size) {
    enum { QUEUE = 16 };
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    return bind(socket, address, size) != 0 ? -1 : listen(socket, QUEUE);
}

/* Applies the action to the first of a host's addresses that allows it. */
static aur_result open_socket(const char *option, const watch_endpoint *endpoint, bool passive,
                              socket_action *action, const char *failed, int *out, aur_error *error) {
    char port[12], name[WATCH_HOST_CAPACITY + 16];
    aur_format(port, sizeof port, "%u", endpoint->port);
    watch_endpoint_format(endpoint, sizeof name, name);
    const struct addrinfo hints = {.ai_socktype = SOCK_STREAM, .ai_flags = passive ? AI_PASSIVE : 0};
    struct addrinfo *found = NULL;
    const int status = getaddrinfo(endpoint->host, port, &hints, &found);
    if (status != 0)
        return aur_fail(error, AUR_ERROR_OPEN, "--%s: %s: %s", option, name,
                        status == EAI_SYSTEM ? strerror(errno) : gai_strerror(status));
    int result = -1, why = 0;
    for (const struct addrinfo *at = found; at != NULL && result < 0; at = at->ai_next) {
        const int opened = socket(at->ai_family, at->ai_socktype, at->ai_protocol);
        if (opened >= 0 && fcntl(opened, F_SETFD, FD_CLOEXEC) == 0 &&
            action(opened, at->ai_addr, at->ai_addrlen) == 0) {
            result = opened;
            continue;
        }
        why = errno;
        if (opened >= 0)
            close(opened);
    }
    freeaddrinfo(found);
    if (result < 0)
        return aur_fail(error, AUR_ERROR_OPEN, "--%s: %s %s: %s", option, failed, name, strerror(why));
    *out = result;
    return AUR_OK;
}

aur_result watch_listen(const char *option, watch_endpoint *endpoint, int *listener, aur_error *error) {
    const aur_result result =
        open_socket(option, endpoint, true, bind_and_listen, "cannot listen at", listener, error);
    struct sockaddr_storage address;
    socklen_t size = sizeof address;
    if (result != AUR_OK || getsockname(*listener, (struct sockaddr *)&address, &size) != 0)
        return result;
    if (address.ss_family == AF_INET)
        endpoint->port = ntohs(((const struct sockaddr_in *)&address)->sin_port);
    else if (address.ss_family == AF_INET6)
        endpoint->port = ntohs(((const struct sockaddr_in6 *)&address)->sin6_port);
    return AUR_OK;
}

/* Timeouts for connecting and sending. */
static int connect_soon(int socket, const struct sockaddr *address, socklen_t size) {
    const struct timeval patience = {.tv_sec = 10};
    setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    return connect(socket, address, size);
}

aur_result watch_connect(const char *option, const watch_endpoint *endpoint, int *connection,
                         aur_error *error) {
    return open_socket(option, endpoint, false, connect_soon, "cannot connect to", connection, error);
}
