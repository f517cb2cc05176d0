/* Solution files: a line with the format's name and version, then integers of 8 bytes, little-endian, and a
 * hash of them all. */
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/words.h"
#include "render/radiosity/solution.h"

static const char magic[] = "aureole-radiosity 1\n";
enum { MAGIC_LENGTH = sizeof magic - 1, HEAD_NUMBERS = 11, TALLY_NUMBERS = 8, NAME_LIMIT = 4096 };

/* Calls `visit` with each number of a tally, in file order. */
static void each_number(aur_radiosity_tally *tally, void (*visit)(void *file, uint64_t *number), void *file) {
    uint64_t *const counts[] = {&tally->rays,     &tally->lost,      &tally->behind,   &tally->trapped,
                                &tally->last.low, &tally->last.high, &tally->rest.low, &tally->rest.high};
    for (size_t i = 0; i < TALLY_NUMBERS; ++i)
        visit(file, counts[i]);
    for (size_t i = 0; i < tally->patch_count; ++i)
        for (size_t c = 0; c < 3; ++c) {
            visit(file, &tally->power[i][c].low);
            visit(file, &tally->power[i][c].high);
        }
}

/* --- writing */

static void put_number(void *file, uint64_t *number) {
    aur_word_put(file, *number);
}

/* Writes a short name, one character per number. */
static void put_name(aur_word_writer *out, const char *name) {
    aur_word_put(out, strlen(name));
    for (const char *c = name; *c != '\0'; ++c)
        aur_word_put(out, (unsigned char)*c);
}

aur_result aur_radiosity_save(const aur_radiosity *radiosity, const char *path, aur_error *error) {
    aur_file_writer file;
    const aur_result result = aur_file_open(path, &file, error);
    if (result != AUR_OK)
        return result;
    aur_word_writer out = {.stream = file.stream};
    fwrite(magic, 1, MAGIC_LENGTH, out.stream);
    const aur_radiosity_options *const o = &radiosity->options;
    const uint64_t head[HEAD_NUMBERS] = {radiosity->scene.hash,
                                         radiosity->scene.patch_count,
                                         radiosity->paths,
                                         aur_word_of_double(radiosity->change),
                                         (uint64_t)o->scramble,
                                         o->seed,
                                         (uint64_t)o->directions,
                                         (uint64_t)o->emission,
                                         o->bounces,
                                         o->randomizations,
                                         o->variant};
    for (size_t i = 0; i < HEAD_NUMBERS; ++i)
        aur_word_put(&out, head[i]);
    put_name(&out, radiosity->sequence);
    for (size_t r = 0; r < o->randomizations; ++r)
        each_number(&radiosity->tallies[r], put_number, &out);
    aur_word_put(&out, out.hash);
    return aur_file_commit(&file, error);
}

/* --- reading */

static void get_number(void *file, uint64_t *number) {
    *number = aur_word_get(file);
}

typedef struct file_head {
    uint64_t numbers[HEAD_NUMBERS]; /* hash of the scene, patches, paths, change, then options */
    aur_radiosity_options options;
    char name[NAME_LIMIT + 1];
} file_head;

static aur_result damaged(const char *path, const char *what, aur_error *error) {
    return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT, "not a radiosity solution: %s",
                       what);
}

/* Values that do not fit their types are refused here; the options' limits are checked when they are used. */
static aur_result read_head(aur_word_reader *in, const char *path, file_head *head, aur_error *error) {
    uint64_t *const n = head->numbers;
    for (size_t i = 0; i < HEAD_NUMBERS; ++i)
        n[i] = aur_word_get(in);
    const uint64_t length = aur_word_get(in);
    for (size_t i = 0; i < length && length <= NAME_LIMIT; ++i)
        head->name[i] = (char)aur_word_get(in);
    if (in->failed || length > NAME_LIMIT || memchr(head->name, '\0', length) != NULL)
        return damaged(path, "its head is cut or damaged", error);
    head->name[length] = '\0';
    if (n[4] > AUR_SCRAMBLE_ROTATE3D || n[6] > AUR_RADIOSITY_UNIFORM_ANGLE || n[7] > AUR_RADIOSITY_BY_AREA)
        return damaged(path, "its head has choices that do not exist", error);
    head->options = (aur_radiosity_options){.size = sizeof head->options,
                                            .sequence = head->name,
                                            .scramble = (aur_scramble)n[4],
                                            .seed = n[5],
                                            .directions = (aur_radiosity_directions)n[6],
                                            .emission = (aur_radiosity_emission)n[7],
                                            .bounces = n[8],
                                            .randomizations = n[9],
                                            .variant = n[10]};
    return AUR_OK;
}

/* Whether the rest of the file can hold this many sums, before memory is allocated. */
static bool has_room(const aur_word_reader *in, const file_head *head) {
    const uint64_t left = aur_words_left(in), count = head->options.randomizations,
                   patches = head->numbers[1];
    return (in->end - in->at) % 8 == 0 && count > 0 && count <= left && patches <= left / 6 &&
           left == count * (TALLY_NUMBERS + 6 * patches) + 1;
}

static aur_result read_solution(aur_word_reader *in, const aur_scene *scene, const char *path,
                                const aur_radiosity_options *options, aur_radiosity **radiosity,
                                aur_error *error) {
    file_head head;
    aur_result result = read_head(in, path, &head, error);
    if (result != AUR_OK)
        return result;
    if (!has_room(in, &head))
        return damaged(path, "it is cut short or too long", error);
    head.options.threads = options->threads;
    head.options.progress = options->progress;
    head.options.warnings = options->warnings;
    result = aur_radiosity_create(scene, &head.options, radiosity, error);
    if (result != AUR_OK)
        return result;
    aur_radiosity *const created = *radiosity;
    if (created->scene.hash != head.numbers[0] || created->scene.patch_count != head.numbers[1])
        return aur_fail_at(error, (aur_location){.file = path}, AUR_ERROR_FORMAT,
                           "the solution was made for another scene: triangles, materials or lights differ");
    created->paths = head.numbers[2];
    memcpy(&created->change, &head.numbers[3], sizeof created->change);
    for (size_t r = 0; r < created->options.randomizations; ++r)
        each_number(&created->tallies[r], get_number, in);
    if (!aur_word_check(in))
        return damaged(path, "its numbers are damaged", error);
    return AUR_OK;
}

aur_result aur_radiosity_load(const aur_scene *scene, const char *path, const aur_radiosity_options *options,
                              aur_radiosity **radiosity, aur_error *error) {
    *radiosity = NULL;
    aur_radiosity_options settings = {.size = sizeof settings};
    aur_radiosity_options_init(&settings, NULL);
    aur_result result = aur_options_read(options, sizeof settings, &settings, "aur_radiosity_options", error);
    if (result != AUR_OK)
        return result;
    char *data = NULL;
    size_t size = 0;
    result = aur_file_read(path, SIZE_MAX / 2, &data, &size, error);
    if (result != AUR_OK)
        return result;
    aur_word_reader in = {.at = (const unsigned char *)data + MAGIC_LENGTH,
                          .end = (const unsigned char *)data + size};
    if (size < MAGIC_LENGTH || memcmp(data, magic, MAGIC_LENGTH) != 0)
        result = damaged(path, "it does not begin with 'aureole-radiosity 1'", error);
    else
        result = read_solution(&in, scene, path, &settings, radiosity, error);
    free(data);
    if (result != AUR_OK) {
        aur_radiosity_destroy(*radiosity);
        *radiosity = NULL;
    }
    return result;
}
