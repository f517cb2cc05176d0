/* An image to a target in a file: the state that the next round depends on, and the replicas' films. */
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/adaptive/adaptive.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Words that are written, or read; `word` NULL: only counted. */
typedef struct transfer {
    bool reads;
    uint64_t *word;
    size_t count;
} transfer;

static void transfer_bytes(transfer *to, void *data, size_t bytes) {
    const size_t words = (bytes + sizeof(uint64_t) - 1) / sizeof(uint64_t);
    if (to->word != NULL && to->reads)
        memcpy(data, to->word + to->count, bytes);
    else if (to->word != NULL)
        memcpy(to->word + to->count, data, bytes);
    to->count += words;
}

#define FIELD(name)                                                                                          \
    { offsetof(aur_adaptive, name), sizeof(((aur_adaptive *)NULL)->name) }

static const struct field {
    size_t offset, bytes;
} fields[] = {
    FIELD(rank),
    FIELD(level),
    FIELD(others.all),
    FIELD(race.order_count),
    FIELD(race.order),
    FIELD(race.entries), /* whose arrays are released */
    FIELD(bias),
    FIELD(candidate.rate),
    FIELD(candidate.finished),
    FIELD(candidate.rays_before),
    FIELD(candidate.rays_planned),
    FIELD(candidate.measure.mean),
    FIELD(candidate.bound),
    FIELD(candidate.pooled),
    FIELD(candidate.intervals),
    FIELD(candidate.rounds),
};

/* Words before them. */
enum { ROW, PHOTONS, STEPS, FLAGS, BUDGET, TRACED, FIRST_FIELD };

/* From a file into `adaptive`, or from this. */
static void transfer_state(transfer *to, aur_adaptive *adaptive) {
    aur_candidate *const candidate = &adaptive->candidate;
    to->count = FIRST_FIELD;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i)
        transfer_bytes(to, (char *)adaptive + fields[i].offset, fields[i].bytes);
    transfer_bytes(to, candidate->targets, candidate->value_count * sizeof *candidate->targets);
    transfer_bytes(to, candidate->earlier, candidate->value_count * sizeof *candidate->earlier);
    transfer_bytes(to, candidate->variances, candidate->value_count * sizeof *candidate->variances);
    transfer_bytes(to, candidate->blocks,
                   candidate->replicas.columns * candidate->replicas.rows * sizeof *candidate->blocks);
}

static size_t word_count(aur_adaptive *adaptive) {
    transfer counted = {.word = NULL};
    transfer_state(&counted, adaptive);
    return counted.count + adaptive->candidate.replicas.count * AUR_SPENT_WORDS;
}

aur_result aur_adaptive_save(aur_adaptive *adaptive, const char *path, aur_error *error) {
    const aur_candidate *const candidate = &adaptive->candidate;
    if (adaptive->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "only an image with the option 'resumable' can be saved");
    if (adaptive->open) /* races are short, and begin again */
        return AUR_OK;
    aur_adaptive_measure_others(adaptive);
    const size_t count = word_count(adaptive);
    transfer to = {.word = calloc(count, sizeof *to.word)};
    if (to.word == NULL)
        return aur_fail_memory(error);
    to.word[ROW] = adaptive->row;
    to.word[PHOTONS] = adaptive->photons;
    to.word[STEPS] = adaptive->corrections.steps;
    to.word[FLAGS] =
        (uint64_t)candidate->begun + 2 * (uint64_t)candidate->looked_at + 4 * (uint64_t)adaptive->unchecked;
    to.word[BUDGET] = aur_adaptive_other_rays(adaptive);
    to.word[TRACED] = candidate->traced;
    transfer_state(&to, adaptive);
    const aur_film *films[AUR_REPLICAS_MAX];
    for (size_t r = 0; r < candidate->replicas.count; ++r) {
        films[r] = aur_render_film(candidate->replicas.renders[r]);
        aur_render_put_spent(candidate->replicas.renders[r], to.word + to.count + r * AUR_SPENT_WORDS);
    }
    const aur_result result = aur_checkpoint_save(path, adaptive->identity, count, to.word,
                                                  candidate->replicas.count, films, error);
    free(to.word);
    return result;
}

static bool is_damaged(const aur_adaptive *adaptive) {
    const aur_race *const race = &adaptive->race;
    bool damaged = adaptive->rank >= AUR_RACE_ROWS || race->order_count > AUR_RACE_ROWS;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        damaged = damaged || race->order[i] >= AUR_RACE_ROWS ||
                  memchr(race->entries[i].reason, '\0', sizeof race->entries[i].reason) == NULL;
    return damaged;
}

static aur_result take_over(aur_adaptive *adaptive, const char *path, const aur_checkpoint *saved,
                            aur_error *error) {
    const uint64_t *const words = saved->words;
    aur_candidate *const candidate = &adaptive->candidate;
    aur_result result = AUR_OK;
    if (adaptive->path != NULL && words[ROW] < AUR_RACE_ROWS && words[ROW] != AUR_RACE_PATH)
        result = aur_adaptive_take(adaptive, words[ROW], words[PHOTONS], error);
    if (result != AUR_OK)
        return result;
    transfer from = {.reads = true, .word = saved->words};
    transfer_state(&from, adaptive);
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        adaptive->race.entries[i].values = NULL;
        adaptive->race.entries[i].roots = NULL;
    }
    if (words[ROW] >= AUR_RACE_ROWS || is_damaged(adaptive))
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "a damaged checkpoint");
    adaptive->open = false;
    candidate->begun = (words[FLAGS] & 1) != 0;
    candidate->looked_at = (words[FLAGS] & 2) != 0;
    adaptive->unchecked = (words[FLAGS] & 4) != 0;
    adaptive->others.budget = words[BUDGET] - (adaptive->uses.rays - candidate->shared);
    candidate->traced += words[TRACED];
    for (size_t r = 0; r < candidate->replicas.count && result == AUR_OK; ++r) {
        aur_render_take_spent(candidate->replicas.renders[r], words + from.count + r * AUR_SPENT_WORDS);
        result = aur_fail_in(error, aur_render_merge(candidate->replicas.renders[r], saved->films[r], error),
                             path);
    }
    aur_candidate_measure(candidate);
    if (result == AUR_OK && words[STEPS] > 0 && aur_race_gathers(adaptive->row))
        result = aur_corrections_repeat(&adaptive->corrections, words[STEPS], &adaptive->cancelled, error);
    adaptive->others_rounds = candidate->rounds; /* the file has them */
    adaptive->others_steps = adaptive->corrections.steps;
    return result;
}

aur_result aur_adaptive_resume(aur_adaptive *adaptive, const char *path, aur_error *error) {
    if (adaptive->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "only an image with the option 'resumable' can be continued");
    aur_checkpoint checkpoint;
    aur_result result = aur_checkpoint_load(path, false, &checkpoint, error);
    if (result == AUR_OK && checkpoint.film_count < 2 && adaptive->target.replicas > 1)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                             "of another render: it was not made to an error, a time or a number of rays");
    if (result == AUR_OK)
        result = aur_identity_compare(path, checkpoint.identity, adaptive->identity, NULL, error);
    if (result == AUR_OK && (checkpoint.film_count != adaptive->candidate.replicas.count ||
                             checkpoint.word_count != word_count(adaptive)))
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                             "a checkpoint of another form");
    if (result == AUR_OK)
        result = take_over(adaptive, path, &checkpoint, error);
    aur_checkpoint_release(&checkpoint);
    return result;
}
