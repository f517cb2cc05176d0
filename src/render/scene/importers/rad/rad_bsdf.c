/* BSDF files of LBNL WINDOW: matrices between directions of Klems bases. */
#include <expat.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/text.h"
#include "render/scene/importers/rad/rad_reader.h"

enum { MOST_BASES = 8, MOST_BANDS = 64, MOST_PATCHES = 4096, LONGEST_NAME = 64 };

#define PI 3.14159265358979323846

/* Elevation bands of a basis, each divided into equal patches. */
typedef struct basis {
    char name[LONGEST_NAME];
    size_t bands;
    double lower[MOST_BANDS], upper[MOST_BANDS]; /* degrees from the normal */
    size_t patches[MOST_BANDS];
} basis;

/* One WavelengthDataBlock. */
typedef struct block {
    char direction[LONGEST_NAME], rows[LONGEST_NAME], columns[LONGEST_NAME];
    double *values;
    size_t count, capacity;
} block;

typedef struct bsdf_file {
    XML_Parser parser;
    char *text; /* of the open element */
    size_t length, capacity;
    size_t basis_count;
    basis bases[MOST_BASES];
    bool visible;
    block block;
    double sums[2]; /* reflected, transmitted */
    size_t counts[2];
    const char *wrong; /* NULL: none */
    bool short_of_memory;
} bsdf_file;

static void stop(bsdf_file *self, const char *wrong) {
    self->wrong = self->wrong != NULL ? self->wrong : wrong;
    XML_StopParser(self->parser, XML_FALSE);
}

static void XMLCALL on_start(void *user, const XML_Char *tag, const XML_Char **attributes) {
    (void)attributes;
    bsdf_file *const self = user;
    self->length = 0;
    if (strcmp(tag, "AngleBasis") == 0) {
        if (self->basis_count == MOST_BASES)
            stop(self, "more than 8 angle bases");
        else
            self->bases[self->basis_count++] = (basis){.bands = 0};
    } else if (strcmp(tag, "AngleBasisBlock") == 0 && self->basis_count > 0) {
        if (++self->bases[self->basis_count - 1].bands > MOST_BANDS)
            stop(self, "more than 64 bands of elevation");
    } else if (strcmp(tag, "WavelengthDataBlock") == 0) {
        self->block.count = 0;
        self->block.direction[0] = self->block.rows[0] = self->block.columns[0] = '\0';
    }
}

static void XMLCALL on_text(void *user, const XML_Char *text, int length) {
    bsdf_file *const self = user;
    if (!aur_array_reserve(&self->text, &self->capacity, self->length + (size_t)length + 1, 1)) {
        self->short_of_memory = true;
        stop(self, "");
        return;
    }
    memcpy(self->text + self->length, text, (size_t)length);
    self->length += (size_t)length;
    self->text[self->length] = '\0';
}

/* Matrix elements: numbers separated by blanks or commas. */
static void read_values(bsdf_file *self) {
    block *const to = &self->block;
    for (const char *at = self->text; self->length > 0;) {
        while (aur_is_space(*at) || *at == ',')
            ++at;
        if (*at == '\0')
            return;
        if (!aur_array_reserve(&to->values, &to->capacity, to->count + 1, sizeof *to->values)) {
            self->short_of_memory = true;
            stop(self, "");
            return;
        }
        at = aur_read_double(at, AUR_NUMBER_FINITE, &to->values[to->count++]);
        if (at == NULL) {
            stop(self, "ScatteringData: a number expected");
            return;
        }
    }
}

/* Projected solid angles of the patches of a basis, which sum to pi. Returns the number of patches. */
static size_t weigh(const bsdf_file *self, const char *name, double *weights) {
    const basis *found = NULL;
    for (size_t i = 0; i < self->basis_count; ++i)
        if (strcmp(self->bases[i].name, name) == 0)
            found = &self->bases[i];
    size_t count = 0;
    for (size_t i = 0; found != NULL && i < found->bands; ++i) {
        const double a = sin(found->lower[i] * PI / 180.0), b = sin(found->upper[i] * PI / 180.0);
        for (size_t k = 0; k < found->patches[i] && count < MOST_PATCHES; ++k)
            weights[count++] = PI * (b * b - a * a) / (double)found->patches[i];
    }
    return count;
}

static void add_block(bsdf_file *self) {
    double rows[MOST_PATCHES], columns[MOST_PATCHES], sum = 0.0;
    const block *const from = &self->block;
    const bool through = strncmp(from->direction, "Transmission", 12) == 0;
    if (!self->visible || (!through && strncmp(from->direction, "Reflection", 10) != 0))
        return;
    const size_t n = weigh(self, from->rows[0] != '\0' ? from->rows : from->columns, rows),
                 m = weigh(self, from->columns, columns);
    if (n == 0 || n * m != from->count) {
        stop(self, "the matrix and its angle basis have different sizes");
        return;
    }
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < m; ++k)
            sum += rows[i] * columns[k] * from->values[i * m + k];
    self->sums[through] += sum / PI;
    ++self->counts[through];
}

static void copy_text(const bsdf_file *self, char target[LONGEST_NAME]) {
    const char *const text = self->length > 0 ? aur_skip_spaces(self->text) : "";
    size_t length = strlen(text);
    while (length > 0 && aur_is_space(text[length - 1]))
        --length;
    length = length < LONGEST_NAME - 1 ? length : LONGEST_NAME - 1;
    memcpy(target, text, length);
    target[length] = '\0';
}

static double read_number(bsdf_file *self, double most) {
    double value = 0.0;
    if (self->length == 0 ||
        aur_read_double(aur_skip_spaces(self->text), AUR_NUMBER_FINITE, &value) == NULL || value < 0.0 ||
        value > most)
        stop(self, "an angle basis has numbers out of range");
    return value;
}

static void XMLCALL on_end(void *user, const XML_Char *tag) {
    bsdf_file *const self = user;
    basis *const last = self->basis_count > 0 ? &self->bases[self->basis_count - 1] : NULL;
    const size_t band = last != NULL && last->bands > 0 ? last->bands - 1 : 0;
    char word[LONGEST_NAME];
    copy_text(self, word);
    if (strcmp(tag, "AngleBasisName") == 0 && last != NULL)
        copy_text(self, last->name);
    else if (strcmp(tag, "LowerTheta") == 0 && last != NULL)
        last->lower[band] = read_number(self, 90.0);
    else if (strcmp(tag, "UpperTheta") == 0 && last != NULL)
        last->upper[band] = read_number(self, 90.0);
    else if (strcmp(tag, "nPhis") == 0 && last != NULL)
        last->patches[band] = (size_t)read_number(self, MOST_PATCHES);
    else if (strcmp(tag, "Wavelength") == 0)
        self->visible = strcmp(word, "Visible") == 0;
    else if (strcmp(tag, "WavelengthDataDirection") == 0)
        copy_text(self, self->block.direction);
    else if (strcmp(tag, "RowAngleBasis") == 0)
        copy_text(self, self->block.rows);
    else if (strcmp(tag, "ColumnAngleBasis") == 0)
        copy_text(self, self->block.columns);
    else if (strcmp(tag, "ScatteringData") == 0)
        read_values(self);
    else if (strcmp(tag, "WavelengthDataBlock") == 0)
        add_block(self);
    else if (strcmp(tag, "IncidentDataStructure") == 0 && strncmp(word, "TensorTree", 10) == 0)
        stop(self, "a tensor tree is not read, only matrices in Klems' bases");
    self->length = 0;
}

static aur_result parse(aur_rad *rad, bsdf_file *self, aur_rad_word name, const char *text, size_t size) {
    XML_SetUserData(self->parser, self);
    XML_SetElementHandler(self->parser, on_start, on_end);
    XML_SetCharacterDataHandler(self->parser, on_text);
    const bool whole = XML_Parse(self->parser, text, (int)size, 1) == XML_STATUS_OK;
    if (self->short_of_memory)
        return aur_fail_memory(rad->error);
    if (!whole && self->wrong == NULL)
        self->wrong = XML_ErrorString(XML_GetErrorCode(self->parser));
    if (self->wrong == NULL && self->counts[0] + self->counts[1] == 0)
        self->wrong = "no visible matrix in it";
    return self->wrong == NULL ? AUR_OK
                               : aur_rad_fail(rad, name.line, AUR_ERROR_UNSUPPORTED, "BSDF: '%.*s': %s",
                                              (int)name.length, name.text, self->wrong);
}

aur_result aur_rad_bsdf_read(aur_rad *self, aur_rad_word name, aur_rad_bsdf_means *means) {
    bsdf_file *const file = calloc(1, sizeof *file);
    char *text = NULL;
    size_t size = 0;
    if (file != NULL)
        file->parser = XML_ParserCreate(NULL);
    aur_result result = file == NULL || file->parser == NULL ? aur_fail_memory(self->error)
                                                             : aur_rad_read_file(self, name, &text, &size);
    if (result == AUR_OK)
        result = parse(self, file, name, text, size);
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i) {
        const double mean = file->counts[i] > 0 ? file->sums[i] / (double)file->counts[i] : 0.0;
        *(i == 0 ? &means->reflected : &means->through) = fmin(fmax(mean, 0.0), 1.0);
    }
    if (file != NULL) {
        if (file->parser != NULL)
            XML_ParserFree(file->parser);
        free(file->text);
        free(file->block.values);
    }
    free(file);
    free(text);
    return result;
}
