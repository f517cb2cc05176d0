/* An asking in a file: what the next round follows from, and the replicas' films. */
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/words.h"
#include "render/adaptive/choose.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Numbers between rounds, before those of the tiles and of the replicas. */
enum { NUMBERS = 14, STATE_WORDS = NUMBERS + 10 };

static size_t word_count(const aur_ask *ask) {
    return STATE_WORDS + 3 * ask->trial.value_count + 2 * ask->trial.replicas.pixel_count +
           ask->trial.replicas.count * AUR_SPENT_WORDS;
}

aur_result aur_ask_save(const aur_ask *ask, const char *path, aur_error *error) {
    if (ask->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an asking is saved whose options say 'resumable'");
    if (ask->open) /* trials of integrators are short, and begin anew */
        return AUR_OK;
    uint64_t *const words = malloc(word_count(ask) * sizeof *words);
    if (words == NULL)
        return aur_fail_memory(error);
    const double numbers[NUMBERS] = {ask->trial.interval.estimate,
                                     ask->trial.interval.low,
                                     ask->trial.interval.high,
                                     ask->trial.interval.degrees,
                                     ask->trial.rate,
                                     ask->trial.begun ? ask->trial.before : ask->trial.samples,
                                     ask->trial.measure.mean,
                                     ask->bias.estimate,
                                     ask->bias.low,
                                     ask->bias.high,
                                     ask->others.prepare_seconds,
                                     ask->others.render_seconds,
                                     ask->others.cpu_seconds,
                                     ask->trial.bound};
    size_t at = 0;
    for (size_t i = 0; i < NUMBERS; ++i)
        words[at++] = aur_word_of_double(numbers[i]);
    words[at++] = ask->trial.rounds;
    words[at++] = (uint64_t)ask->trial.begun + 2 * (uint64_t)ask->trial.looked_at;
    words[at++] = ask->gather.photons;
    words[at++] = ask->gather.directions;
    words[at++] = ask->gather.lights;
    words[at++] = ask->gather.bright;
    words[at++] = ask->candidates;
    words[at++] = ask->others.rays;
    words[at++] = ask->others.budget;
    words[at++] = ask->trial.traced;
    for (size_t i = 0; i < ask->trial.value_count; ++i) {
        words[at++] = ask->trial.targets[i];
        words[at++] = ask->trial.earlier[i];
        words[at++] = aur_word_of_double(ask->trial.variances[i]);
    }
    for (size_t i = 0; i < ask->trial.replicas.pixel_count; ++i) {
        words[at++] = aur_word_of_double(ask->trial.pixels[i].variance);
        words[at++] = aur_word_of_double(ask->trial.pixels[i].spread);
    }
    const aur_film *films[AUR_REPLICAS_MAX];
    for (size_t r = 0; r < ask->trial.replicas.count; ++r, at += AUR_SPENT_WORDS) {
        films[r] = aur_render_film(ask->trial.replicas.renders[r]);
        aur_render_put_spent(ask->trial.replicas.renders[r], words + at);
    }
    const aur_result result =
        aur_checkpoint_save(path, ask->identity, at, words, ask->trial.replicas.count, films, error);
    free(words);
    return result;
}

static aur_result take_over(aur_ask *ask, const char *path, const aur_checkpoint *kept, aur_error *error) {
    double numbers[NUMBERS];
    const uint64_t *word = kept->words;
    for (size_t i = 0; i < NUMBERS; ++i)
        numbers[i] = aur_double_of_word(*word++);
    const aur_gather_size size = {kept->words[NUMBERS + 2], aur_ask_photon_seed(ask->options.seed),
                                  kept->words[NUMBERS + 3], kept->words[NUMBERS + 4],
                                  kept->words[NUMBERS + 5]};
    const size_t candidates = kept->words[NUMBERS + 6];
    aur_result result = AUR_OK;
    if (size.photons > 0)
        result = aur_ask_take_gather(ask, size, error);
    else if (candidates > 1)
        result = aur_ask_take_candidates(ask, candidates, error);
    if (result != AUR_OK)
        return result;
    ask->open = false;
    ask->trial.interval = (aur_error_interval){
        .estimate = numbers[0], .low = numbers[1], .high = numbers[2], .degrees = numbers[3]};
    ask->trial.rate = numbers[4];
    ask->trial.samples = ask->trial.before = numbers[5];
    ask->trial.measure.mean = numbers[6];
    ask->bias = (aur_bias){.estimate = numbers[7], .low = numbers[8], .high = numbers[9]};
    ask->others.prepare_seconds = numbers[10];
    ask->others.render_seconds = numbers[11];
    ask->others.cpu_seconds = numbers[12];
    ask->trial.bound = numbers[13];
    ask->trial.rounds = *word++;
    ask->trial.begun = (*word & 1) != 0;
    ask->trial.looked_at = (*word++ & 2) != 0;
    word += 5; /* of the integrator, see above */
    ask->others.rays = *word++;
    ask->others.budget = *word++;
    ask->trial.traced += *word++;
    for (size_t i = 0; i < ask->trial.value_count; ++i) {
        ask->trial.targets[i] = (uint32_t)*word++;
        ask->trial.earlier[i] = (uint32_t)*word++;
        ask->trial.variances[i] = aur_double_of_word(*word++);
    }
    for (size_t i = 0; i < ask->trial.replicas.pixel_count; ++i) {
        ask->trial.pixels[i].variance = aur_double_of_word(*word++);
        ask->trial.pixels[i].spread = aur_double_of_word(*word++);
    }
    for (size_t r = 0; r < ask->trial.replicas.count && result == AUR_OK; ++r, word += AUR_SPENT_WORDS) {
        aur_render_take_spent(ask->trial.replicas.renders[r], word);
        result =
            aur_fail_in(error, aur_render_merge(ask->trial.replicas.renders[r], kept->films[r], error), path);
    }
    return result;
}

aur_result aur_ask_resume(aur_ask *ask, const char *path, aur_error *error) {
    if (ask->identity == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "an asking goes on whose options say 'resumable'");
    aur_checkpoint kept;
    aur_result result = aur_checkpoint_load(path, false, &kept, error);
    if (result == AUR_OK && kept.film_count < 2)
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_ARGUMENT,
                             "of another render: it was not made to an error, a time or a number of rays");
    if (result == AUR_OK)
        result = aur_identity_compare(path, kept.identity, ask->identity, NULL, error);
    if (result == AUR_OK &&
        (kept.film_count != ask->trial.replicas.count || kept.word_count != word_count(ask)))
        result = aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                             "a checkpoint of another form");
    if (result == AUR_OK)
        result = take_over(ask, path, &kept, error);
    aur_checkpoint_release(&kept);
    return result;
}
