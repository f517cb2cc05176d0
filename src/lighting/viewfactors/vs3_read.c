/* Reads View3D's input, vertices and surfaces of three or four corners, as a scene of polygons. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/facets.h"
#include "points/base/array.h"
#include "points/base/file.h"
#include "points/base/text.h"

enum { LARGEST_FILE = 1 << 30, MOST_WORDS = 16, DEEPEST = 16 };

/* A line of the file as words. */
typedef struct line {
    size_t number, count;
    const char *words[MOST_WORDS];
    size_t lengths[MOST_WORDS];
} line;

typedef struct surface {
    size_t corners[4], count; /* indices of vertices */
    size_t base, leader;      /* numbers of other surfaces, or 0 */
    size_t depth;             /* length of the chain of base surfaces */
    size_t line;
} surface;

typedef struct reading {
    const char *path, *at, *end;
    line line;
    double (*vertices)[3];
    surface *surfaces;
    size_t vertex_count, vertex_capacity, surface_count, surface_capacity, name_capacity, emittance_capacity;
    aur_vs3 *model;
    aur_error *error;
} reading;

static aur_result fail(const reading *self, size_t number, aur_result result, const char *what) {
    return aur_fail_at(self->error, (aur_location){self->path, number, 0}, result, "%s", what);
}

/* The next line that is not empty; false at the end. Comments begin with an exclamation mark. */
static bool next_line(reading *self) {
    line *const l = &self->line;
    while (self->at < self->end) {
        ++l->number;
        l->count = 0;
        const char *const stop = memchr(self->at, '\n', (size_t)(self->end - self->at));
        const char *const end = stop != NULL ? stop : self->end;
        const char *at = self->at;
        self->at = stop != NULL ? stop + 1 : self->end;
        while (l->count < MOST_WORDS) {
            while (at < end && (aur_is_space(*at) || *at == ','))
                ++at;
            if (at == end || *at == '!')
                break;
            l->words[l->count] = at;
            while (at < end && !aur_is_space(*at) && *at != ',' && *at != '!')
                ++at;
            l->lengths[l->count] = (size_t)(at - l->words[l->count]);
            ++l->count;
        }
        if (l->count > 0)
            return true;
    }
    return false;
}

/* Reads word `index` of the line as a number. */
static bool read_number(const line *l, size_t index, double *number) {
    char text[64];
    if (index >= l->count || l->lengths[index] >= sizeof text)
        return false;
    memcpy(text, l->words[index], l->lengths[index]);
    text[l->lengths[index]] = '\0';
    return aur_parse_double(text, number) && isfinite(*number);
}

/* An integer from 0 to `most`. */
static bool read_index(const line *l, size_t index, size_t most, size_t *value) {
    double number;
    if (!read_number(l, index, &number) || !(number >= 0.0 && number <= (double)most) ||
        number != floor(number))
        return false;
    *value = (size_t)number;
    return true;
}

static aur_result read_vertex(reading *self) {
    double x[4] = {0.0};
    for (size_t i = 0; i < 4; ++i)
        if (!read_number(&self->line, 1 + i, &x[i]))
            return fail(self, self->line.number, AUR_ERROR_FORMAT,
                        "V: a number and three coordinates expected");
    if (x[0] != (double)(self->vertex_count + 1))
        return fail(self, self->line.number, AUR_ERROR_FORMAT, "V: vertices must be numbered 1, 2, 3, ...");
    if (!aur_array_reserve(&self->vertices, &self->vertex_capacity, self->vertex_count + 1,
                           sizeof *self->vertices))
        return aur_fail_memory(self->error);
    memcpy(self->vertices[self->vertex_count++], x + 1, sizeof *self->vertices);
    return AUR_OK;
}

static aur_result add_name(reading *self, double emittance) {
    const line *const l = &self->line;
    aur_vs3 *const model = self->model;
    const size_t count = self->surface_count;
    if (!aur_array_reserve(&model->names, &self->name_capacity, count + 1, sizeof *model->names) ||
        !aur_array_reserve(&model->emittances, &self->emittance_capacity, count + 1,
                           sizeof *model->emittances))
        return aur_fail_memory(self->error);
    model->emittances[count] = emittance;
    model->names[count] = l->count > 9 ? strndup(l->words[9], l->lengths[9]) : strdup("");
    model->name_count += model->names[count] != NULL;
    return model->names[count] != NULL ? AUR_OK : aur_fail_memory(self->error);
}

/* S n v1 v2 v3 v4 base combined emittance name */
static aur_result read_surface(reading *self) {
    const line *const l = &self->line;
    surface parsed = {.line = l->number};
    size_t number = 0;
    double emittance = 1.0;
    if (!read_index(l, 1, SIZE_MAX / 2, &number) || number != self->surface_count + 1)
        return fail(self, l->number, AUR_ERROR_FORMAT, "S: surfaces must be numbered 1, 2, 3, ...");
    for (size_t i = 0; i < 4; ++i) {
        size_t vertex;
        if (!read_index(l, 2 + i, self->vertex_count, &vertex) || (vertex == 0 && i < 3))
            return fail(self, l->number, AUR_ERROR_FORMAT, "S: numbers of vertices above expected");
        parsed.corners[parsed.count] = vertex - 1;
        parsed.count += vertex > 0;
    }
    if (!read_index(l, 6, self->surface_count, &parsed.base) ||
        !read_index(l, 7, self->surface_count, &parsed.leader))
        return fail(self, l->number, AUR_ERROR_FORMAT,
                    "S: base and combined surface must be 0 or the number of a surface above");
    parsed.depth = parsed.base > 0 ? self->surfaces[parsed.base - 1].depth + 1 : 0;
    if (parsed.depth > DEEPEST)
        return fail(self, l->number, AUR_ERROR_UNSUPPORTED, "S: more than 16 surfaces on each other");
    if (parsed.leader > 0 && self->surfaces[parsed.leader - 1].leader > 0)
        return fail(self, l->number, AUR_ERROR_FORMAT, "S: combined with a surface that is combined itself");
    if (l->count > 8 && !(read_number(l, 8, &emittance) && emittance >= 0.0 && emittance <= 1.0))
        return fail(self, l->number, AUR_ERROR_FORMAT, "S: an emittance from 0 to 1 expected");
    if (!aur_array_reserve(&self->surfaces, &self->surface_capacity, self->surface_count + 1,
                           sizeof *self->surfaces))
        return aur_fail_memory(self->error);
    self->surfaces[self->surface_count] = parsed;
    const aur_result result = add_name(self, emittance);
    self->surface_count += result == AUR_OK;
    return result;
}

static aur_result read_line(reading *self) {
    const line *const l = &self->line;
    switch (l->words[0][0] & ~32) {
    case 'V':
        return read_vertex(self);
    case 'S':
        return read_surface(self);
    case 'O':
        return fail(self, l->number, AUR_ERROR_UNSUPPORTED,
                    "O: an obstruction without a row is not read: make it a surface (S)");
    case 'M':
    case 'N':
        return fail(self, l->number, AUR_ERROR_UNSUPPORTED, "masks and null surfaces are not read");
    case 'F':
        return l->count > 1 && l->lengths[1] == 1 && l->words[1][0] == '3'
                   ? AUR_OK
                   : fail(self, l->number, AUR_ERROR_UNSUPPORTED, "F: only the format 3 is read");
    default: /* title, control */
        return AUR_OK;
    }
}

static void write_surface(const reading *self, size_t index, size_t *lines, FILE *stream) {
    const surface *const s = &self->surfaces[index];
    for (; *lines < s->line; ++*lines) /* so that messages name the file's lines */
        fputc('\n', stream);
    fprintf(stream, "s polygon s 0 0 %zu", 3 * s->count);
    for (size_t i = 0; i < s->count; ++i)
        for (size_t d = 0; d < 3; ++d)
            aur_print(stream, " %.17g", self->vertices[s->corners[i]][d]);
    fputc('\n', stream);
    ++*lines;
}

/* Groups are surfaces that are not combined with others, in their order. */
static aur_result write_scene(reading *self) {
    aur_vs3 *const model = self->model;
    const size_t count = self->surface_count;
    size_t deepest = 0, lines = 1, written = 0;
    size_t *const numbers = calloc(count + 1, sizeof *numbers);
    model->groups = calloc(count + 1, sizeof *model->groups);
    FILE *const stream = open_memstream(&model->text, &model->length);
    if (numbers == NULL || model->groups == NULL || stream == NULL) {
        free(numbers);
        if (stream != NULL)
            fclose(stream);
        return aur_fail_memory(self->error);
    }
    for (size_t i = 0; i < count; ++i) {
        const size_t depth = self->surfaces[i].depth;
        deepest = depth > deepest ? depth : deepest;
        numbers[i] =
            self->surfaces[i].leader > 0 ? numbers[self->surfaces[i].leader - 1] : model->group_count;
        if (self->surfaces[i].leader > 0)
            continue;
        char *const name = model->names[i]; /* names of groups first, by index */
        model->names[i] = model->names[model->group_count];
        model->names[model->group_count] = name;
        model->emittances[model->group_count++] = model->emittances[i];
    }
    fputs("void plastic s 0 0 5 .5 .5 .5 0 0 ", stream);
    /* Surfaces with a base come first, so that they are cut out of it. */
    for (size_t depth = deepest + 1; depth-- > 0;)
        for (size_t i = 0; i < count; ++i)
            if (self->surfaces[i].depth == depth) {
                model->groups[written++] = (uint32_t)numbers[i];
                write_surface(self, i, &lines, stream);
            }
    model->shape_count = written;
    free(numbers);
    return fclose(stream) == 0 ? AUR_OK : aur_fail_memory(self->error);
}

void aur_vs3_release(aur_vs3 *self) {
    for (size_t i = 0; i < self->name_count; ++i)
        free(self->names[i]);
    free(self->names);
    free(self->emittances);
    free(self->groups);
    free(self->text);
    *self = (aur_vs3){0};
}

aur_result aur_vs3_parse(const char *path, size_t size, const char *data, aur_vs3 *model, aur_error *error) {
    *model = (aur_vs3){0};
    reading self = {.path = path, .at = data, .end = data + size, .model = model, .error = error};
    aur_result result = AUR_OK;
    while (result == AUR_OK && next_line(&self) && (self.line.words[0][0] & ~32) != 'E')
        result = read_line(&self);
    if (result == AUR_OK && self.surface_count == 0)
        result = fail(&self, self.line.number, AUR_ERROR_FORMAT, "no surface (S) in this file");
    if (result == AUR_OK)
        result = write_scene(&self);
    free(self.vertices);
    free(self.surfaces);
    if (result != AUR_OK)
        aur_vs3_release(model);
    return result;
}

aur_result aur_vs3_read(const char *path, aur_vs3 *model, aur_error *error) {
    *model = (aur_vs3){0};
    char *text;
    size_t size;
    aur_result result = aur_file_read(path, LARGEST_FILE, &text, &size, error);
    if (result != AUR_OK)
        return result;
    result = aur_vs3_parse(path, size, text, model, error);
    free(text);
    return result;
}
