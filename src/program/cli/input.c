/* Input files of options. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program/cli/cli.h"

FILE *cli_open_input(const char *path, aur_error *error) {
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    struct stat status;
    const char *refusal = descriptor < 0 || fstat(descriptor, &status) != 0 ? strerror(errno) : NULL;
    if (refusal == NULL && !S_ISREG(status.st_mode) && strncmp(path, "/dev/fd/", 8) != 0)
        refusal = S_ISDIR(status.st_mode)    ? strerror(EISDIR)
                  : S_ISFIFO(status.st_mode) ? "it is a pipe, and a file is expected"
                                             : "it is a device, and a file is expected";
    if (refusal == NULL)
        (void)fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    FILE *const file = refusal == NULL ? fdopen(descriptor, "rb") : NULL;
    if (file != NULL)
        return file;
    aur_fail(error, AUR_ERROR_OPEN, "%s: cannot read: %s", path, refusal != NULL ? refusal : strerror(errno));
    if (descriptor >= 0)
        close(descriptor);
    return NULL;
}
