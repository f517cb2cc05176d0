#include <inttypes.h>
#include <math.h>

#include "points/base/text.h"

static void write_string(FILE *stream, const char *text) {
    fputc('"', stream);
    for (const char *c = text; *c != '\0'; ++c) {
        const unsigned char letter = (unsigned char)*c;
        if (letter == '"' || letter == '\\')
            fprintf(stream, "\\%c", letter);
        else if (letter < 0x20)
            fprintf(stream, "\\u%04x", letter);
        else
            fputc(letter, stream);
    }
    fputc('"', stream);
}

static uint64_t level(const aur_json *json) {
    return UINT64_C(1) << (json->depth & 63);
}

static void start_line(aur_json *json) {
    fputc('\n', json->stream);
    for (size_t i = 0; i < json->depth; ++i)
        fputs("  ", json->stream);
}

/* Writes the separator before a member: nothing after its name, else a comma and a line break as needed. */
static void begin_member(aur_json *json) {
    if (json->named || json->depth == 0) {
        json->named = false;
        return;
    }
    const bool line = (json->lines & level(json)) != 0;
    if ((json->members & level(json)) != 0)
        fputs(line ? "," : ", ", json->stream);
    if (line)
        start_line(json);
    json->members |= level(json);
}

void aur_json_open(aur_json *json, char bracket, bool lines) {
    begin_member(json);
    fputc(bracket, json->stream);
    ++json->depth;
    json->members &= ~level(json);
    json->lines = lines ? json->lines | level(json) : json->lines & ~level(json);
}

void aur_json_close(aur_json *json, char bracket) {
    const bool line = (json->lines & json->members & level(json)) != 0;
    --json->depth;
    if (line)
        start_line(json);
    fputc(bracket, json->stream);
    if (json->depth == 0)
        fputc('\n', json->stream);
}

void aur_json_name(aur_json *json, const char *name) {
    begin_member(json);
    write_string(json->stream, name);
    fputs(": ", json->stream);
    json->named = true;
}

void aur_json_string(aur_json *json, const char *text) {
    begin_member(json);
    write_string(json->stream, text);
}

void aur_json_number(aur_json *json, double value) {
    begin_member(json);
    if (isfinite(value))
        aur_print(json->stream, "%.17g", value);
    else
        fputs("null", json->stream);
}

void aur_json_integer(aur_json *json, uint64_t value) {
    begin_member(json);
    fprintf(json->stream, "%" PRIu64, value);
}

void aur_json_boolean(aur_json *json, bool value) {
    begin_member(json);
    fputs(value ? "true" : "false", json->stream);
}
