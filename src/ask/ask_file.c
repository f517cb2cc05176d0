/* An asking in a file: what the next round follows from, and the replicas' films. */
#include <stdlib.h>

#include "ask/state.h"
#include "core/error.h"
#include "core/words.h"
#include "film/checkpoint.h"
#include "render/renderer.h"

/* Numbers between rounds, before those of the tiles and of the replicas. */
enum { STATE_WORDS = 9 };

static size_t word_count(const aur_ask *ask) {
    return STATE_WORDS + 2 * ask->replicas.pixel_count + ask->replicas.count * AUR_SECONDS_WORDS;
}

aur_result aur_ask_save(const aur_ask *ask, const char *path, aur_error *error) {
    if (ask->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an asking is saved whose options say 'resumable'");
    uint64_t *const words = malloc(word_count(ask) * sizeof *words);
    if (words == NULL)
        return aur_fail_memory(error);
    const double numbers[] = {
        ask->interval.estimate, ask->interval.low, ask->interval.high,
        ask->interval.degrees,  ask->rate,         ask->begun ? ask->before : ask->samples,
        ask->measure.mean};
    size_t at = 0;
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
        words[at++] = aur_word_of_double(numbers[i]);
    words[at++] = ask->rounds;
    words[at++] = ask->begun;
    for (size_t i = 0; i < ask->replicas.pixel_count; ++i) {
        words[at++] = ask->targets[i];
        words[at++] = aur_word_of_double(ask->variances[i]);
    }
    const aur_film *films[AUR_REPLICAS_MAX];
    for (size_t r = 0; r < ask->replicas.count; ++r, at += AUR_SECONDS_WORDS) {
        films[r] = aur_render_film(ask->replicas.renders[r]);
        aur_render_put_seconds(ask->replicas.renders[r], words + at);
    }
    const aur_result result =
        aur_checkpoint_save(path, ask->identity, at, words, ask->replicas.count, films, error);
    free(words);
    return result;
}

static aur_result take_over(aur_ask *ask, const char *path, const aur_checkpoint *kept, aur_error *error) {
    double numbers[7];
    const uint64_t *word = kept->words;
    for (size_t i = 0; i < 7; ++i)
        numbers[i] = aur_double_of_word(*word++);
    ask->interval = (aur_error_interval){
        .estimate = numbers[0], .low = numbers[1], .high = numbers[2], .degrees = numbers[3]};
    ask->rate = numbers[4];
    ask->samples = ask->before = numbers[5];
    ask->measure.mean = numbers[6];
    ask->rounds = *word++;
    ask->begun = *word++ != 0;
    for (size_t i = 0; i < ask->replicas.pixel_count; ++i) {
        ask->targets[i] = (uint32_t)*word++;
        ask->variances[i] = aur_double_of_word(*word++);
    }
    aur_result result = AUR_OK;
    for (size_t r = 0; r < ask->replicas.count && result == AUR_OK; ++r, word += AUR_SECONDS_WORDS) {
        aur_render_take_seconds(ask->replicas.renders[r], word);
        result = aur_fail_in(error, aur_render_merge(ask->replicas.renders[r], kept->films[r], error), path);
    }
    return result;
}

aur_result aur_ask_resume(aur_ask *ask, const char *path, aur_error *error) {
    if (ask->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an asking goes on whose options say 'resumable'");
    aur_checkpoint kept;
    aur_result result = aur_checkpoint_load(path, &kept, error);
    if (result == AUR_OK && kept.film_count < 2)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                             "of another render: it was not made to an error, a time or a number of rays");
    if (result == AUR_OK)
        result = aur_identity_compare(path, kept.identity, ask->identity, NULL, error);
    if (result == AUR_OK && (kept.film_count != ask->replicas.count || kept.word_count != word_count(ask)))
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                             "a checkpoint of another form");
    if (result == AUR_OK)
        result = take_over(ask, path, &kept, error);
    aur_checkpoint_release(&kept);
    return result;
}
