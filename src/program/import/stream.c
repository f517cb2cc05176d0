#include "program/import/writer.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SOCKET = STDIN_FILENO };

static void write_all(size_t size, const void *data) {
    for (size_t done = 0; done < size;) {
        const ssize_t count = write(SOCKET, (const char *)data + done, size - done);
        if (count < 0 && errno != EINTR)
            _exit(1);
        done += count > 0 ? (size_t)count : 0;
    }
}

static void read_all(size_t size, void *data) {
    for (size_t done = 0; done < size;) {
        const ssize_t count = read(SOCKET, (char *)data + done, size - done);
        if (count == 0 || (count < 0 && errno != EINTR))
            _exit(1);
        done += count > 0 ? (size_t)count : 0;
    }
}

void stream_send_two(aur_import_kind kind, size_t head_size, const void *head, size_t size,
                     const void *data) {
    const aur_import_header header = {.kind = kind, .size = head_size + size};
    write_all(sizeof header, &header);
    write_all(head_size, head);
    write_all(size, data);
}

void stream_send(aur_import_kind kind, uint32_t value, size_t size, const void *data) {
    const aur_import_header header = {kind, value, size};
    write_all(sizeof header, &header);
    write_all(size, data);
}

uint32_t stream_receive(aur_import_kind kind, size_t *size, char **data) {
    aur_import_header header;
    read_all(sizeof header, &header);
    if (header.kind != kind)
        _exit(1);
    *size = (size_t)header.size;
    *data = malloc(*size + 1);
    if (*data == NULL)
        stream_fail_memory();
    read_all(*size, *data);
    (*data)[*size] = '\0';
    return header.value;
}

void stream_fail(aur_result result, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    stream_send(AUR_IMPORT_FAIL, (uint32_t)-result, strlen(text), text);
    _exit(0);
}

void stream_fail_memory(void) {
    stream_fail(AUR_ERROR_MEMORY, "assimp needs more memory for it than the limit");
}
