/* Reflectances, emittances and temperatures of rows, from a table. */
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/cli/cli.h"
#include "program/cli/lighting/viewfactors.h"

static const double STEFAN_BOLTZMANN = 5.670374419e-8;

enum { MOST_COLUMNS = 16 };

typedef enum column { ROW, NAME, REFLECTANCE, EMITTANCE, TEMPERATURE, EMISSION, COLUMNS } column;

static const char *const names[COLUMNS] = {"row",       "name",        "reflectance",
                                           "emittance", "temperature", "emission"};

typedef struct table_reading {
    const char *path;
    size_t line, columns;
    column order[MOST_COLUMNS];
    bool has[COLUMNS];
    bool *named; /* rows that a line has named */
} table_reading;

static int fail(const table_reading *self, const char *what, const char *found) {
    cli_bad_usage("%s:%zu: %s (%s)", self->path, self->line, what, found);
    return CLI_BAD_INPUT;
}

/* The next field of a line, trimmed; NULL at the end. */
static char *next_field(char **at) {
    char *field = *at;
    if (field == NULL)
        return NULL;
    char *const comma = strchr(field, ',');
    *at = comma != NULL ? comma + 1 : NULL;
    if (comma != NULL)
        *comma = '\0';
    field += strspn(field, " \t\"");
    size_t length = strlen(field);
    while (length > 0 && strchr(" \t\r\n\"", field[length - 1]) != NULL)
        field[--length] = '\0';
    return field;
}

static int read_header(table_reading *self, char *text) {
    for (char *at = text, *field; (field = next_field(&at)) != NULL;) {
        size_t i = 0;
        while (i < COLUMNS && strcmp(field, names[i]) != 0)
            ++i;
        if (i == COLUMNS || self->columns == MOST_COLUMNS || self->has[i])
            return fail(self,
                        "a header of name or row, reflectance or emittance, temperature or emission expected",
                        field);
        self->has[i] = true;
        self->order[self->columns++] = (column)i;
    }
    if (self->has[ROW] == self->has[NAME] || (self->has[REFLECTANCE] == self->has[EMITTANCE]) ||
        (self->has[TEMPERATURE] && self->has[EMISSION]) || (self->has[TEMPERATURE] && !self->has[EMITTANCE]))
        return fail(
            self,
            "columns expected: name or row; reflectance or emittance; at most one of emission and, with "
            "emittance, temperature",
            "header");
    return CLI_SUCCESS;
}

/* Whether a line with this name applies to the row. */
static bool is_of_row(const table_reading *self, const aur_facets *facets, const char *field, size_t row) {
    if (strcmp(field, "*") == 0)
        return true;
    double number;
    if (self->has[ROW])
        return aur_parse_double(field, &number) && number == (double)row;
    const char *const name = aur_facets_name(facets, row);
    return name != NULL && strcmp(name, field) == 0;
}

/* Applies a line's numbers to every row that it names; lines for '*' apply to rows that no line names, in any
 * order. */
static int use_line(const table_reading *self, const aur_facets *facets, const char *key,
                    const double values[COLUMNS], cli_surfaces *properties) {
    const double emittance = self->has[EMITTANCE] ? values[EMITTANCE] : 1.0 - values[REFLECTANCE];
    const double kelvin = self->has[TEMPERATURE] ? values[TEMPERATURE] : 0.0;
    if (!(emittance >= 0.0 && emittance <= 1.0))
        return fail(self, "a reflectance or emittance from 0 to 1 expected", key);
    if (!(kelvin >= 0.0 && kelvin < 1e6) || !(values[EMISSION] >= 0.0))
        return fail(self, "a temperature in kelvin, or an emission, that is not negative expected", key);
    const bool others = strcmp(key, "*") == 0;
    size_t count = 0;
    for (size_t i = 0; i < aur_facets_rows(facets); ++i) {
        if (!is_of_row(self, facets, key, i))
            continue;
        ++count;
        if (self->named[i] && others)
            continue;
        if (self->named[i])
            return fail(self, "a second line of this name", key);
        self->named[i] = !others;
        properties->emittances[i] = emittance;
        properties->reflectances[i] = 1.0 - emittance;
        properties->emissions[i] = self->has[TEMPERATURE]
                                       ? emittance * STEFAN_BOLTZMANN * kelvin * kelvin * kelvin * kelvin
                                       : values[EMISSION];
    }
    if (count > 0)
        return CLI_SUCCESS;
    const bool nameless = self->has[NAME] && aur_facets_name(facets, 0) == NULL;
    return fail(self,
                nameless ? "the rows of a mesh have names with --group only"
                         : "the mesh has no row of this name",
                key);
}

static int read_line(table_reading *self, const aur_facets *facets, char *text, cli_surfaces *properties) {
    double values[COLUMNS] = {0.0};
    const char *key = "";
    for (size_t i = 0; i < self->columns; ++i) {
        const char *const field = next_field(&text);
        if (field == NULL)
            return fail(self, "fewer fields than the header has", key);
        if (self->order[i] == NAME || self->order[i] == ROW)
            key = field;
        else if (!aur_parse_double(field, &values[self->order[i]]) || !isfinite(values[self->order[i]]))
            return fail(self, "a number expected", field);
    }
    return use_line(self, facets, key, values, properties);
}

static int check_rows(const table_reading *self, const aur_facets *facets, const cli_surfaces *properties) {
    for (size_t i = 0; i < aur_facets_rows(facets); ++i)
        if (isnan(properties->emittances[i])) {
            const char *const name = aur_facets_name(facets, i);
            return cli_bad_usage("%s: row %zu%s%s has no line: name it, or '*' for all others", self->path, i,
                                 name != NULL ? ", " : "", name != NULL ? name : "");
        }
    return CLI_SUCCESS;
}

/* --- uDALES: facets.inp.NNN has the type of each facet; factypes.inp.NNN in the same folder has the albedos
 */

enum { MOST_TYPES = 256, ALBEDO = 4 };

typedef struct facet_types {
    size_t count;
    double types[MOST_TYPES], albedos[MOST_TYPES];
} facet_types;

/* Reads the first `count` numbers of a line; false if there are fewer. */
static bool read_blanks(char *line, size_t count, double *numbers) {
    size_t found = 0;
    for (char *rest = line, *word; found < count && (word = strtok_r(rest, " \t\r\n", &rest)) != NULL;
         ++found)
        if (!aur_parse_double(word, &numbers[found]))
            return false;
    return found == count;
}

/* Passes the numbers of each non-comment line to `use`. */
static int read_lines(const char *path, size_t count, int (*use)(table_reading *, const double *, void *),
                      void *context) {
    table_reading self = {.path = path};
    aur_error error;
    FILE *const file = cli_open_input(path, &error);
    if (file == NULL)
        return cli_fail(&error);
    char *line = NULL;
    size_t capacity = 0;
    int status = CLI_SUCCESS;
    while (status == CLI_SUCCESS && getline(&line, &capacity, file) >= 0) {
        double numbers[ALBEDO + 1];
        ++self.line;
        if (line[strspn(line, " \t\r\n")] == '\0' || line[strspn(line, " \t")] == '#')
            continue;
        status = read_blanks(line, count, numbers) ? use(&self, numbers, context)
                                                   : fail(&self, "numbers expected", line);
    }
    free(line);
    fclose(file);
    return status;
}

static int use_type(table_reading *self, const double *numbers, void *context) {
    facet_types *const types = context;
    if (types->count == MOST_TYPES || !(numbers[ALBEDO] >= 0.0 && numbers[ALBEDO] <= 1.0))
        return fail(self, "at most 256 types with albedos from 0 to 1 expected", "al");
    types->types[types->count] = numbers[0];
    types->albedos[types->count++] = numbers[ALBEDO];
    return CLI_SUCCESS;
}

typedef struct facet_rows {
    const facet_types *types;
    size_t row, count;
    cli_surfaces *properties;
} facet_rows;

static int use_facet(table_reading *self, const double *numbers, void *context) {
    facet_rows *const rows = context;
    const facet_types *const types = rows->types;
    size_t i = 0;
    while (i < types->count && types->types[i] != numbers[0])
        ++i;
    if (rows->row == rows->count || i == types->count)
        return fail(self, "a line for each facet, of a type of factypes.inp, expected",
                    rows->row == rows->count ? "too many lines" : "unknown type");
    rows->properties->reflectances[rows->row] = types->albedos[i];
    rows->properties->emittances[rows->row] = 1.0 - types->albedos[i];
    rows->properties->emissions[rows->row++] = 0.0;
    return CLI_SUCCESS;
}

static const char UDALES[] = "facets.inp";

/* Whether the path names a facets.inp.NNN of uDALES; *name is the start of the file name. */
static bool is_udales(const char *path, size_t *name) {
    const char *const slash = strrchr(path, '/');
    *name = slash != NULL ? (size_t)(slash - path) + 1 : 0;
    return strncmp(path + *name, UDALES, sizeof UDALES - 1) == 0;
}

static int read_udales(const char *path, size_t name, const aur_facets *facets, cli_surfaces *properties) {
    facet_types types = {.count = 0};
    facet_rows rows = {.types = &types, .count = aur_facets_rows(facets), .properties = properties};
    char types_path[1024];
    const int length = snprintf(types_path, sizeof types_path, "%.*sfactypes.inp%s", (int)name, path,
                                path + name + sizeof UDALES - 1);
    if (length >= (int)sizeof types_path)
        return cli_bad_usage("%s: the path is too long", path);
    int status = read_lines(types_path, ALBEDO + 1, use_type, &types);
    if (status == CLI_SUCCESS)
        status = read_lines(path, 1, use_facet, &rows);
    if (status == CLI_SUCCESS && rows.row != rows.count)
        status = cli_bad_usage("%s: %zu facets, and the mesh has %zu rows", path, rows.row, rows.count);
    return status;
}

int cli_surfaces_read(const char *path, const aur_facets *facets, cli_surfaces *properties) {
    const size_t rows = aur_facets_rows(facets);
    table_reading self = {.path = path};
    properties->emittances = malloc((3 * rows + 1) * sizeof *properties->emittances);
    int status = properties->emittances != NULL ? CLI_SUCCESS : cli_bad_usage("out of memory");
    for (size_t i = 0; i < rows && status == CLI_SUCCESS; ++i)
        properties->emittances[i] = NAN;
    properties->reflectances = properties->emittances + rows;
    properties->emissions = properties->reflectances + rows;
    size_t name;
    if (status != CLI_SUCCESS || is_udales(path, &name))
        return status != CLI_SUCCESS ? status : read_udales(path, name, facets, properties);
    aur_error error;
    FILE *const file = cli_open_input(path, &error);
    if (file == NULL)
        return cli_fail(&error);
    self.named = calloc(rows + 1, sizeof *self.named);
    if (self.named == NULL)
        status = cli_bad_usage("out of memory");
    char *line = NULL;
    size_t capacity = 0;
    while (status == CLI_SUCCESS && getline(&line, &capacity, file) >= 0) {
        ++self.line;
        if (line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#')
            continue;
        status = self.columns == 0 ? read_header(&self, line) : read_line(&self, facets, line, properties);
    }
    free(self.named);
    free(line);
    fclose(file);
    return status == CLI_SUCCESS ? check_rows(&self, facets, properties) : status;
}
