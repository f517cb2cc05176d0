#include "program/cli/listing.h"

#include <stdio.h>
#include <string.h>

/* The word to complete. The first `done` characters are fixed, because candidates continue after them: "--
 * metric=", "energy,", "finalgather:photons=". */
typedef struct partial {
    const char *typed;
    size_t done;
} partial;

static void offer(const partial *word, const char *name, size_t length, const char *help) {
    const char *const rest = word->typed + word->done;
    if (strncmp(name, rest, strlen(rest)) == 0)
        printf("%.*s%.*s\t%s\n", (int)word->done, word->typed, (int)length, name, help);
}

static void offer_name(const partial *word, const char *name, const char *help) {
    offer(word, name, strlen(name), help);
}

/* Moves the fixed part to the last of some characters. */
static partial after_last(partial word, const char *characters) {
    for (size_t i = word.done; word.typed[i] != '\0'; ++i)
        if (strchr(characters, word.typed[i]) != NULL)
            word.done = i + 1;
    return word;
}

static void offer_commands(const partial *word, const cli_command *const *commands) {
    for (; *commands != NULL; ++commands)
        offer_name(word, (*commands)->name, (*commands)->summary);
}

/* Offers the keys of a row, or the values of a key. */
static void offer_keys(const partial *word, const aur_row *row) {
    const partial value = after_last(*word, "=");
    for (size_t i = 0; row != NULL && aur_row_key(row, i) != NULL; ++i) {
        const aur_key *const key = aur_row_key(row, i);
        const size_t length = strlen(key->name);
        char text[128];
        snprintf(text, sizeof text, "%s=", key->name);
        if (value.done == word->done)
            offer_name(word, text, key->help);
        if (value.done != word->done + length + 1 || strncmp(word->typed + word->done, text, length + 1) != 0)
            continue;
        for (size_t k = 0; key->words != NULL && key->words[k] != NULL; ++k)
            offer_name(&value, key->words[k], key->help);
        for (size_t k = 0; key->type == AUR_KEY_BOOLEAN && k < 2; ++k)
            offer_name(&value, k == 0 ? "true" : "false", key->help);
    }
}

/* Offers the rows of a kind, and after NAME: its keys. */
static void offer_rows(const partial *word, const aur_table *kind) {
    const char *const name = word->typed + word->done;
    const size_t length = strcspn(name, ":");
    const partial key = name[length] == ':' ? after_last(*word, ":,") : *word;
    for (size_t i = 0; i < kind->count; ++i) {
        const aur_row *const row = kind->rows[i];
        if (key.done == word->done)
            offer_name(word, row->name, row->summary);
        else if (strlen(row->name) == length && strncmp(row->name, name, length) == 0)
            offer_keys(&key, row);
    }
    if (key.done != word->done)
        offer_keys(&key, kind->common);
}

/* `content` is "file", "folder", a kind, or "file" and a kind. */
static void offer_content(const partial *word, const char *content) {
    if (strcmp(content, "folder") == 0)
        puts(":folder");
    else if (strncmp(content, "file", 4) == 0)
        puts(":file");
    const char *const last = strrchr(content, ' ');
    const char *const name = last != NULL ? last + 1 : content;
    char of_lab[64]; /* options also accept the lab's rows of the kind */
    snprintf(of_lab, sizeof of_lab, "lab-%s", name);
    const aur_table *const kinds[] = {cli_find_table(name), cli_find_table(of_lab)};
    for (size_t i = 0; i < 2; ++i)
        if (kinds[i] != NULL)
            offer_rows(word, kinds[i]);
}

static void offer_values(partial word, const cli_option *option) {
    if (option->list)
        word = after_last(word, ",");
    for (unsigned i = 0; cli_option_name(option, i) != NULL; ++i) {
        const char *const name = cli_option_name(option, i);
        const size_t length = strcspn(name, ":"); /* "phong:M": the parameter cannot be completed */
        offer(&word, name, length + (name[length] == ':'), option->key.help);
    }
    if (option->content != NULL)
        offer_content(&word, option->content);
}

static void offer_options(const partial *word, const cli_command *command) {
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(command, i, NULL)) != NULL; ++i) {
        char text[64];
        snprintf(text, sizeof text, "%s%s", option->key.name[1] != '\0' ? "--" : "-", option->key.name);
        offer_name(word, text, option->key.help);
    }
    offer_name(word, "--help", "print the options");
}

static void offer_operands(const partial *word, const cli_command *const *commands,
                           const cli_command *command, size_t count, const char *before) {
    const cli_operand *operand = command->operands;
    for (size_t i = 0; i < count && operand->word != NULL; ++i)
        operand += !operand->repeated;
    const char *const content = operand->word != NULL && operand->content != NULL ? operand->content : "";
    for (unsigned i = 0; operand->name != NULL && operand->name(i) != NULL; ++i)
        offer_name(word, operand->name(i), operand->help);
    const bool topic = strcmp(content, "topic") == 0, row = strcmp(content, "row") == 0;
    if (topic || strcmp(content, "command") == 0 || (row && strcmp(before, "command") == 0))
        offer_commands(word, commands);
    for (size_t i = 0; topic && cli_table_at(i) != NULL; ++i)
        offer_name(word, cli_table_at(i)->kind, cli_table_at(i)->summary);
    offer_content(word, row ? before : content);
}

/* The option at the end of an argument such as "--seed", "-n" or "-qn", or NULL; its value follows unless it
 * is a flag. */
static const cli_option *option_of(const cli_command *command, const char *text, size_t length) {
    const bool is_long = text[0] == '-' && text[1] == '-';
    const cli_option *option;
    for (size_t i = 0; (option = cli_option_at(command, i, NULL)) != NULL; ++i) {
        const char *const name = option->key.name;
        const char letter = name[1] == '\0' ? name[0] : option->letter;
        if (is_long ? strlen(name) == length - 2 && strncmp(name, text + 2, length - 2) == 0
                    : length > 1 && letter == text[length - 1])
            return option;
    }
    return NULL;
}

void cli_complete(const cli_command *const *commands, size_t count, char **words) {
    if (count == 0)
        return;
    const partial word = {.typed = words[count - 1]};
    if (count == 1) {
        offer_commands(&word, commands);
        offer_name(&word, "--help", "the commands");
        offer_name(&word, "--version", "print the version of the library");
        return;
    }
    const cli_command *const *found = commands;
    while (*found != NULL && strcmp((*found)->name, words[0]) != 0)
        ++found;
    const cli_command *const command = *found;
    if (command == NULL)
        return;
    const char *before = ""; /* the previous operand */
    size_t operands = 0;
    bool ended = false; /* after "--" */
    for (size_t i = 1; i + 1 < count; ++i) {
        const bool dashed = !ended && words[i][0] == '-' && words[i][1] != '\0';
        const cli_option *const option = dashed ? option_of(command, words[i], strlen(words[i])) : NULL;
        ended = ended || strcmp(words[i], "--") == 0;
        const bool follows = option != NULL && option->value != NULL && !option->value_is_optional;
        if (follows && ++i + 1 == count) {
            offer_values(word, option);
            return;
        }
        if (dashed)
            continue;
        before = words[i];
        ++operands;
    }
    const size_t length = strcspn(word.typed, "=");
    const cli_option *const option =
        !ended && word.typed[length] == '=' ? option_of(command, word.typed, length) : NULL;
    if (option != NULL && word.typed[1] == '-')
        offer_values((partial){word.typed, length + 1}, option);
    else if (!ended && word.typed[0] == '-')
        offer_options(&word, command);
    else
        offer_operands(&word, commands, command, operands, before);
}
