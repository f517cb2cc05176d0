#include "program/import/writer.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"
#include "program/import/stream.h"

void writer_put(writer *self, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    fwrite(text, 1, length < (int)sizeof text ? (size_t)length : sizeof text - 1, self->xml);
}

void writer_put_escaped(writer *self, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; ++c) {
        if (*c == '$')
            fputs("\\$", self->xml);
        else if (*c < 32 || strchr("&<>\"'", *c) != NULL)
            fprintf(self->xml, "&#%u;", (unsigned)*c);
        else
            fputc(*c, self->xml);
    }
}

void writer_note(const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    stream_send(AUR_IMPORT_NOTE, 0, strlen(text), text);
}

unsigned writer_add_mesh_file(writer *self, size_t size, const void *data) {
    stream_send(AUR_IMPORT_MESH, 0, size, data);
    return self->first + self->files++;
}

unsigned writer_add_picture_file(writer *self, size_t size, const void *data) {
    char *answer;
    stream_send(AUR_IMPORT_PICTURE, 0, size, data);
    const bool good = stream_receive(AUR_IMPORT_ANSWER, &size, &answer) != 0;
    free(answer);
    return good ? self->first + self->files++ : NO_FILE;
}
