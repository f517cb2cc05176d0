/* An image to a target in a file: the state that the next round depends on, and the replicas' films. */
#include <stddef.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/words.h"
#include "render/adaptive/adaptive.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Numbers of eight bytes each, which are saved and loaded as they are. */
typedef struct field {
    size_t offset, bytes;
} field;

#define FIELD(name)                                                                                          \
    { offsetof(aur_adaptive, name), sizeof(((aur_adaptive *)NULL)->name) }

static const field fields[] = {
    FIELD(place),
    FIELD(others.rays),
    FIELD(others.prepare_seconds),
    FIELD(others.render_seconds),
    FIELD(others.cpu_seconds),
    FIELD(race.order_count),
    FIELD(race.order),
    FIELD(race.entries[AUR_RACE_PATH].need),
    FIELD(race.entries[AUR_RACE_SHARED].need),
    FIELD(race.entries[AUR_RACE_MIDDLE].need),
    FIELD(race.entries[AUR_RACE_LIGHTS].need),
    FIELD(race.entries[AUR_RACE_LONG].need),
    FIELD(candidate.rate),
    FIELD(candidate.finished),
    FIELD(candidate.measure.mean),
    FIELD(candidate.bound),
    FIELD(candidate.intervals),
    FIELD(candidate.rounds),
};
enum { FIELD_COUNT = sizeof fields / sizeof fields[0] };

/* Words before them. */
enum { ROW, PHOTONS, STEPS, FLAGS, BUDGET, TRACED, FIRST_FIELD };

static size_t word_count(const aur_adaptive *adaptive) {
    size_t count = FIRST_FIELD;
    for (size_t i = 0; i < FIELD_COUNT; ++i)
        count += fields[i].bytes / sizeof(uint64_t);
    return count + 3 * adaptive->candidate.value_count + 2 * adaptive->candidate.replicas.pixel_count +
           adaptive->candidate.replicas.count * AUR_SPENT_WORDS;
}

aur_result aur_adaptive_save(const aur_adaptive *adaptive, const char *path, aur_error *error) {
    const aur_candidate *const candidate = &adaptive->candidate;
    if (adaptive->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "only an image whose options say 'resumable' can be saved");
    if (adaptive->open) /* races are short, and begin again */
        return AUR_OK;
    const size_t count = word_count(adaptive);
    uint64_t *const words = malloc(count * sizeof *words), *word = words + FIRST_FIELD;
    if (words == NULL)
        return aur_fail_memory(error);
    words[ROW] = adaptive->path != NULL ? adaptive->row : AUR_RACE_PATH;
    words[PHOTONS] = adaptive->photons;
    words[STEPS] = adaptive->corrections.steps;
    words[FLAGS] =
        (uint64_t)candidate->begun + 2 * (uint64_t)candidate->looked_at + 4 * (uint64_t)adaptive->unchecked;
    words[BUDGET] = aur_adaptive_other_rays(adaptive);
    words[TRACED] = candidate->traced;
    for (size_t i = 0; i < FIELD_COUNT; word += fields[i++].bytes / sizeof *word)
        memcpy(word, (const char *)adaptive + fields[i].offset, fields[i].bytes);
    for (size_t i = 0; i < candidate->value_count; ++i) {
        *word++ = candidate->targets[i];
        *word++ = candidate->earlier[i];
        *word++ = aur_word_of_double(candidate->variances[i]);
    }
    const size_t spreads = candidate->replicas.pixel_count * sizeof *candidate->pixels;
    memcpy(word, candidate->pixels, spreads);
    word += spreads / sizeof *word;
    const aur_film *films[AUR_REPLICAS_MAX];
    for (size_t r = 0; r < candidate->replicas.count; ++r, word += AUR_SPENT_WORDS) {
        films[r] = aur_render_film(candidate->replicas.renders[r]);
        aur_render_put_spent(candidate->replicas.renders[r], word);
    }
    const aur_result result =
        aur_checkpoint_save(path, adaptive->identity, count, words, candidate->replicas.count, films, error);
    free(words);
    return result;
}

static bool is_damaged(const aur_adaptive *adaptive) {
    bool damaged = adaptive->place >= AUR_RACE_ROWS || adaptive->race.order_count > AUR_RACE_ROWS;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        damaged = damaged || adaptive->race.order[i] >= AUR_RACE_ROWS;
    return damaged;
}

static aur_result take_candidate(aur_candidate *candidate, const uint64_t *word, const char *path,
                                 const aur_checkpoint *saved, aur_error *error) {
    for (size_t i = 0; i < candidate->value_count; ++i) {
        candidate->targets[i] = (uint32_t)*word++;
        candidate->earlier[i] = (uint32_t)*word++;
        candidate->variances[i] = aur_double_of_word(*word++);
    }
    const size_t spreads = candidate->replicas.pixel_count * sizeof *candidate->pixels;
    memcpy(candidate->pixels, word, spreads);
    word += spreads / sizeof *word;
    aur_result result = AUR_OK;
    for (size_t r = 0; r < candidate->replicas.count && result == AUR_OK; ++r, word += AUR_SPENT_WORDS) {
        aur_render *const render = candidate->replicas.renders[r];
        aur_render_take_spent(render, word);
        result = aur_fail_in(error, aur_render_merge(render, saved->films[r], error), path);
    }
    return result;
}

static aur_result take_over(aur_adaptive *adaptive, const char *path, const aur_checkpoint *saved,
                            aur_error *error) {
    const uint64_t *const words = saved->words, *word = words + FIRST_FIELD;
    aur_candidate *const candidate = &adaptive->candidate;
    aur_result result = AUR_OK;
    if (adaptive->path != NULL && words[ROW] < AUR_RACE_ROWS && words[ROW] != AUR_RACE_PATH)
        result = aur_adaptive_take(adaptive, words[ROW], words[PHOTONS], error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < FIELD_COUNT; word += fields[i++].bytes / sizeof *word)
        memcpy((char *)adaptive + fields[i].offset, word, fields[i].bytes);
    if (words[ROW] >= AUR_RACE_ROWS || is_damaged(adaptive))
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "a damaged checkpoint");
    adaptive->open = false;
    candidate->samples = candidate->before = candidate->finished;
    candidate->interval = candidate->intervals[adaptive->target.measure];
    candidate->begun = (words[FLAGS] & 1) != 0;
    candidate->looked_at = (words[FLAGS] & 2) != 0;
    adaptive->unchecked = (words[FLAGS] & 4) != 0;
    adaptive->others.budget = words[BUDGET] - (adaptive->uses.rays - candidate->shared);
    candidate->traced += words[TRACED];
    result = take_candidate(candidate, word, path, saved, error);
    if (result == AUR_OK && words[STEPS] > 0 && adaptive->row != AUR_RACE_PATH) {
        aur_candidate_look(candidate);
        result = aur_corrections_repeat(&adaptive->corrections, words[STEPS], &adaptive->cancelled, error);
        aur_adaptive_bound_bias(adaptive);
    }
    return result;
}

aur_result aur_adaptive_resume(aur_adaptive *adaptive, const char *path, aur_error *error) {
    if (adaptive->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "only an image whose options say 'resumable' can go on");
    aur_checkpoint kept;
    aur_result result = aur_checkpoint_load(path, false, &kept, error);
    if (result == AUR_OK && kept.film_count < 2)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                             "of another render: it was not made to an error, a time or a number of rays");
    if (result == AUR_OK)
        result = aur_identity_compare(path, kept.identity, adaptive->identity, NULL, error);
    if (result == AUR_OK &&
        (kept.film_count != adaptive->candidate.replicas.count || kept.word_count != word_count(adaptive)))
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                             "a checkpoint of another form");
    if (result == AUR_OK)
        result = take_over(adaptive, path, &kept, error);
    aur_checkpoint_release(&kept);
    return result;
}
