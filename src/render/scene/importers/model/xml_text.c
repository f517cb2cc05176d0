#include "render/scene/importers/model/xml_text.h"

#include <string.h>

#include "points/base/text.h"

void aur_model_put(FILE *xml, const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    aur_format_list(text, sizeof text, format, arguments);
    va_end(arguments);
    fputs(text, xml);
}

void aur_model_put_escaped(FILE *xml, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; ++c) {
        if (*c == '$')
            fputs("\\$", xml);
        else if (*c < 32 || strchr("&<>\"'", *c) != NULL)
            fprintf(xml, "&#%u;", (unsigned)*c);
        else
            fputc(*c, xml);
    }
}
