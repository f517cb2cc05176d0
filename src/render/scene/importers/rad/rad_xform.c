/* Options of xform: transforms one after another, and arrays of them. */
#include <math.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/vector3d.h"
#include "render/scene/importers/rad/rad_reader.h"

enum { MOST_POSES = 100000 };

aur_rad_pose aur_rad_pose_identity(void) {
    return (aur_rad_pose){
        .m = {[0] = 1.0, [5] = 1.0, [10] = 1.0, [15] = 1.0}, .scale = 1.0, .modifier = {"", 0, 0}};
}

void aur_rad_pose_apply(const aur_rad_pose *pose, double w, double x[3]) {
    const double from[3] = {x[0], x[1], x[2]};
    for (size_t i = 0; i < 3; ++i) {
        const double *const row = pose->m + 4 * i;
        x[i] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2] + w * row[3];
    }
}

bool aur_rad_pose_mirrors(const aur_rad_pose *pose) {
    const double x[3] = {pose->m[0], pose->m[4], pose->m[8]}, y[3] = {pose->m[1], pose->m[5], pose->m[9]},
                 z[3] = {pose->m[2], pose->m[6], pose->m[10]};
    double across[3];
    aur_cross3(x, y, across);
    return aur_dot3(across, z) < 0.0;
}

static void multiply(const double a[16], const double b[16], double product[16]) {
    for (size_t i = 0; i < 16; ++i) {
        product[i] = 0.0;
        for (size_t k = 0; k < 4; ++k)
            product[i] += a[i / 4 * 4 + k] * b[4 * k + i % 4];
    }
}

aur_rad_pose aur_rad_pose_multiply(const aur_rad_pose *outer, const aur_rad_pose *inner) {
    aur_rad_pose pose = {.scale = outer->scale * inner->scale,
                         .inverts = outer->inverts != inner->inverts,
                         .modifier = outer->modifier.length > 0 ? outer->modifier : inner->modifier};
    multiply(outer->m, inner->m, pose.m);
    return pose;
}

/* Rotation about an axis; multiples of 90 degrees are exact. */
static void set_rotation(size_t axis, double degrees, double m[16]) {
    const double turn = remainder(degrees, 360.0), angle = turn * 3.14159265358979323846 / 180.0;
    const bool exact = fmod(turn, 90.0) == 0.0;
    const double cosine = exact ? round(cos(angle)) : cos(angle),
                 sine = exact ? round(sin(angle)) : sin(angle);
    const size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    m[4 * a + a] = m[4 * b + b] = cosine;
    m[4 * b + a] = sine;
    m[4 * a + b] = -sine;
}

/* The words being parsed. */
typedef struct options {
    aur_rad *rad;
    size_t count, at;
    const aur_rad_word *words;
} options;

static aur_result read_numbers(options *self, size_t count, double *numbers) {
    const aur_rad_word option = self->words[self->at];
    for (size_t i = 0; i < count; ++i) {
        ++self->at;
        if (self->at == self->count || !aur_rad_number(self->words[self->at], &numbers[i]))
            return aur_rad_fail(self->rad, option.line, AUR_ERROR_FORMAT,
                                "xform: %zu number%s expected after '%.*s'", count, count > 1 ? "s" : "",
                                (int)option.length, option.text);
    }
    ++self->at;
    return AUR_OK;
}

/* Parses one of -t, -rx ..., -mx ..., -s. *recognised: whether it was one of these. */
static aur_result read_step(options *self, aur_rad_pose *pose, bool *recognised) {
    const aur_rad_word word = self->words[self->at];
    const size_t axis = word.length == 3 ? (size_t)((unsigned char)word.text[2] - 'x') : 3;
    const bool moves = aur_rad_is_word(word, "-t"), scales = aur_rad_is_word(word, "-s");
    const bool turns = axis < 3 && strncmp(word.text, "-r", 2) == 0;
    const bool mirrors = axis < 3 && strncmp(word.text, "-m", 2) == 0;
    aur_rad_pose step = aur_rad_pose_identity();
    double x[3] = {1.0};
    *recognised = moves || scales || turns || mirrors;
    if (!*recognised)
        return AUR_OK;
    const aur_result result = read_numbers(self, mirrors ? 0 : moves ? 3 : 1, x);
    if (result == AUR_OK && scales && x[0] == 0.0)
        return aur_rad_fail(self->rad, word.line, AUR_ERROR_FORMAT, "xform: -s must not be 0");
    for (size_t i = 0; i < 3; ++i) {
        step.m[4 * i + 3] = moves ? x[i] : 0.0;
        step.m[5 * i] = scales ? x[0] : mirrors && i == axis ? -1.0 : 1.0;
    }
    if (turns)
        set_rotation(axis, x[0], step.m);
    step.scale = scales ? fabs(x[0]) : 1.0;
    step.modifier = pose->modifier;
    *pose = aur_rad_pose_multiply(&step, pose);
    return result;
}

/* Composes each pose with `first` to `first + count - 1` applications of `step`. */
static aur_result repeat(options *self, const aur_rad_pose *step, size_t first, size_t count) {
    aur_rad *const rad = self->rad;
    const size_t existing = rad->pose_count;
    if (existing > MOST_POSES / count)
        return aur_rad_fail(rad, self->words[0].line, AUR_ERROR_FORMAT,
                            "xform: arrays of more than %d objects", (int)MOST_POSES);
    if (!aur_array_reserve(&rad->poses, &rad->pose_capacity, existing * count, sizeof *rad->poses))
        return aur_fail_memory(rad->error);
    for (size_t k = existing; k-- > 0;) {
        aur_rad_pose pose = rad->poses[k];
        for (size_t i = 0; i < first; ++i)
            pose = aur_rad_pose_multiply(step, &pose);
        for (size_t i = 0; i < count; ++i) {
            rad->poses[k * count + i] = pose;
            pose = aur_rad_pose_multiply(step, &pose);
        }
    }
    rad->pose_count = existing * count;
    return AUR_OK;
}

/* -a N and -i N: the following transform is repeated. */
static aur_result read_repetition(options *self, size_t *count) {
    const aur_rad_word option = self->words[self->at];
    double number = 0.0;
    const aur_result result = read_numbers(self, 1, &number);
    if (result == AUR_OK && !(number >= 0.0 && number <= MOST_POSES && number == floor(number)))
        return aur_rad_fail(self->rad, option.line, AUR_ERROR_FORMAT,
                            "xform: %.*s must be a whole number from 0 to %d", (int)option.length,
                            option.text, (int)MOST_POSES);
    *count = (size_t)number;
    return result;
}

/* Options that do not transform. */
static aur_result read_other(options *self, aur_rad_pose *pose, bool *recognised) {
    const aur_rad_word word = self->words[self->at];
    const bool names = aur_rad_is_word(word, "-n"), material = aur_rad_is_word(word, "-m");
    const bool inverts = aur_rad_is_word(word, "-I");
    *recognised = names || material || inverts || aur_rad_is_word(word, "-e") || aur_rad_is_word(word, "-c");
    if ((names || material) && ++self->at == self->count)
        return aur_rad_fail(self->rad, word.line, AUR_ERROR_FORMAT, "xform: a name expected after '%.*s'",
                            (int)word.length, word.text);
    if (material)
        pose->modifier = self->words[self->at];
    pose->inverts = pose->inverts != inverts;
    self->at += *recognised;
    return AUR_OK;
}

aur_result aur_rad_chain_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used) {
    options reading = {.rad = self, .count = count, .words = words};
    aur_rad_pose step = aur_rad_pose_identity();
    size_t first = 1, repetitions = 1;
    aur_result result = AUR_OK;
    bool recognised = true;
    while (result == AUR_OK && recognised && reading.at < count) {
        const aur_rad_word word = words[reading.at];
        const bool array = aur_rad_is_word(word, "-a"), iterates = aur_rad_is_word(word, "-i");
        if (array || iterates) {
            size_t number = 0;
            result = repeat(&reading, &step, first, repetitions);
            if (result == AUR_OK)
                result = read_repetition(&reading, &number);
            step = aur_rad_pose_identity();
            first = array ? 0 : number;
            repetitions = array ? number : 1;
            if (result == AUR_OK && repetitions == 0)
                result = aur_rad_fail(self, word.line, AUR_ERROR_FORMAT, "xform: -a 0 makes nothing");
            continue;
        }
        result = read_step(&reading, &step, &recognised);
        if (result == AUR_OK && !recognised)
            result = read_other(&reading, &step, &recognised);
    }
    *used = reading.at;
    return result == AUR_OK ? repeat(&reading, &step, first, repetitions) : result;
}

aur_result aur_rad_read_xform(aur_rad *self, size_t count, const aur_rad_word *words, size_t *used) {
    if (!aur_array_reserve(&self->poses, &self->pose_capacity, 1, sizeof *self->poses))
        return aur_fail_memory(self->error);
    self->pose_count = 1;
    self->poses[0] = aur_rad_pose_identity();
    return aur_rad_chain_xform(self, count, words, used);
}
