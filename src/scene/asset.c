/* Where the files are that a scene names, and what to say when they are not there. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "scene/xml.h"

/* folder + name, or NULL when that is no file or memory is out. `folder` ends at its last slash. */
static char *join(const char *folder, size_t folder_length, const char *name) {
    const size_t size = folder_length + strlen(name) + 2;
    char *const path = malloc(size);
    if (path == NULL)
        return NULL;
    const bool slash = folder_length > 0 && folder[folder_length - 1] != '/';
    snprintf(path, size, "%.*s%s%s", (int)folder_length, folder, slash ? "/" : "", name);
    struct stat status;
    if (stat(path, &status) == 0)
        return path;
    free(path);
    return NULL;
}

static size_t folder_length(const char *file) {
    const char *const slash = strrchr(file, '/');
    return slash != NULL ? (size_t)(slash - file) + 1 : 0;
}

/* Adds a folder to the list of places in an error message. */
static void note(char *places, size_t capacity, const char *folder, size_t length) {
    char piece[512];
    snprintf(piece, sizeof piece, "%.*s", (int)length, length > 0 ? folder : "");
    const size_t used = strlen(places);
    snprintf(places + used, capacity - used, "%s%s", used > 0 ? ", " : "", length > 0 ? piece : "./");
}

/* A folder for files that are made when they are first needed holds a text HOW-TO-MAKE whose first line is
 * the command that makes them. Finds the one beside `name` in a folder where it was looked for. */
static bool read_command(const char *folder, size_t length, const char *name, char *command,
                         size_t capacity) {
    static const char *const file = "HOW-TO-MAKE";
    char beside[AUR_ERROR_FILE_CAPACITY];
    const int written = snprintf(beside, sizeof beside, "%.*s%s", (int)folder_length(name), name, file);
    char *const path = written < (int)sizeof beside ? join(folder, length, beside) : NULL;
    char *text = NULL;
    size_t size = 0;
    const bool read = path != NULL && aur_file_read(path, 1 << 16, &text, &size, NULL) == AUR_OK;
    free(path);
    if (!read)
        return false;
    size_t end = 0;
    while (end < size && end + 1 < capacity && isprint((unsigned char)text[end]))
        ++end;
    memcpy(command, text, end);
    command[end] = '\0';
    free(text);
    return end > 0;
}

aur_result aur_xml_find_asset(const aur_xml_document *document, aur_location location, const char *name,
                              char **found, aur_error *error) {
    *found = NULL;
    char places[700] = "";
    if (name[0] == '\0')
        return aur_fail_at(error, location, AUR_ERROR_FORMAT, "a file name is empty");
    if (name[0] == '/') {
        *found = join("", 0, name);
        return *found != NULL ? AUR_OK
                              : aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'", name);
    }
    const size_t beside = folder_length(location.file);
    *found = join(location.file, beside, name);
    note(places, sizeof places, location.file, beside);
    if (*found == NULL && document->root != NULL) {
        const char *const main_file = document->root->location.file;
        const size_t length = folder_length(main_file);
        if (length != beside || strncmp(main_file, location.file, length) != 0) {
            *found = join(main_file, length, name);
            note(places, sizeof places, main_file, length);
        }
    }
    for (const aur_xml_folder *folder = document->folders; *found == NULL && folder != NULL;
         folder = folder->next) {
        *found = join(folder->path, strlen(folder->path), name);
        note(places, sizeof places, folder->path, strlen(folder->path));
    }
    if (*found == NULL) { /* as Mitsuba: at last where the user is, for files named by -D */
        *found = join("", 0, name);
        note(places, sizeof places, "", 0);
    }
    if (*found != NULL)
        return AUR_OK;
    char command[160];
    bool made = read_command(location.file, beside, name, command, sizeof command);
    for (const aur_xml_folder *folder = document->folders; !made && folder != NULL; folder = folder->next)
        made = read_command(folder->path, strlen(folder->path), name, command, sizeof command);
    if (made)
        return aur_fail_at(error, location, AUR_ERROR_OPEN,
                           "cannot find '%s'; it is made by the command: %s (looked in %s)", name, command,
                           places);
    return aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'; looked in %s", name, places);
}
