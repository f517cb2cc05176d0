/* Runs a harness on its seeds and on mutations of them: run R of seed S always has the same input if the
 * seeds and the dictionary are the same.
 *
 *     fuzz_NAME [--runs N] [--seed S] [--only R] [--dictionary WORDS] [--fresh 1] [FILE...]
 *
 * FILEs are additional seeds; --runs 0 only runs them unchanged. WORDS has a quoted word per line, in the
 * format of libFuzzer's -dict (keys.dict). A failing run prints its number; `--only R` repeats only that run
 * and writes its input to fuzz-input. `--fresh 1` prints each FILE that reaches parser code which no FILE
 * before it has reached, if that code was compiled with coverage (scripts/coverage.sh). */
#include <aureole/core.h>
#include <signal.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "points/base/random.h"

enum { SEED_CAPACITY = 16384, WORD_CAPACITY = 4096, INPUT_CAPACITY = 1 << 16, SECONDS_A_RUN = 60, EDITS = 6 };

/* Makes sanitizers raise SIGABRT, so that the handler below can print the run's number. Allocations beyond 4
 * GiB fail instead of ending the program. */
AUR_API const char *__asan_default_options(void);
AUR_API const char *__ubsan_default_options(void);

const char *__asan_default_options(void) {
    return "abort_on_error=1:handle_abort=0:allocator_may_return_null=1:max_allocation_size_mb=4096";
}

const char *__ubsan_default_options(void) {
    return "abort_on_error=1:print_stacktrace=1";
}

/* Covered addresses of code compiled with -fsanitize-coverage=trace-pc, which calls the function below at
 * each basic block: an open-addressing hash table of return addresses. */
enum { ADDRESS_CAPACITY = 1 << 16 };
static size_t reached_count;
AUR_API void __sanitizer_cov_trace_pc(void);

void __sanitizer_cov_trace_pc(void) {
    static const void *reached[ADDRESS_CAPACITY];
    const void *const address = __builtin_return_address(0);
    size_t slot = (size_t)aur_hash2(0, (uint64_t)(uintptr_t)address) % ADDRESS_CAPACITY;
    while (reached[slot] != NULL && reached[slot] != address)
        slot = (slot + 1) % ADDRESS_CAPACITY;
    reached_count += reached[slot] == NULL && reached_count < ADDRESS_CAPACITY / 2;
    reached[slot] = address;
}

typedef struct fuzz_seed {
    size_t size;
    uint8_t *data;
} fuzz_seed;

typedef struct fuzz_corpus {
    size_t count;
    fuzz_seed seeds[SEED_CAPACITY];
    size_t word_count;
    fuzz_seed words[WORD_CAPACITY]; /* of the dictionary */
} fuzz_corpus;

/* The current run, for the signal handler. */
static volatile sig_atomic_t current_run;

static void on_signal(int number) {
    char text[96];
    int length = 0;
    const char *const start = number == SIGALRM ? "fuzz: no end in sight in run " : "fuzz: died in run ";
    for (const char *c = start; *c != '\0'; ++c)
        text[length++] = *c;
    char digits[16];
    int count = 0;
    for (int run = (int)current_run; run > 0 || count == 0; run /= 10)
        digits[count++] = (char)('0' + run % 10);
    while (count > 0)
        text[length++] = digits[--count];
    text[length++] = '\n';
    const ssize_t written = write(STDERR_FILENO, text, (size_t)length);
    _exit(written > 0 ? 1 : 2);
}

/* A random stream that depends only on the run. */
typedef struct fuzz_dice {
    uint64_t key, counter;
} fuzz_dice;

static uint64_t roll(fuzz_dice *dice, uint64_t sides) {
    return sides > 0 ? aur_hash2(dice->key, dice->counter++) % sides : 0;
}

typedef struct fuzz_input {
    size_t size;
    uint8_t *data; /* INPUT_CAPACITY bytes */
} fuzz_input;

/* Replaces `removed` bytes at `at` by `count` bytes, limited by the capacity. */
static void replace(fuzz_input *input, size_t at, size_t removed, const void *bytes, size_t count) {
    if (input->size - removed + count > INPUT_CAPACITY)
        return;
    memmove(input->data + at + count, input->data + at + removed, input->size - at - removed);
    memcpy(input->data + at, bytes, count);
    input->size = input->size - removed + count;
}

static void edit_number(fuzz_input *input, fuzz_dice *dice) {
    static const char *const numbers[] = {
        "0",    "-1",    "1",   "-0",   "4294967295", "-2147483649", "99999999999999999999",
        "1e39", "1e999", "nan", "-inf", "1e-999",     "0x10",        ".",
        "1.5",  "256",   "",    "1e",   "--1",        "65537"};
    const size_t from = (size_t)roll(dice, input->size);
    for (size_t i = 0; i < input->size; ++i) {
        const size_t at = (from + i) % input->size;
        size_t length = 0;
        while (at + length < input->size && input->data[at + length] >= '0' &&
               input->data[at + length] <= '9')
            ++length;
        if (length == 0)
            continue;
        const char *const number = numbers[roll(dice, sizeof numbers / sizeof numbers[0])];
        replace(input, at, length, number, strlen(number));
        return;
    }
}

/* 1, 2, 4 or 8 bytes of a boundary value, in either byte order. */
static void edit_word(fuzz_input *input, fuzz_dice *dice) {
    static const uint64_t values[] = {0,          1,          0x7f,       0x80,        0xff,
                                      0x7fff,     0x8000,     0xffff,     0x7fffffff,  0x80000000,
                                      0xffffffff, 0x7f800000, 0x7fc00000, 0x100000000, UINT64_MAX};
    const size_t width = (size_t)1 << roll(dice, 4);
    if (input->size < width)
        return;
    const uint64_t value = values[roll(dice, sizeof values / sizeof values[0])];
    const size_t at = (size_t)roll(dice, input->size - width + 1);
    const bool big = roll(dice, 2) != 0;
    for (size_t i = 0; i < width; ++i)
        input->data[at + (big ? width - 1 - i : i)] = (uint8_t)(value >> (8 * i));
}

static bool is_word(uint8_t c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/* The first word at or after a position: its start, and its length, 0 if there is none. */
static size_t find_word(const uint8_t *data, size_t size, size_t from, size_t *begin) {
    while (from > 0 && from < size && is_word(data[from - 1]))
        --from;
    while (from < size && !is_word(data[from]))
        ++from;
    *begin = from;
    size_t length = 0;
    while (from + length < size && is_word(data[from + length]))
        ++length;
    return length;
}

/* Replaces a word by one of some seed or of the dictionary, for example one name by another. */
static void edit_name(fuzz_input *input, const fuzz_corpus *corpus, fuzz_dice *dice) {
    const bool from_dictionary = corpus->word_count > 0 && roll(dice, 2) == 0;
    const fuzz_seed *const other = from_dictionary ? &corpus->words[roll(dice, corpus->word_count)]
                                                   : &corpus->seeds[roll(dice, corpus->count)];
    size_t at, from;
    const size_t removed = find_word(input->data, input->size, (size_t)roll(dice, input->size), &at);
    if (from_dictionary) {
        replace(input, at, removed, other->data, other->size);
        return;
    }
    const size_t length = find_word(other->data, other->size, (size_t)roll(dice, other->size), &from);
    replace(input, at, removed, other->data + from, length);
}

static void edit(fuzz_input *input, const fuzz_corpus *corpus, fuzz_dice *dice) {
    if (input->size == 0)
        return;
    const size_t at = (size_t)roll(dice, input->size);
    const size_t piece = (size_t)roll(dice, input->size - at < 64 ? input->size - at : 64) + 1;
    switch (roll(dice, 10)) {
    case 0:
        input->data[at] ^= (uint8_t)(1u << roll(dice, 8));
        break;
    case 1:
        input->data[at] = (uint8_t)roll(dice, 256);
        break;
    case 2:
        edit_word(input, dice);
        break;
    case 3:
        edit_number(input, dice);
        break;
    case 4:
        replace(input, at, piece, "", 0);
        break;
    case 5: { /* repeats a piece */
        uint8_t copy[64];
        memcpy(copy, input->data + at, piece);
        replace(input, (size_t)roll(dice, input->size), 0, copy, piece);
        break;
    }
    case 8:
        edit_name(input, corpus, dice);
        break;
    case 6:
        if (roll(dice, 4) == 0)
            input->size = at;
        break;
    case 7: { /* inserts a piece of another seed */
        const fuzz_seed *const other = &corpus->seeds[roll(dice, corpus->count)];
        const size_t from = (size_t)roll(dice, other->size);
        const size_t length = (size_t)roll(dice, other->size - from < 256 ? other->size - from : 256);
        replace(input, at, 0, other->data + from, length);
        break;
    }
    default: { /* inserts punctuation of structured text */
        static const char marks[] = "<>/\"'=&;:,.#$-+ \n\t%\\{}[]()";
        input->data[at] = (uint8_t)marks[roll(dice, sizeof marks - 1)];
        break;
    }
    }
}

/* The first runs use the seeds unchanged. */
static void make_input(const fuzz_corpus *corpus, uint64_t seed, size_t run, fuzz_input *input) {
    fuzz_dice dice = {.key = aur_hash2(seed, run)};
    const bool mutated = run >= corpus->count;
    const fuzz_seed *const source = &corpus->seeds[mutated ? roll(&dice, corpus->count) : run];
    memcpy(input->data, source->data, source->size);
    input->size = source->size;
    for (size_t i = mutated ? (size_t)roll(&dice, EDITS) + 1 : 0; i > 0; --i)
        edit(input, corpus, &dice);
}

/* The harness gets a buffer of the exact size, so that the sanitizer detects every out-of-bounds access. */
static void run_input(const fuzz_input *input, size_t run) {
    uint8_t *const exact = malloc(input->size > 0 ? input->size : 1);
    fuzz_require(exact != NULL, "out of memory");
    memcpy(exact, input->data, input->size);
    current_run = (sig_atomic_t)run;
    alarm(SECONDS_A_RUN);
    LLVMFuzzerTestOneInput(exact, input->size);
    alarm(0);
    free(exact);
}

static void add(size_t capacity, fuzz_seed *seeds, size_t *count, const uint8_t *data, size_t size) {
    fuzz_require(*count < capacity, "too many seeds or words");
    fuzz_seed *const seed = &seeds[(*count)++];
    *seed = (fuzz_seed){.size = size, .data = malloc(size > 0 ? size : 1)};
    fuzz_require(seed->data != NULL, "out of memory");
    memcpy(seed->data, data, size);
}

static void add_seed(fuzz_corpus *corpus, const uint8_t *data, size_t size) {
    add(SEED_CAPACITY, corpus->seeds, &corpus->count, data, size);
}

static void add_words(fuzz_corpus *corpus, const char *path) {
    FILE *const file = fopen(path, "r");
    fuzz_require(file != NULL, "the dictionary cannot be read");
    char line[256];
    while (fgets(line, sizeof line, file) != NULL) {
        const size_t length = strcspn(line, "\n");
        fuzz_require(length >= 2 && line[0] == '"' && line[length - 1] == '"', "a word without its quotes");
        add(WORD_CAPACITY, corpus->words, &corpus->word_count, (const uint8_t *)line + 1, length - 2);
    }
    fclose(file);
}

static void add_seeds(fuzz_corpus *corpus, int file_count, char **files) {
    uint8_t *const buffer = malloc(INPUT_CAPACITY);
    fuzz_require(buffer != NULL, "out of memory");
    for (size_t i = 0;; ++i) {
        const size_t size = aur_fuzz_seed(i, INPUT_CAPACITY, buffer);
        if (size == 0)
            break;
        add_seed(corpus, buffer, size);
    }
    for (int i = 0; i < file_count; ++i) {
        FILE *const file = fopen(files[i], "rb");
        fuzz_require(file != NULL, "a seed file cannot be read");
        const size_t size = fread(buffer, 1, INPUT_CAPACITY, file);
        fclose(file);
        add_seed(corpus, buffer, size);
    }
    free(buffer);
}

static void save_input(const fuzz_input *input) {
    fuzz_require(aur_file_write("fuzz-input", input->size, input->data, NULL) == AUR_OK,
                 "fuzz-input cannot be written");
}

int main(int argc, char **argv) {
    uint64_t seed = 1;
    size_t runs = 10000, only = SIZE_MAX;
    int first_file = 1;
    const char *dictionary = NULL;
    bool fresh = false;
    for (; first_file + 1 < argc && argv[first_file][0] == '-'; first_file += 2) {
        const char *const name = argv[first_file];
        const uint64_t value = strtoull(argv[first_file + 1], NULL, 10);
        if (strcmp(name, "--runs") == 0)
            runs = (size_t)value;
        else if (strcmp(name, "--seed") == 0)
            seed = value;
        else if (strcmp(name, "--only") == 0)
            only = (size_t)value;
        else if (strcmp(name, "--fresh") == 0)
            fresh = value != 0;
        else if (strcmp(name, "--dictionary") == 0)
            dictionary = argv[first_file + 1];
        else
            break;
    }
    if (first_file < argc && argv[first_file][0] == '-') {
        fprintf(stderr,
                "usage: %s [--runs N] [--seed S] [--only R] [--dictionary WORDS] [--fresh 1] [FILE...]\n",
                argv[0]);
        return 2;
    }
    /* The sanitizer handles the other signals: it prints the stack and aborts. */
    signal(SIGABRT, on_signal);
    signal(SIGALRM, on_signal);
    static fuzz_corpus corpus;
    if (dictionary != NULL)
        add_words(&corpus, dictionary);
    add_seeds(&corpus, argc - first_file, argv + first_file);
    fuzz_require(corpus.count > 0, "there are no seeds");
    fuzz_input input = {.data = malloc(INPUT_CAPACITY)};
    fuzz_require(input.data != NULL, "out of memory");
    const size_t end = only != SIZE_MAX ? only + 1 : corpus.count + runs;
    for (size_t run = only != SIZE_MAX ? only : 0; run < end; ++run) {
        make_input(&corpus, seed, run, &input);
        if (only != SIZE_MAX)
            save_input(&input);
        const size_t before = reached_count;
        run_input(&input, run);
        const size_t first_file_seed = corpus.count - (size_t)(argc - first_file);
        if (fresh && run >= first_file_seed && run < corpus.count && reached_count > before)
            printf("%s\n", argv[(size_t)first_file + run - first_file_seed]);
    }
    for (size_t i = 0; i < corpus.count; ++i)
        free(corpus.seeds[i].data);
    for (size_t i = 0; i < corpus.word_count; ++i)
        free(corpus.words[i].data);
    free(input.data);
    printf("%zu seeds, %zu mutations of seed %llu: no complaint\n", corpus.count, runs,
           (unsigned long long)seed);
    return 0;
}
