/* Search for the files that a scene references, and messages for missing ones. */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* realpath */
#endif
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/io.h"
#include "render/scene/importers/xml/xml.h"

/* The first `length` bytes of a path. */
typedef struct folder {
    size_t length;
    const char *path;
} folder;

/* The folder of a file: its path up to and including the last slash. */
static folder folder_of(const char *file) {
    const char *const slash = strrchr(file, '/');
    return (folder){slash != NULL ? (size_t)(slash - file) + 1 : 0, file};
}

/* Folder `index` of the search path: the folder of the referencing file, that of the scene, those of <path>,
 * and last, as in Mitsuba, the working folder, for files named by -D. False after the last. */
static bool folder_at(const aur_xml_document *document, const char *file, size_t index, folder *at) {
    *at = (folder){0, ""};
    if (index == 0)
        *at = folder_of(file);
    else if (index == 1)
        *at = folder_of(document->tree.root != NULL ? document->tree.root->location.file : file);
    else if (index - 2 < document->folder_count)
        *at = (folder){strlen(document->folders[index - 2]), document->folders[index - 2]};
    return index <= document->folder_count + 2;
}

/* The path of a name in a folder; NULL if it is not a file or memory is out. */
static char *join(folder in, const char *name) {
    const size_t size = in.length + strlen(name) + 2;
    char *const path = malloc(size);
    if (path == NULL)
        return NULL;
    const bool slash = in.length > 0 && in.path[in.length - 1] != '/';
    snprintf(path, size, "%.*s%s%s", (int)in.length, in.path, slash ? "/" : "", name);
    struct stat status;
    if (aur_file_status(path, &status))
        return path;
    free(path);
    return NULL;
}

/* A folder for files that are generated on demand contains a text HOW-TO-MAKE whose first line is the
 * command. Finds the one next to `name` in a searched folder. */
static bool read_command(folder in, const char *name, char *command, size_t capacity) {
    char name_there[AUR_ERROR_FILE_CAPACITY];
    const int written =
        snprintf(name_there, sizeof name_there, "%.*sHOW-TO-MAKE", (int)folder_of(name).length, name);
    char *const path = written < (int)sizeof name_there ? join(in, name_there) : NULL;
    char *text = NULL;
    size_t size = 0, end = 0;
    if (path != NULL && aur_file_read(path, 1 << 16, &text, &size, NULL) == AUR_OK) {
        while (end < size && end + 1 < capacity && isprint((unsigned char)text[end]))
            ++end;
        memcpy(command, text, end);
        free(text);
    }
    free(path);
    command[end] = '\0';
    return end > 0;
}

/* Radiance searches the working folder: models refer to `model/bsdf/a.xml` from the project's folder. */
static bool searches_above(const aur_xml_document *document, const char *name) {
    return document->from_radiance && name[0] != '/' && strchr(name, '/') != NULL;
}

/* The path of a name in the folders above that of a file. */
static char *join_above(const char *file, const char *name) {
    enum { MOST_LEVELS = 8 };
    const folder in = folder_of(file);
    char *const named = in.length > 0 ? strndup(file, in.length) : strdup("."), *path = NULL;
    char *const real = named != NULL ? realpath(named, NULL) : NULL;
    size_t length = real != NULL ? strlen(real) : 0;
    for (size_t level = 0; level < MOST_LEVELS && length > 1 && path == NULL; ++level) {
        while (length > 1 && real[length - 1] != '/')
            --length;
        path = join((folder){length, real}, name);
        length -= length > 1;
    }
    free(named);
    free(real);
    return path;
}

static aur_result fail(const aur_xml_document *document, aur_location location, const char *name,
                       aur_error *error) {
    if (name[0] == '/')
        return aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'", name);
    char folders[700] = "", command[160] = "";
    folder in, first = {0};
    for (size_t i = 0, used = 0; folder_at(document, location.file, i, &in); ++i) {
        if (in.length == 0)
            in = (folder){2, "./"};
        if (i == 0)
            first = in;
        if (i > 0 && in.length == first.length && strncmp(in.path, first.path, in.length) == 0)
            continue; /* the main file is in this folder, or is the referencing file: count the folder once */
        if (used < sizeof folders)
            used += (size_t)snprintf(folders + used, sizeof folders - used, "%s%.*s", i > 0 ? ", " : "",
                                     (int)in.length, in.path);
        if (command[0] == '\0' && document->confines == NULL)
            read_command(in, name, command, sizeof command);
    }
    if (command[0] != '\0')
        return aur_fail_at(error, location, AUR_ERROR_OPEN,
                           "cannot find '%s'; it is made by the command: %s (looked in %s)", name, command,
                           folders);
    return aur_fail_at(error, location, AUR_ERROR_OPEN, "cannot find '%s'; looked in %s%s", name, folders,
                       searches_above(document, name) ? " and the folders above" : "");
}

/* Windows paths use backslashes. */
static aur_result find_with_slashes(const aur_xml_document *document, aur_location location, const char *name,
                                    char **found, aur_error *error) {
    char *const slashes = strdup(name);
    if (slashes == NULL)
        return aur_fail_memory(error);
    for (char *at = slashes; *at != '\0'; ++at)
        *at = *at == '\\' ? '/' : *at;
    const aur_result result = aur_xml_find_folder(document, location, slashes, found, error);
    free(slashes);
    return result;
}

aur_result aur_xml_find_folder(const aur_xml_document *document, aur_location location, const char *name,
                               char **found, aur_error *error) {
    *found = NULL;
    if (name[0] == '\0')
        return aur_fail_at(error, location, AUR_ERROR_FORMAT, "a file name is empty");
    folder in;
    *found = name[0] == '/' ? join((folder){0, ""}, name) : NULL;
    for (size_t i = 0; name[0] != '/' && *found == NULL && folder_at(document, location.file, i, &in); ++i)
        *found = join(in, name);
    if (*found == NULL && searches_above(document, name))
        *found = join_above(location.file, name);
    if (*found == NULL && strchr(name, '\\') != NULL)
        return find_with_slashes(document, location, name, found, error);
    return *found != NULL ? AUR_OK : fail(document, location, name, error);
}

aur_result aur_xml_confine(aur_xml_document *document, const char *path, aur_error *error) {
    const folder in = folder_of(path);
    char *const name = in.length > 0 ? strndup(path, in.length) : strdup(".");
    document->confines = name != NULL ? realpath(name, NULL) : NULL;
    free(name);
    if (document->confines != NULL)
        return AUR_OK;
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_OPEN,
                       "the scene's folder is not there");
}

/* Whether the file, with links resolved, lies in the folder that the scene is confined to. */
static bool is_allowed(const aur_xml_document *document, const char *path) {
    if (document->confines == NULL)
        return true;
    char *const real = realpath(path, NULL);
    const size_t length = strlen(document->confines);
    bool allowed = real != NULL && strncmp(real, document->confines, length) == 0 &&
                   (real[length] == '/' || document->confines[length - 1] == '/');
    free(real);
    (void)aur_io_agree(sizeof allowed, &allowed, NULL);
    return allowed;
}

aur_result aur_xml_note_file(aur_xml_document *document, const char *name, const char *path,
                             aur_error *error) {
    const char *const name_copy = aur_arena_copy(&document->tree.arena, name, strlen(name));
    const char *const path_copy = aur_arena_copy(&document->tree.arena, path, strlen(path));
    if (name_copy == NULL || path_copy == NULL ||
        !aur_array_reserve(&document->files, &document->file_capacity, document->file_count + 1,
                           sizeof *document->files))
        return aur_fail_memory(error);
    document->files[document->file_count++] = (aur_xml_file){.name = name_copy, .path = path_copy};
    return AUR_OK;
}

aur_result aur_xml_find_asset(aur_xml_document *document, aur_location location, const char *name,
                              char **found, aur_error *error) {
    aur_result result = aur_xml_find_folder(document, location, name, found, error);
    struct stat status;
    if (result == AUR_OK && !(aur_file_status(*found, &status) && S_ISREG(status.st_mode)))
        result =
            aur_fail_at(error, location, AUR_ERROR_OPEN,
                        "'%s' is not a regular file: a scene must not name folders, devices or pipes", name);
    else if (result == AUR_OK && !is_allowed(document, *found))
        result =
            aur_fail_at(error, location, AUR_ERROR_OPEN,
                        "'%s' lies outside of the scene's folder, to which its files are confined", name);
    else if (result == AUR_OK)
        result = aur_xml_note_file(document, name, *found, error);
    if (result == AUR_OK) {
        document->files[document->file_count - 1].changed = status.st_mtim;
        return AUR_OK;
    }
    free(*found);
    *found = NULL;
    return result;
}

aur_result aur_xml_find_set(aur_xml_document *document, aur_location location, const char *set, char **found,
                            aur_error *error) {
    /* file:PATH, and the value of a key `file` */
    const char *start = strncmp(set, "file:", 5) == 0 ? set + 5 : NULL;
    for (const char *c = strstr(set, "file="); start == NULL && c != NULL; c = strstr(c + 1, "file="))
        start = c > set && (c[-1] == ':' || c[-1] == ',') ? c + 5 : NULL;
    if (start == NULL)
        return (*found = strdup(set)) != NULL ? AUR_OK : aur_fail_memory(error);
    const size_t length = start[-1] == ':' ? strlen(start) : strcspn(start, ",");
    char *const name = strndup(start, length);
    char *path;
    const aur_result result =
        name != NULL ? aur_xml_find_asset(document, location, name, &path, error) : aur_fail_memory(error);
    free(name);
    if (result != AUR_OK)
        return result;
    const size_t size = strlen(set) + strlen(path) + 1;
    *found = malloc(size);
    if (*found != NULL)
        snprintf(*found, size, "%.*s%s%s", (int)(start - set), set, path, start + length);
    free(path);
    return *found != NULL ? AUR_OK : aur_fail_memory(error);
}
