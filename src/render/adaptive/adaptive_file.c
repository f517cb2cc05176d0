/* An image to a target in a file: the state that the next round depends on, and the replicas' films. */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/words.h"
#include "render/adaptive/adaptive.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Numbers between rounds, before those of the tiles and of the replicas. */
enum {
    NUMBERS = 7,
    INTERVALS = 4 * AUR_ERROR_MEASURE_COUNT,
    CHOICE = NUMBERS + INTERVALS + 2,
    RACE = CHOICE + 7,
    STATE_WORDS = RACE + 1 + 2 * AUR_RACE_ROWS
};

static size_t word_count(const aur_adaptive *adaptive) {
    return STATE_WORDS + 3 * adaptive->candidate.value_count + 2 * adaptive->candidate.replicas.pixel_count +
           adaptive->candidate.replicas.count * AUR_SPENT_WORDS;
}

aur_result aur_adaptive_save(const aur_adaptive *adaptive, const char *path, aur_error *error) {
    if (adaptive->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "only an image whose options say 'resumable' can be saved");
    if (adaptive->open) /* races are short, and begin again */
        return AUR_OK;
    uint64_t *const words = malloc(word_count(adaptive) * sizeof *words);
    if (words == NULL)
        return aur_fail_memory(error);
    const double numbers[NUMBERS] = {adaptive->candidate.rate,
                                     adaptive->candidate.begun ? adaptive->candidate.before
                                                               : adaptive->candidate.samples,
                                     adaptive->candidate.measure.mean,
                                     adaptive->others.prepare_seconds,
                                     adaptive->others.render_seconds,
                                     adaptive->others.cpu_seconds,
                                     adaptive->candidate.bound};
    size_t at = 0;
    for (size_t i = 0; i < NUMBERS; ++i)
        words[at++] = aur_word_of_double(numbers[i]);
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        words[at++] = aur_word_of_double(adaptive->candidate.intervals[m].estimate);
        words[at++] = aur_word_of_double(adaptive->candidate.intervals[m].low);
        words[at++] = aur_word_of_double(adaptive->candidate.intervals[m].high);
        words[at++] = aur_word_of_double(adaptive->candidate.intervals[m].degrees);
    }
    words[at++] = adaptive->candidate.rounds;
    words[at++] = (uint64_t)adaptive->candidate.begun + 2 * (uint64_t)adaptive->candidate.looked_at +
                  4 * (uint64_t)adaptive->unchecked;
    words[at++] = adaptive->path != NULL ? adaptive->row : AUR_RACE_PATH;
    words[at++] = adaptive->photons;
    words[at++] = adaptive->place;
    words[at++] = adaptive->corrections.steps;
    words[at++] = adaptive->others.rays;
    words[at++] = aur_adaptive_other_rays(adaptive);
    words[at++] = adaptive->candidate.traced;
    words[at++] = adaptive->race.order_count;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        words[at++] = adaptive->race.order[i];
        words[at++] = aur_word_of_double(adaptive->race.entries[i].need);
    }
    for (size_t i = 0; i < adaptive->candidate.value_count; ++i) {
        words[at++] = adaptive->candidate.targets[i];
        words[at++] = adaptive->candidate.earlier[i];
        words[at++] = aur_word_of_double(adaptive->candidate.variances[i]);
    }
    for (size_t i = 0; i < adaptive->candidate.replicas.pixel_count; ++i) {
        words[at++] = aur_word_of_double(adaptive->candidate.pixels[i].variance);
        words[at++] = aur_word_of_double(adaptive->candidate.pixels[i].spread);
    }
    const aur_film *films[AUR_REPLICAS_MAX];
    for (size_t r = 0; r < adaptive->candidate.replicas.count; ++r, at += AUR_SPENT_WORDS) {
        films[r] = aur_render_film(adaptive->candidate.replicas.renders[r]);
        aur_render_put_spent(adaptive->candidate.replicas.renders[r], words + at);
    }
    const aur_result result = aur_checkpoint_save(path, adaptive->identity, at, words,
                                                  adaptive->candidate.replicas.count, films, error);
    free(words);
    return result;
}

/* Targets and variances of the pixels. Returns what comes after them. */
static const uint64_t *take_pixels(aur_candidate *candidate, const uint64_t *word) {
    for (size_t i = 0; i < candidate->value_count; ++i) {
        candidate->targets[i] = (uint32_t)*word++;
        candidate->earlier[i] = (uint32_t)*word++;
        candidate->variances[i] = aur_double_of_word(*word++);
    }
    for (size_t i = 0; i < candidate->replicas.pixel_count; ++i) {
        candidate->pixels[i].variance = aur_double_of_word(*word++);
        candidate->pixels[i].spread = aur_double_of_word(*word++);
    }
    return word;
}

static aur_result take_over(aur_adaptive *adaptive, const char *path, const aur_checkpoint *kept,
                            aur_error *error) {
    double numbers[NUMBERS];
    const uint64_t *word = kept->words;
    for (size_t i = 0; i < NUMBERS; ++i)
        numbers[i] = aur_double_of_word(*word++);
    const uint64_t *const choice = kept->words + CHOICE;
    aur_result result = AUR_OK;
    bool damaged = choice[0] >= AUR_RACE_ROWS || choice[2] >= AUR_RACE_ROWS;
    const uint64_t *const race = kept->words + RACE;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i)
        damaged = damaged || race[0] > AUR_RACE_ROWS || race[1 + 2 * i] >= AUR_RACE_ROWS;
    if (damaged)
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "a damaged checkpoint");
    if (adaptive->path != NULL && choice[0] != AUR_RACE_PATH)
        result = aur_adaptive_take(adaptive, choice[0], choice[1], error);
    if (result != AUR_OK)
        return result;
    adaptive->open = false;
    adaptive->candidate.rate = numbers[0];
    adaptive->candidate.samples = adaptive->candidate.before = numbers[1];
    adaptive->candidate.measure.mean = numbers[2];
    adaptive->others.prepare_seconds = numbers[3];
    adaptive->others.render_seconds = numbers[4];
    adaptive->others.cpu_seconds = numbers[5];
    adaptive->candidate.bound = numbers[6];
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m, word += 4)
        adaptive->candidate.intervals[m] = (aur_error_interval){.estimate = aur_double_of_word(word[0]),
                                                                .low = aur_double_of_word(word[1]),
                                                                .high = aur_double_of_word(word[2]),
                                                                .degrees = aur_double_of_word(word[3])};
    adaptive->candidate.interval = adaptive->candidate.intervals[adaptive->target.measure];
    adaptive->candidate.rounds = *word++;
    adaptive->candidate.begun = (*word & 1) != 0;
    adaptive->unchecked = (*word & 4) != 0;
    adaptive->candidate.looked_at = (*word++ & 2) != 0;
    word += 4; /* the choice */
    adaptive->others.rays = *word++;
    adaptive->others.budget = *word++ - (adaptive->uses.rays - adaptive->candidate.shared);
    adaptive->candidate.traced += *word++;
    adaptive->place = choice[2];
    adaptive->race.order_count = *word++;
    for (size_t i = 0; i < AUR_RACE_ROWS; ++i) {
        adaptive->race.order[i] = *word++;
        adaptive->race.entries[i].need = aur_double_of_word(*word++);
    }
    word = take_pixels(&adaptive->candidate, word);
    for (size_t r = 0; r < adaptive->candidate.replicas.count && result == AUR_OK;
         ++r, word += AUR_SPENT_WORDS) {
        aur_render_take_spent(adaptive->candidate.replicas.renders[r], word);
        result = aur_fail_in(
            error, aur_render_merge(adaptive->candidate.replicas.renders[r], kept->films[r], error), path);
    }
    if (result == AUR_OK && choice[3] > 0 && adaptive->row != AUR_RACE_PATH) {
        aur_candidate_look(&adaptive->candidate);
        result = aur_corrections_repeat(&adaptive->corrections, choice[3], &adaptive->cancelled, error);
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
