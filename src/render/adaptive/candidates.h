/* How many candidates for points on lights path tracing is to have at each surface (path:candidates). */
#pragma once

#include "render/adaptive/choose.h"

/* "path[:key=value...]" with so many candidates. A new text, or NULL where memory is short. */
char *aur_ask_path(const char *path, size_t candidates);

/* What candidates were found to be best, and what they take of one candidate's time to an error. */
typedef struct aur_candidates {
    size_t count;
    double cost;
} aur_candidates;

/* How many choices there are, and the samples of each replica that one is looked at by. */
enum { AUR_CANDIDATE_CHOICES = 3, AUR_CANDIDATE_SAMPLES = 2 };

/* Looks at the choices in few pixels (`coarse`), by as many samples each. `spent`: all rays of these. Errors:
 * CANCELLED, MEMORY, and those of rendering. */
aur_result aur_ask_candidates(aur_renderer *renderer, const aur_render_options *coarse,
                              const aur_choice *choice, aur_candidates *found, aur_spent *spent,
                              aur_error *error);
