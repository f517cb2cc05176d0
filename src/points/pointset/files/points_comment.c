/* The comment that gives the domain of a file of points. */
#include <string.h>

#include "points/base/text.h"
#include "points/pointset/files/points_file.h"

void aur_matrix_read_comment(aur_matrix *matrix, const char *text) {
    static const char key[] = "domain:", weights[] = "; weights";
    text = aur_skip_spaces(text);
    if (matrix->declared || strncmp(text, key, sizeof key - 1) != 0)
        return;
    text = aur_skip_spaces(text + sizeof key - 1);
    const size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz");
    for (aur_domain domain = AUR_DOMAIN_SQUARE; aur_domain_name(domain) != NULL; ++domain) {
        const char *const name = aur_domain_name(domain);
        if (strlen(name) != length || strncmp(name, text, length) != 0)
            continue;
        matrix->declared = true;
        matrix->domain = domain;
        matrix->weighted = strncmp(text + length, weights, sizeof weights - 1) == 0;
    }
}
