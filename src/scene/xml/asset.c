/* Where the files are that a scene names, and what to say when they are not there. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/file.h"
#include "scene/xml/xml.h"

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

/* Looks for the name in one folder after the other, and notes which they were. NULL when it is in none. */
static char *search(const aur_xml_document *document, aur_location location, const char *name, char *places,
                    size_t capacity) {
    const size_t beside = folder_length(location.file);
    char *found = join(location.file, beside, name);
    note(places, capacity, location.file, beside);
    if (found == NULL && document->root != NULL) {
        const char *const main_file = document->root->location.file;
        const size_t length = folder_length(main_file);
        if (length != beside || strncmp(main_file, location.file, length) != 0) {
            found = join(main_file, length, name);
            note(places, capacity, main_file, length);
        }
    }
    for (const aur_xml_folder *folder = document->folders; found == NULL && folder != NULL;
         folder = folder->next) {
        found = join(folder->path, strlen(folder->path), name);
        note(places, capacity, folder->path, strlen(folder->path));
    }
    if (found == NULL) { /* as Mitsuba: at last where the user is, for files named by -D */
        found = join("", 0, name);
        note(places, capacity, "", 0);
    }
    return found;
}

static aur_result find(const aur_xml_document *document, aur_location location, const char *name,
                       char **found, aur_error *error) {
    *found = NULL;
    char places[700] = "";
    if (name[0] == '\0')
        return aur_fail_at(error, location, AUR_ERROR_FORMAT, "a file name is empty");
    *found = name[0] == '/' ? join("", 0, name) : search(document, location, name, places, sizeof places);
    if (*found != NULL)
        return AUR_OK;
    if (name[0] == '/')
        return aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'", name);
    char command[160];
    bool made = read_command(location.file, folder_length(location.file), name, command, sizeof command);
    for (const aur_xml_folder *folder = document->folders; !made && folder != NULL; folder = folder->next)
        made = read_command(folder->path, strlen(folder->path), name, command, sizeof command);
    if (made)
        return aur_fail_at(error, location, AUR_ERROR_OPEN,
                           "cannot find '%s'; it is made by the command: %s (looked in %s)", name, command,
                           places);
    return aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'; looked in %s", name, places);
}

aur_result aur_xml_find_asset(const aur_xml_document *document, aur_location location, const char *name,
                              char **found, aur_error *error) {
    const aur_result result = find(document, location, name, found, error);
    struct stat status;
    if (result != AUR_OK || (stat(*found, &status) == 0 && S_ISREG(status.st_mode)))
        return result;
    free(*found);
    *found = NULL;
    return aur_fail_at(error, location, AUR_ERROR_OPEN,
                       "'%s' is no regular file: a scene may name no folders, devices or pipes", name);
}

aur_result aur_xml_find_folder(const aur_xml_document *document, aur_location location, const char *name,
                               char **found, aur_error *error) {
    return find(document, location, name, found, error);
}

aur_result aur_xml_find_set(const aur_xml_document *document, aur_location location, const char *set,
                            char **found, aur_error *error) {
    /* file:PATH, and the value of a key `file` */
    const char *start = strncmp(set, "file:", 5) == 0 ? set + 5 : NULL;
    for (const char *c = strstr(set, "file="); start == NULL && c != NULL; c = strstr(c + 1, "file="))
        start = c > set && (c[-1] == ':' || c[-1] == ',') ? c + 5 : NULL;
    const size_t length = start == NULL ? 0 : start[-1] == ':' ? strlen(start) : strcspn(start, ",");
    const size_t head = start == NULL ? strlen(set) : (size_t)(start - set);
    char *const name = start != NULL ? strndup(start, length) : strdup("");
    char *path = NULL;
    aur_result result = name != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK && start != NULL)
        result = aur_xml_find_asset(document, location, name, &path, error);
    free(name);
    if (result != AUR_OK)
        return result;
    const size_t size = strlen(set) + (path != NULL ? strlen(path) : 0) + 1;
    *found = malloc(size);
    if (*found != NULL)
        snprintf(*found, size, "%.*s%s%s", (int)head, set, path != NULL ? path : "",
                 start != NULL ? start + length : "");
    free(path);
    return *found != NULL ? AUR_OK : aur_fail_memory(error);
}
