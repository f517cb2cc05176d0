/* Tables of weights as files: a text header, then the numbers as little-endian floats, then a checksum of all
 * bytes before it. */
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/file.h"
#include "points/base/random.h"
#include "points/base/text.h"
#include "points/quadrature/tables/weight_table.h"

enum { VERSION = 3, HEADER_CAPACITY = AUR_WEIGHT_TABLE_KEY_CAPACITY, VALUE_CAPACITY = 64, HASH_BYTES = 8 };

static const char magic[] = "aureole weight table\n", header_end[] = "end\n";
static const size_t file_limit = (size_t)1 << 34;

static unsigned char *put(uint64_t word, size_t bytes, unsigned char *target) {
    for (size_t i = 0; i < bytes; ++i)
        target[i] = (unsigned char)(word >> 8 * i);
    return target + bytes;
}

static uint64_t get(const char *source, size_t bytes) {
    uint64_t word = 0;
    for (size_t i = 0; i < bytes; ++i)
        word |= (uint64_t)(unsigned char)source[i] << 8 * i;
    return word;
}

static unsigned char *put_floats(const float *values, size_t count, unsigned char *target) {
    uint32_t bits;
    for (size_t i = 0; i < count; ++i, target = put(bits, 4, target))
        memcpy(&bits, &values[i], sizeof bits);
    return target;
}

static const char *get_floats(const char *source, size_t count, float *values) {
    for (size_t i = 0; i < count; ++i, source += 4)
        memcpy(&values[i], &(uint32_t){(uint32_t)get(source, 4)}, 4);
    return source;
}

uint64_t aur_weight_table_check_sum(const char *data, size_t size) {
    uint64_t hash = size;
    for (; size >= 8; data += 8, size -= 8)
        hash = aur_mix64(hash ^ get(data, 8)) + UINT64_C(0x9e3779b97f4a7c15);
    for (; size > 0; ++data, --size)
        hash = aur_mix64(hash ^ (unsigned char)*data) + UINT64_C(0x9e3779b97f4a7c15);
    return hash;
}

/* --- the header */

typedef struct header {
    uint64_t version, angles, roughnesses, rotations, pieces;
    aur_oswa_options options;
    aur_weights_options weights;
    const char *patterns; /* a hash of the directions, in hexadecimal digits */
} header;

/* A line `key value` of the header. */
typedef struct header_line {
    const char *key;
    /* The name in messages, for options that a reader may expect; NULL for values that are not compared. */
    const char *what;
    enum { TEXT, REAL, INTEGER } type;
    size_t offset, size; /* of the member */
    uint64_t most;       /* of an integer */
} header_line;

static const header_line lines[] = {
    {"version", NULL, INTEGER, offsetof(header, version), 8, INT_MAX},
    {"set", "set", TEXT, offsetof(header, options.set), 0, 0},
    {"count", "samples of the first lobe", INTEGER, offsetof(header, options.count), sizeof(size_t), INT_MAX},
    {"mirror_count", "samples of the mirror lobe", INTEGER, offsetof(header, options.mirror_count),
     sizeof(size_t), INT_MAX},
    {"lobe", "exponent of the first lobe", REAL, offsetof(header, options.lobe.exponent), 8, 0},
    {"mirror_kind", "kind of the mirror lobe", INTEGER, offsetof(header, options.mirror_lobe.kind), 4,
     AUR_LOBE_GGX},
    {"mirror_exponent", "exponent of the mirror lobe", REAL, offsetof(header, options.mirror_lobe.exponent),
     8, 0},
    {"mirror_alpha", "roughness of the mirror lobe", REAL, offsetof(header, options.mirror_lobe.alpha), 8, 0},
    {"optimal_density", "optimal density", INTEGER, offsetof(header, options.optimal_density), 1, 1},
    {"clipped", "clipping", INTEGER, offsetof(header, options.clipped), 1, 1},
    {"map", "map", INTEGER, offsetof(header, options.map), 4, AUR_MAP_POLAR},
    {"scramble", "scrambling", INTEGER, offsetof(header, options.scramble), 4, AUR_SCRAMBLE_ROTATE3D},
    {"seed", "seed", INTEGER, offsetof(header, options.seed), 8, UINT64_MAX},
    {"smoothness", "smoothness", REAL, offsetof(header, options.smoothness), 8, 0},
    {"regularization", "regularisation", REAL, offsetof(header, weights.regularization), 8, 0},
    {"sum_constraint", "sum constraint", INTEGER, offsetof(header, weights.sum_constraint), 1, 1},
    {"angles", NULL, INTEGER, offsetof(header, angles), 8, 1 << 16},
    {"roughnesses", NULL, INTEGER, offsetof(header, roughnesses), 8, 1 << 8},
    {"rotations", NULL, INTEGER, offsetof(header, rotations), 8, 1 << 16},
    {"pieces", NULL, INTEGER, offsetof(header, pieces), 8, UINT32_MAX},
    {"patterns", NULL, TEXT, offsetof(header, patterns), 0, 0},
};

enum { LINE_COUNT = sizeof lines / sizeof lines[0] };

_Static_assert(sizeof(bool) == 1 && sizeof(aur_map) == 4, "members of the header have other sizes");

/* A line's value, in `buffer` or where the header has it; 17 digits distinguish any two numbers. */
static const char *value_text(const header_line *line, const header *h, int digits, char *buffer) {
    const void *const at = (const char *)h + line->offset;
    if (line->type == TEXT)
        return *(const char *const *)at;
    if (line->type == REAL)
        aur_format(buffer, VALUE_CAPACITY, "%.*g", digits, *(const double *)at);
    else
        aur_format(buffer, VALUE_CAPACITY, "%" PRIu64,
                   line->size == 1   ? *(const bool *)at
                   : line->size == 4 ? *(const uint32_t *)at
                                     : *(const uint64_t *)at);
    return buffer;
}

/* False if the text is not a value of that line. */
static bool parse_value(const header_line *line, const char *text, header *h) {
    void *const at = (char *)h + line->offset;
    uint64_t number = 0;
    const char *end = "";
    if (line->type == TEXT)
        *(const char **)at = text;
    else if (line->type == REAL)
        end = aur_read_double(text, AUR_NUMBER_ANY, at);
    else
        end = aur_read_integer(text, line->most, &number);
    if (end == NULL || *end != '\0')
        return false;
    if (line->type == INTEGER && line->size == 1)
        *(bool *)at = number != 0;
    else if (line->type == INTEGER && line->size == 4)
        *(uint32_t *)at = (uint32_t)number;
    else if (line->type == INTEGER)
        *(uint64_t *)at = number;
    return true;
}

/* The length of the header, or more than HEADER_CAPACITY for one that does not fit. */
static size_t print_header(const header *h, char text[HEADER_CAPACITY]) {
    char buffer[VALUE_CAPACITY];
    size_t length = (size_t)aur_format(text, HEADER_CAPACITY, "%s", magic);
    for (size_t i = 0; i < LINE_COUNT && length < HEADER_CAPACITY; ++i)
        length +=
            (size_t)aur_format(text + length, HEADER_CAPACITY - length, "%s %s\n%s", lines[i].key,
                               value_text(&lines[i], h, 17, buffer), i + 1 < LINE_COUNT ? "" : header_end);
    return length;
}

/* The number of words of four bytes after a header; exact below 2^53. */
static double word_count(const header *h) {
    const bool apart = h->options.clipped || h->options.mirror_lobe.kind == AUR_LOBE_GGX;
    const double angles = (double)h->angles, pieces = (double)h->pieces;
    const double slots = (double)h->roughnesses * (double)h->rotations;
    const double rows = apart ? 2.0 * pieces : slots * angles;
    const double masses = (double)h->roughnesses * ((angles - 1.0) * AUR_WEIGHT_TABLE_MASS_STEPS + 1.0);
    const double lobes = h->options.count > 0 ? 2.0 : 1.0;
    return masses + (apart ? slots * (angles - 1.0) + pieces : 0.0) +
           lobes * rows * (double)(h->options.count + h->options.mirror_count);
}

static size_t mass_count(const aur_weight_table *table) {
    return table->roughness_count * aur_weight_table_mass_count(table);
}

static size_t weight_count(const aur_weight_table *table) {
    return aur_weight_table_width(table) * aur_weight_table_rows(table);
}

/* --- writing */

aur_result aur_weight_table_key(const aur_oswa_options *options, const aur_weight_table_grid *grid,
                                uint64_t build, char key[AUR_WEIGHT_TABLE_KEY_CAPACITY]) {
    char text[VALUE_CAPACITY];
    aur_format(text, sizeof text, "of build %016" PRIx64, build);
    header h = {.version = VERSION,
                .angles = grid->angle_count,
                .roughnesses = grid->roughness_count,
                .rotations = grid->rotation_count,
                .patterns = text};
    const aur_result result = aur_oswa_options_read(options, &h.options, &h.weights, NULL);
    if (result != AUR_OK)
        return result;
    return print_header(&h, key) < HEADER_CAPACITY ? AUR_OK : AUR_ERROR_ARGUMENT;
}

aur_result aur_weight_table_print(const aur_weight_table *table, size_t *bytes, void **printed,
                                  aur_error *error) {
    *printed = NULL;
    if (table->oswa->options.published_z.angle_count > 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a table made with the published z is not for keeping");
    char text[HEADER_CAPACITY], patterns[VALUE_CAPACITY];
    aur_format(patterns, sizeof patterns, "%016" PRIx64, aur_oswa_hash(table->oswa));
    const header h = {VERSION,
                      table->angle_count,
                      table->roughness_count,
                      table->rotation_count,
                      table->piece_count,
                      table->oswa->options,
                      table->oswa->weights,
                      patterns};
    const size_t length = print_header(&h, text);
    if (length >= sizeof text)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the name of the set is too long for a table");
    const size_t size = length + 4 * (size_t)word_count(&h);
    unsigned char *const data = malloc(size + HASH_BYTES);
    if (data == NULL)
        return aur_fail_memory(error);
    memcpy(data, text, length);
    unsigned char *target = put_floats(table->masses, mass_count(table), data + length);
    for (size_t i = 0; table->apart && i < aur_weight_table_intervals(table); ++i)
        target = put(table->first[i + 1] - table->first[i], 4, target);
    target = put_floats(table->start, table->piece_count, target);
    target = put_floats(table->weights, weight_count(table), target);
    put(aur_weight_table_check_sum((const char *)data, size), HASH_BYTES, target);
    *printed = data;
    *bytes = size + HASH_BYTES;
    return AUR_OK;
}

aur_result aur_weight_table_save(const aur_weight_table *table, const char *path, aur_error *error) {
    size_t size;
    void *data;
    aur_result result = aur_weight_table_print(table, &size, &data, error);
    if (result == AUR_OK)
        result = aur_file_write(path, size, data, error);
    free(data);
    return result;
}

/* --- reading */

typedef struct reader {
    aur_location where; /* line: of the header */
    char *rest;
    aur_error *error;
} reader;

/* Reads the next line of the header, which must be this one. */
static aur_result read_line(reader *in, const header_line *line, header *h) {
    ++in->where.line;
    char *const text = in->rest;
    char *const end = strchr(text, '\n');
    const size_t length = strlen(line->key);
    if (end == NULL || strncmp(text, line->key, length) != 0 || text[length] != ' ')
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "expected '%s VALUE' in a weight table's header", line->key);
    *end = '\0';
    in->rest = end + 1;
    return parse_value(line, text + length + 1, h)
               ? AUR_OK
               : aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "'%s' is not a valid %s",
                             text + length + 1, line->key);
}

/* An error without a line of the header. */
static aur_result refuse(reader *in, const char *message) {
    in->where.line = 0;
    return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "%s", message);
}

/* `data` ends with a zero byte; `size` counts neither it nor the checksum. */
static aur_result read_header(reader *in, size_t size, header *h) {
    const char *const data = in->rest;
    /* The checksum is computed first, since reading terminates the lines in place. */
    const bool whole = aur_weight_table_check_sum(data, size) == get(data + size, HASH_BYTES);
    in->rest += sizeof magic - 1;
    in->where.line = 1;
    aur_result result = read_line(in, &lines[0], h);
    if (result != AUR_OK)
        return result;
    if (h->version != VERSION)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table has version %" PRIu64 "; this program reads version %d", h->version,
                           VERSION);
    if (!whole)
        return refuse(in, "the table is damaged: its check sum does not match");
    for (size_t i = 1; i < LINE_COUNT && result == AUR_OK; ++i)
        result = read_line(in, &lines[i], h);
    if (result != AUR_OK)
        return result;
    ++in->where.line;
    if (strncmp(in->rest, header_end, sizeof header_end - 1) != 0)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "expected 'end' after a weight table's header");
    in->rest += sizeof header_end - 1;
    in->where.line = 0;
    h->options.weights = &h->weights;
    return AUR_OK;
}

/* Fails with the first option that differs from the expected one. */
static aur_result compare(reader *in, const header *has, const aur_oswa_options *expected) {
    header required = {.version = VERSION};
    const aur_result result =
        aur_oswa_options_read(expected, &required.options, &required.weights, in->error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < LINE_COUNT; ++i) {
        char a[VALUE_CAPACITY], b[VALUE_CAPACITY];
        const char *const quote = lines[i].type == TEXT ? "'" : "";
        if (lines[i].what != NULL &&
            strcmp(value_text(&lines[i], has, 17, a), value_text(&lines[i], &required, 17, b)) != 0)
            return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                               "the table was built with another %s: %s%s%s, not %s%s%s", lines[i].what,
                               quote, value_text(&lines[i], has, 6, a), quote, quote,
                               value_text(&lines[i], &required, 6, b), quote);
    }
    return AUR_OK;
}

/* Reads the pieces of each interval, which must be ascending and begin in it. */
static const char *read_pieces(const char *source, aur_weight_table *table) {
    const size_t intervals = aur_weight_table_intervals(table);
    uint64_t total = 0;
    for (size_t i = 0; i < intervals; ++i, source += 4) {
        const uint32_t count = (uint32_t)get(source, 4);
        table->first[i] = (uint32_t)total;
        total += count;
        if (count == 0 || total > table->piece_count)
            return NULL;
    }
    table->first[intervals] = (uint32_t)total;
    if (total != table->piece_count)
        return NULL;
    source = get_floats(source, table->piece_count, table->start);
    for (size_t i = 0; i < intervals; ++i) {
        const size_t index = i % (table->angle_count - 1);
        float last = (float)aur_weight_table_angle(table, index);
        for (size_t piece = table->first[i]; piece < table->first[i + 1]; ++piece) {
            if (!(table->start[piece] >= last))
                return NULL;
            last = table->start[piece];
        }
        if (!(last <= (float)aur_weight_table_angle(table, index + 1)))
            return NULL;
    }
    return source;
}

/* Reads all numbers after the header; their size has been checked. */
static aur_result read_words(reader *in, size_t pieces, aur_weight_table *table) {
    if (table->apart) {
        table->piece_count = pieces;
        table->first = malloc((aur_weight_table_intervals(table) + 1) * sizeof *table->first);
        table->start = malloc(pieces * sizeof *table->start);
        if (table->first == NULL || table->start == NULL)
            return aur_fail_memory(in->error);
    }
    const aur_result result = aur_weight_table_allocate(table, in->error);
    if (result != AUR_OK)
        return result;
    const char *source = get_floats(in->rest, mass_count(table), table->masses);
    if (table->apart)
        source = read_pieces(source, table);
    if (source == NULL)
        return refuse(in, "the pieces of the table's intervals are out of order");
    get_floats(source, weight_count(table), table->weights);
    return AUR_OK;
}

static aur_result parse(reader *in, size_t size, const aur_oswa_options *expected, aur_weight_table **table) {
    const char *const data = in->rest;
    if (size < sizeof magic - 1 + HASH_BYTES || memcmp(data, magic, sizeof magic - 1) != 0)
        return refuse(in, "this is not a weight table");
    size -= HASH_BYTES;
    header h = {.options = {.size = sizeof h.options}, .weights = {.size = sizeof h.weights}};
    aur_weights_options_init(&h.weights, NULL);
    aur_result result = read_header(in, size, &h);
    if (result == AUR_OK && expected != NULL)
        result = compare(in, &h, expected);
    if (result != AUR_OK)
        return result;
    /* The size must fit before anything of that size is allocated. */
    if ((double)(size - (size_t)(in->rest - data)) != 4.0 * word_count(&h))
        return refuse(in, "the table is not of the size that it says");
    const aur_weight_table_grid grid = {.size = sizeof grid,
                                        .angle_count = (size_t)h.angles,
                                        .roughness_count = (size_t)h.roughnesses,
                                        .rotation_count = (size_t)h.rotations};
    result = aur_weight_table_create(&h.options, &grid, false, table, in->error);
    if (result != AUR_OK)
        return result;
    char patterns[VALUE_CAPACITY];
    aur_format(patterns, sizeof patterns, "%016" PRIx64, aur_oswa_hash((*table)->oswa));
    if (strcmp(h.patterns, patterns) != 0)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table's set '%s' has other points than this program makes: build it again",
                           h.options.set);
    return read_words(in, (size_t)h.pieces, *table);
}

aur_result aur_weight_table_parse(const char *name, size_t size, char *data, const aur_oswa_options *expected,
                                  aur_weight_table **table, aur_error *error) {
    *table = NULL;
    reader in = {{.file = name}, data, error};
    const aur_result result = parse(&in, size, expected, table);
    if (result != AUR_OK) {
        aur_weight_table_destroy(*table);
        *table = NULL;
    }
    return result;
}

aur_result aur_weight_table_load(const char *path, const aur_oswa_options *expected, aur_weight_table **table,
                                 aur_error *error) {
    *table = NULL;
    char *data;
    size_t size;
    aur_result result = aur_file_read(path, file_limit, &data, &size, error);
    if (result != AUR_OK)
        return result;
    result = aur_weight_table_parse(path, size, data, expected, table, error);
    free(data);
    return result;
}
