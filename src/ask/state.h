/* The inside of an asking. */
#pragma once

#include <aureole/ask.h>

#include <stdatomic.h>

#include "ask/replicas.h"

struct aur_ask {
    aur_ask_options wish;
    aur_progress progress;
    char *integrator;
    char *identity; /* of a resumable asking; else NULL */
    aur_replicas replicas;
    uint32_t *targets;
    double *variances, *scratch; /* of the pixels, after the last round */
    aur_replica_measure measure;
    aur_error_interval interval; /* relative */
    double rate;                 /* the error's square falls as samples^-rate */
    double samples;              /* a pixel, all replicas together */
    uint64_t rounds;
    bool begun; /* a round that was stopped before its end */
    atomic_bool cancelled;
    /* For the progress callback: replicas done of this round, and what is rendered in all. */
    size_t replica;
    double before, whole;
};
