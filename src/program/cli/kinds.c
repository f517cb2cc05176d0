#include "program/cli/listing.h"

#include <ctype.h>
#include <string.h>
#include <unistd.h>

const aur_table *cli_table_at(size_t index) {
    size_t count = 0;
    while (aur_table_at(count) != NULL)
        ++count;
    return index < count ? aur_table_at(index) : cli_render_table_at(index - count);
}

const aur_table *cli_find_table(const char *kind) {
    for (size_t i = 0; cli_table_at(i) != NULL; ++i) {
        const aur_table *const table = cli_table_at(i);
        const size_t length = strlen(table->kind);
        if (strncmp(table->kind, kind, length) == 0 &&
            (kind[length] == '\0' || strcmp(kind + length, "s") == 0))
            return table;
    }
    return NULL;
}

static char fold(char c) {
    return (char)(c == '_' ? '-' : tolower((unsigned char)c));
}

static void forgive(const char *content, char *text) {
    const char *const last = strrchr(content, ' ');
    const aur_table *const kind = cli_find_table(last != NULL ? last + 1 : content);
    const size_t length = strcspn(text, ":");
    for (size_t i = 0; kind != NULL && i < kind->count; ++i) {
        const char *const name = kind->rows[i]->name;
        size_t same = 0;
        while (same < length && fold(text[same]) == name[same])
            ++same;
        if (same < length || name[same] != '\0')
            continue;
        if (last == NULL || access(text, F_OK) != 0)
            memcpy(text, name, length);
        return;
    }
}

void cli_forgive_names(cli_call *call) {
    const cli_operand *operand = call->command->operands;
    for (size_t i = 0; i < call->operand_count && operand->word != NULL; ++i) {
        if (operand->content != NULL)
            forgive(operand->content, call->operands[i]);
        operand += !operand->repeated;
    }
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(call->command, i, NULL)) != NULL; ++i)
        if (option->content != NULL && !option->list && call->texts[i] != NULL)
            forgive(option->content, (char *)call->texts[i]);
}
