#include "program/import/writer.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/text.h"

static void put(writer *self, char kind, const char *text) {
    fputc(kind, self->records);
    fwrite(text, 1, strlen(text) + 1, self->records);
}

static void set_list(writer *self, const char *name, const char *format, va_list arguments) {
    enum { LONGEST = 8192 }; /* file names are shorter */
    char text[LONGEST];
    aur_format_list(text, sizeof text, format, arguments);
    put(self, AUR_IMPORT_ATTRIBUTE, name);
    fwrite(text, 1, strlen(text) + 1, self->records);
}

void writer_set(writer *self, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    set_list(self, name, format, arguments);
    va_end(arguments);
}

void writer_open(writer *self, const char *tag, const char *type) {
    put(self, AUR_IMPORT_ELEMENT, tag);
    if (type != NULL)
        writer_set(self, "type", "%s", type);
}

void writer_close(writer *self) {
    put(self, AUR_IMPORT_END, "");
}

void writer_property(writer *self, const char *tag, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    writer_open(self, tag, NULL);
    writer_set(self, "name", "%s", name);
    set_list(self, "value", format, arguments);
    writer_close(self);
    va_end(arguments);
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

unsigned writer_add_image_file(writer *self, size_t size, const void *data) {
    char *answer;
    stream_send(AUR_IMPORT_IMAGE, 0, size, data);
    const bool good = stream_receive(AUR_IMPORT_ANSWER, &size, &answer) != 0;
    free(answer);
    return good ? self->first + self->files++ : NO_FILE;
}
