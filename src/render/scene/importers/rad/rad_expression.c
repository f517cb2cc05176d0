/* Expressions of Radiance (calcomp) in one variable, t: + - * / ^, parentheses, numbers, PI and built-in
 * functions. */
#include <math.h>
#include <string.h>

#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

enum { DEEPEST = 64, MOST_ARGUMENTS = 5 };

typedef struct expression {
    const aur_rad *rad;
    aur_rad_word text;
    const char *at, *end;
    double t;
    size_t depth;
    aur_result result;
} expression;

static double fail(expression *self, aur_result result, const char *what, size_t length, const char *text) {
    if (self->result == AUR_OK)
        self->result =
            aur_rad_fail(self->rad, self->text.line, result, "%s in '%.*s': '%.*s'", what,
                         (int)self->text.length, self->text.text, length > 40 ? 40 : (int)length, text);
    self->at = self->end;
    return 0.0;
}

static double take_if(const double *x) {
    return x[0] > 0.0 ? x[1] : x[2];
}

static double take_hermite(const double *x) {
    const double t = x[4];
    return x[0] * ((2.0 * t - 3.0) * t * t + 1.0) + x[1] * (3.0 - 2.0 * t) * t * t +
           x[2] * ((t - 2.0) * t + 1.0) * t + x[3] * (t - 1.0) * t * t;
}

static double take_bezier(const double *x) {
    const double t = x[4], s = 1.0 - t;
    return x[0] * s * s * s + 3.0 * x[1] * t * s * s + 3.0 * x[2] * t * t * s + x[3] * t * t * t;
}

static double take_modulo(const double *x) {
    return fmod(x[0], x[1]);
}

/* Functions with one, two and more arguments. */
static const struct {
    const char *name;
    size_t arguments;
    double (*one)(double);
    double (*two)(double, double);
    double (*many)(const double *);
} functions[] = {
    {"sin", 1, sin, NULL, NULL},
    {"cos", 1, cos, NULL, NULL},
    {"tan", 1, tan, NULL, NULL},
    {"asin", 1, asin, NULL, NULL},
    {"acos", 1, acos, NULL, NULL},
    {"atan", 1, atan, NULL, NULL},
    {"exp", 1, exp, NULL, NULL},
    {"log", 1, log, NULL, NULL},
    {"log10", 1, log10, NULL, NULL},
    {"sqrt", 1, sqrt, NULL, NULL},
    {"ceil", 1, ceil, NULL, NULL},
    {"floor", 1, floor, NULL, NULL},
    {"abs", 1, fabs, NULL, NULL},
    {"atan2", 2, NULL, atan2, NULL},
    {"min", 2, NULL, fmin, NULL},
    {"max", 2, NULL, fmax, NULL},
    {"mod", 2, NULL, NULL, take_modulo},
    {"if", 3, NULL, NULL, take_if},
    {"hermite", 5, NULL, NULL, take_hermite},
    {"bezier", 5, NULL, NULL, take_bezier},
};

enum { FUNCTIONS = sizeof functions / sizeof functions[0] };

static double read_sum(expression *self);

static char next(expression *self) {
    while (self->at < self->end && aur_is_space(*self->at))
        ++self->at;
    return self->at < self->end ? *self->at : '\0';
}

static bool take(expression *self, char c) {
    const bool found = next(self) == c && self->at < self->end;
    self->at += found;
    return found;
}

static double call(expression *self, size_t index, aur_rad_word name) {
    double x[MOST_ARGUMENTS] = {0.0};
    size_t count = 0;
    do {
        if (count == MOST_ARGUMENTS)
            return fail(self, AUR_ERROR_FORMAT, "too many arguments", name.length, name.text);
        x[count++] = read_sum(self);
    } while (take(self, ','));
    if (self->result == AUR_OK && (!take(self, ')') || count != functions[index].arguments))
        return fail(self, AUR_ERROR_FORMAT, "wrong arguments", name.length, name.text);
    return functions[index].one != NULL   ? functions[index].one(x[0])
           : functions[index].two != NULL ? functions[index].two(x[0], x[1])
                                          : functions[index].many(x);
}

static double read_name(expression *self) {
    aur_rad_word name = {self->at, 0, self->text.line};
    while (self->at < self->end && (aur_is_digit(*self->at) || *self->at == '_' ||
                                    ((unsigned char)(*self->at | 32) >= 'a' && (*self->at | 32) <= 'z')))
        ++self->at;
    name.length = (size_t)(self->at - name.text);
    size_t i = 0;
    while (i < FUNCTIONS && !aur_rad_is_word(name, functions[i].name))
        ++i;
    if (i < FUNCTIONS && take(self, '('))
        return call(self, i, name);
    if (aur_rad_is_word(name, "t"))
        return self->t;
    if (aur_rad_is_word(name, "PI"))
        return 3.14159265358979323846;
    return name.length > 0 ? fail(self, AUR_ERROR_UNSUPPORTED, "unknown name", name.length, name.text)
                           : fail(self, AUR_ERROR_FORMAT, "a number or name expected",
                                  (size_t)(self->end - name.text), name.text);
}

static double read_term(expression *self) {
    const char c = next(self);
    if (take(self, '(')) {
        const double value = read_sum(self);
        return take(self, ')') || self->result != AUR_OK
                   ? value
                   : fail(self, AUR_ERROR_FORMAT, "')' expected", (size_t)(self->end - self->at), self->at);
    }
    if (!aur_is_digit(c) && c != '.')
        return read_name(self);
    double value = 0.0;
    const char *const after = aur_read_double(self->at, AUR_NUMBER_FINITE, &value);
    if (after == NULL || after > self->end)
        return fail(self, AUR_ERROR_FORMAT, "a number expected", (size_t)(self->end - self->at), self->at);
    self->at = after;
    return value;
}

/* Unary minus binds tighter than a power, as in calcomp. */
static double read_power(expression *self) {
    if (++self->depth > DEEPEST)
        return fail(self, AUR_ERROR_FORMAT, "nested too deeply", 0, "");
    const bool minus = take(self, '-');
    if (!minus)
        take(self, '+');
    double value = read_term(self);
    if (minus)
        value = -value;
    if (take(self, '^'))
        value = pow(value, read_power(self));
    --self->depth;
    return value;
}

static double read_product(expression *self) {
    double value = read_power(self);
    for (;;) {
        if (take(self, '*'))
            value *= read_power(self);
        else if (take(self, '/'))
            value /= read_power(self);
        else
            return value;
    }
}

static double read_sum(expression *self) {
    double value = read_product(self);
    for (;;) {
        if (take(self, '+'))
            value += read_product(self);
        else if (take(self, '-'))
            value -= read_product(self);
        else
            return value;
    }
}

aur_result aur_rad_evaluate(const aur_rad *self, aur_rad_word text, double t, double *value) {
    expression reading = {.rad = self, .text = text, .at = text.text, .end = text.text + text.length, .t = t};
    *value = read_sum(&reading);
    if (reading.result == AUR_OK && next(&reading) != '\0')
        fail(&reading, AUR_ERROR_FORMAT, "an operator expected", (size_t)(reading.end - reading.at),
             reading.at);
    if (reading.result == AUR_OK && !isfinite(*value))
        fail(&reading, AUR_ERROR_FORMAT, "a finite value expected", 0, "");
    return reading.result;
}
