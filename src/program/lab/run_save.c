/* Paths of a run's files, and its times. */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "program/lab/run.h"

double lab_clock_seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double lab_run_seconds(const lab_run *run) {
    return lab_clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - run->begin + lab_store_seconds(run->store);
}

/* FOLDER/NAME/NAME-<what>.<extension>; characters unsafe in file names become underscores. */
void lab_run_path(const lab_run *run, const char *what, const char *extension, char *path, size_t capacity) {
    const char *const name = run->experiment->name;
    const int before = snprintf(path, capacity, "%s/%s%s%.160s", run->folder, name, what != NULL ? "-" : "",
                                what != NULL ? what : "");
    static const char *const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_=,";
    for (char *c = path + strlen(run->folder) + 1; *c != '\0'; ++c)
        if (strchr(plain, *c) == NULL)
            *c = '_';
    snprintf(path + before, capacity - (size_t)before, ".%s", extension);
}

aur_result lab_run_save(lab_run *run, const report_table *table, const char *what, const char *notes,
                        bool listed, aur_error *error) {
    char path[AUR_ERROR_FILE_CAPACITY];
    lab_run_path(run, what, "csv", path, sizeof path);
    const aur_result result = report_save(table, notes, path, error);
    if (result == AUR_OK && listed)
        fprintf(run->files, "%s\n", path);
    return result;
}
