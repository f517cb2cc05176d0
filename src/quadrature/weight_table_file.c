/* Tables of weights as files: lines of text that say what they are, then the numbers as little-endian floats,
 * then a check sum of all that stands before it. */
#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "core/random.h"
#include "core/text.h"
#include "quadrature/weight_table.h"

enum { VERSION = 2, HEADER_CAPACITY = 4096 };

static const char magic[] = "aureole weight table\n";
static const size_t file_limit = (size_t)1 << 34;

uint64_t aur_weight_table_check_sum(const char *data, size_t size) {
    uint64_t hash = size;
    for (; size >= 8; data += 8, size -= 8) {
        uint64_t word = 0;
        for (unsigned i = 0; i < 8; ++i)
            word |= (uint64_t)(unsigned char)data[i] << 8 * i;
        hash = aur_mix64(hash ^ word) + UINT64_C(0x9e3779b97f4a7c15);
    }
    for (; size > 0; ++data, --size)
        hash = aur_mix64(hash ^ (unsigned char)*data) + UINT64_C(0x9e3779b97f4a7c15);
    return hash;
}

/* All options in a fixed form: tables are of one kind when these texts are equal. Lines are `key value`. */
static int print_header(const aur_weight_table *table, char *text, size_t capacity) {
    const aur_oswa_options *const o = &table->oswa->options;
    return aur_format(
        text, capacity,
        "%sversion %d\nset %s\ncount %zu\nmirror_count %zu\nlobe %.17g\nmirror_kind %d\n"
        "mirror_exponent %.17g\nmirror_alpha %.17g\noptimal_density %d\nclipped %d\nmap %d\nscramble %d\n"
        "seed %" PRIu64 "\nsmoothness %.17g\nregularization %.17g\nsum_constraint %d\nangles %zu\n"
        "rotations %zu\npieces %zu\npatterns %016" PRIx64 "\nend\n",
        magic, VERSION, o->set, o->count, o->mirror_count, o->lobe.exponent, (int)o->mirror_lobe.kind,
        o->mirror_lobe.exponent, o->mirror_lobe.alpha, o->optimal_density, o->clipped, (int)o->map,
        (int)o->scramble, o->seed, o->smoothness, o->weights.regularization, o->weights.sum_constraint,
        table->angle_count, table->rotation_count, table->piece_count, aur_oswa_hash(table->oswa));
}

static unsigned char *put_word(uint32_t word, unsigned char *target) {
    for (unsigned k = 0; k < 4; ++k)
        target[k] = (unsigned char)(word >> 8 * k);
    return target + 4;
}

static unsigned char *put_floats(const float *values, size_t count, unsigned char *target) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        target = put_word(bits, target);
    }
    return target;
}

static uint32_t get_word(const char *source) {
    uint32_t word = 0;
    for (unsigned k = 0; k < 4; ++k)
        word |= (uint32_t)(unsigned char)source[k] << 8 * k;
    return word;
}

static const char *get_floats(const char *source, size_t count, float *values) {
    for (size_t i = 0; i < count; ++i, source += 4) {
        const uint32_t bits = get_word(source);
        memcpy(&values[i], &bits, sizeof bits);
    }
    return source;
}

static size_t weight_count(const aur_weight_table *table) {
    return 2 * table->size * aur_weight_table_rows(table);
}

aur_result aur_weight_table_save(const aur_weight_table *table, const char *path, aur_error *error) {
    if (table->oswa->options.published_z.angle_count > 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "a table made with the published z is not for keeping");
    const size_t intervals = table->apart ? aur_weight_table_intervals(table) : 0;
    const size_t words =
        weight_count(table) + aur_weight_table_mass_count(table) + intervals + table->piece_count;
    char header[HEADER_CAPACITY];
    const int length = print_header(table, header, sizeof header);
    if (length < 0 || (size_t)length >= sizeof header)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the name of the set is too long for a table");
    const size_t size = (size_t)length + 4 * words + 8;
    unsigned char *const data = malloc(size);
    if (data == NULL)
        return aur_fail_memory(error);
    memcpy(data, header, (size_t)length);
    unsigned char *target = put_floats(table->masses, aur_weight_table_mass_count(table), data + length);
    for (size_t i = 0; i < intervals; ++i)
        target = put_word(table->first[i + 1] - table->first[i], target);
    target = put_floats(table->start, table->piece_count, target);
    put_floats(table->weights, weight_count(table), target);
    const uint64_t sum = aur_weight_table_check_sum((const char *)data, size - 8);
    for (unsigned k = 0; k < 8; ++k)
        data[size - 8 + k] = (unsigned char)(sum >> 8 * k);
    aur_file_writer writer;
    aur_result result = aur_file_open(path, &writer, error);
    if (result == AUR_OK) {
        fwrite(data, 1, size, writer.stream);
        result = aur_file_commit(&writer, error);
    }
    free(data);
    return result;
}

typedef struct reader {
    aur_location where; /* line: of the header */
    char *rest;
    aur_error *error;
} reader;

/* The value of the next header line, which must have that key; NULL after an error. */
static char *next_value(reader *in, const char *key) {
    ++in->where.line;
    char *const line = in->rest;
    char *const end = strchr(line, '\n');
    const size_t length = strlen(key);
    if (end == NULL || strncmp(line, key, length) != 0 || line[length] != ' ') {
        aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "expected '%s VALUE' in a weight table's header",
                    key);
        return NULL;
    }
    *end = '\0';
    in->rest = end + 1;
    return line + length + 1;
}

static bool next_double(reader *in, const char *key, double *value) {
    const char *const text = next_value(in, key);
    if (text == NULL)
        return false;
    const char *const end = aur_read_double(text, AUR_NUMBER_ANY, value);
    if (end != NULL && *end == '\0')
        return true;
    aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "'%s' is not a number", text);
    return false;
}

static bool next_integer(reader *in, const char *key, int base, uint64_t limit, uint64_t *value) {
    const char *const text = next_value(in, key);
    if (text == NULL)
        return false;
    char *end;
    errno = 0;
    *value = strtoull(text, &end, base);
    if (end != text && *end == '\0' && errno == 0 && text[0] != '-' && *value <= limit)
        return true;
    aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "'%s' is not a valid %s", text, key);
    return false;
}

typedef struct header {
    aur_oswa_options options;
    uint64_t angles, rotations, pieces, patterns;
} header;

/* Reads the lines after the version; they stand in the order that print_header gives them. */
static bool read_header(reader *in, header *h) {
    aur_oswa_options *const o = &h->options;
    uint64_t count, mirror_count, kind, optimal, clipped, map, scramble, constraint;
    const bool good =
        (o->set = next_value(in, "set")) != NULL && next_integer(in, "count", 10, INT_MAX, &count) &&
        next_integer(in, "mirror_count", 10, INT_MAX, &mirror_count) &&
        next_double(in, "lobe", &o->lobe.exponent) &&
        next_integer(in, "mirror_kind", 10, AUR_LOBE_GGX, &kind) &&
        next_double(in, "mirror_exponent", &o->mirror_lobe.exponent) &&
        next_double(in, "mirror_alpha", &o->mirror_lobe.alpha) &&
        next_integer(in, "optimal_density", 10, 1, &optimal) &&
        next_integer(in, "clipped", 10, 1, &clipped) && next_integer(in, "map", 10, AUR_MAP_POLAR, &map) &&
        next_integer(in, "scramble", 10, AUR_SCRAMBLE_ROTATE3D, &scramble) &&
        next_integer(in, "seed", 10, UINT64_MAX, &o->seed) && next_double(in, "smoothness", &o->smoothness) &&
        next_double(in, "regularization", &o->weights.regularization) &&
        next_integer(in, "sum_constraint", 10, 1, &constraint) &&
        next_integer(in, "angles", 10, 1 << 16, &h->angles) &&
        next_integer(in, "rotations", 10, 1 << 16, &h->rotations) &&
        next_integer(in, "pieces", 10, UINT32_MAX, &h->pieces) &&
        next_integer(in, "patterns", 16, UINT64_MAX, &h->patterns);
    if (!good)
        return false;
    ++in->where.line;
    if (strncmp(in->rest, "end\n", 4) != 0) {
        aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "expected 'end' after a weight table's header");
        return false;
    }
    in->rest += 4;
    o->count = (size_t)count;
    o->mirror_count = (size_t)mirror_count;
    o->mirror_lobe.kind = (aur_lobe_kind)kind;
    o->optimal_density = (int)optimal;
    o->clipped = (int)clipped;
    o->map = (aur_map)map;
    o->scramble = (aur_scramble)scramble;
    o->weights.sum_constraint = (int)constraint;
    return true;
}

/* The first option in which a file differs from what is wanted. */
static aur_result compare(reader *in, const aur_oswa_options *has, const aur_oswa_options *wanted) {
    in->where.line = 0;
    const char *const set = wanted->set != NULL ? wanted->set : "spherical-fibonacci";
    const double smoothness = wanted->smoothness == 0.0 ? 1.5 : wanted->smoothness;
    if (strcmp(has->set, set) != 0)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "the table is for the set '%s', not '%s'",
                           has->set, set);
    const struct {
        const char *name;
        double has, wanted;
    } numbers[] = {
        {"samples of the first lobe", (double)has->count, (double)wanted->count},
        {"samples of the mirror lobe", (double)has->mirror_count, (double)wanted->mirror_count},
        {"exponent of the first lobe", has->lobe.exponent, wanted->lobe.exponent},
        {"kind of the mirror lobe", has->mirror_lobe.kind, wanted->mirror_lobe.kind},
        {"exponent of the mirror lobe", has->mirror_lobe.exponent, wanted->mirror_lobe.exponent},
        {"roughness of the mirror lobe", has->mirror_lobe.alpha, wanted->mirror_lobe.alpha},
        {"optimal density", has->optimal_density, wanted->optimal_density != 0},
        {"clipping", has->clipped, wanted->clipped != 0},
        {"map", has->map, wanted->map},
        {"scrambling", has->scramble, wanted->scramble},
        {"smoothness", has->smoothness, smoothness},
        {"regularisation", has->weights.regularization, wanted->weights.regularization},
        {"sum constraint", has->weights.sum_constraint, wanted->weights.sum_constraint != 0},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
        if (numbers[i].has != numbers[i].wanted)
            return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                               "the table was built with another %s: %g, not %g", numbers[i].name,
                               numbers[i].has, numbers[i].wanted);
    if (has->seed != wanted->seed)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table was built with another seed: %" PRIu64 ", not %" PRIu64, has->seed,
                           wanted->seed);
    return AUR_OK;
}

/* The pieces of each interval, which must begin in it one after another. */
static const char *read_pieces(const char *source, aur_weight_table *table) {
    const size_t intervals = aur_weight_table_intervals(table);
    uint64_t total = 0;
    for (size_t i = 0; i < intervals; ++i, source += 4) {
        const uint32_t count = get_word(source);
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

/* All numbers after the header, whose size has been found to fit. */
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
    const char *source = get_floats(in->rest, aur_weight_table_mass_count(table), table->masses);
    if (table->apart)
        source = read_pieces(source, table);
    if (source == NULL)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the pieces of the table's intervals are out of order");
    get_floats(source, weight_count(table), table->weights);
    return AUR_OK;
}

/* `data` ends with a zero byte that `size` does not count. */
static aur_result parse(reader *in, size_t size, const aur_oswa_options *expected, aur_weight_table **table) {
    char *const data = in->rest;
    const size_t magic_length = sizeof magic - 1;
    if (size < magic_length + 8 || memcmp(data, magic, magic_length) != 0)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT, "this is not a weight table");
    const uint64_t sum = aur_weight_table_check_sum(data, size - 8);
    uint64_t stored = 0;
    for (unsigned k = 0; k < 8; ++k)
        stored |= (uint64_t)(unsigned char)data[size - 8 + k] << 8 * k;
    in->rest += magic_length;
    in->where.line = 1;
    uint64_t version;
    if (!next_integer(in, "version", 10, INT_MAX, &version))
        return AUR_ERROR_FORMAT;
    if (version != VERSION)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table has version %" PRIu64 "; this program reads version %d", version,
                           VERSION);
    in->where.line = 0;
    if (sum != stored)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table is damaged: its check sum does not match");
    in->where.line = 2;
    header h = {0};
    if (!read_header(in, &h))
        return AUR_ERROR_FORMAT;
    aur_result result = expected != NULL ? compare(in, &h.options, expected) : AUR_OK;
    if (result != AUR_OK)
        return result;
    /* The size must fit before anything of that size is allocated. */
    const bool apart = h.options.clipped || h.options.mirror_lobe.kind == AUR_LOBE_GGX;
    const double angles = (double)h.angles, rotations = (double)h.rotations, pieces = (double)h.pieces;
    const double rows = apart ? 2.0 * pieces : rotations * angles;
    const double masses = (angles - 1.0) * AUR_WEIGHT_TABLE_MASS_STEPS + 1.0;
    const double words = masses + (apart ? rotations * (angles - 1.0) + pieces : 0.0) +
                         2.0 * rows * (double)(h.options.count + h.options.mirror_count);
    if ((double)(size - 8 - (size_t)(in->rest - data)) != 4.0 * words)
        return aur_fail_at(in->error, in->where, AUR_ERROR_FORMAT,
                           "the table is not of the size that it says");
    result =
        aur_weight_table_create(&h.options, (size_t)h.angles, (size_t)h.rotations, false, table, in->error);
    if (result != AUR_OK)
        return result;
    if (aur_oswa_hash((*table)->oswa) != h.patterns)
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
