/* Command lines: parses every command's options without running a command. An input is one line of arguments
 * separated by blanks; the first is the command. */
int program_main(int argc, char **argv);
#define main program_main
#include "program/cli/main.c"
#undef main

#include <fcntl.h>
#include <unistd.h>

#include "fuzz.h"

enum { MOST_ARGUMENTS = 32 };

/* Silences the messages about invalid command lines. */
static int silence(int stream) {
    fflush(stderr);
    const int saved = dup(stream), null = open("/dev/null", O_WRONLY);
    fuzz_require(saved >= 0 && null >= 0, "no descriptor");
    dup2(null, stream);
    close(null);
    return saved;
}

static void restore(int stream, int saved) {
    fflush(stderr);
    dup2(saved, stream);
    close(saved);
}

/* Reading a limit applies it to the fuzzer itself, so these options are excluded. Options may be abbreviated:
 * --mem 8 is --memory-limit. */
static bool is_limit(const char *command, const char *argument) {
    const size_t length = strcspn(argument, "=");
    if (length == strlen("--time") && strcmp(command, "render") == 0)
        return strncmp(argument, "--memory-limit", length) == 0;
    return length > 2 && (strncmp(argument, "--memory-limit", length) == 0 ||
                          strncmp(argument, "--time-limit", length) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *const text = malloc(size + 1);
    fuzz_require(text != NULL, "out of memory");
    if (size > 0)
        memcpy(text, data, size);
    text[size] = '\0';
    char *arguments[MOST_ARGUMENTS + 1];
    int count = 0;
    char *rest = NULL;
    for (char *word = strtok_r(text, " \n", &rest); word != NULL && count < MOST_ARGUMENTS;
         word = strtok_r(NULL, " \n", &rest))
        arguments[count++] = word;
    arguments[count] = NULL;
    const cli_command *const command = count > 0 ? find_command(arguments[0]) : NULL;
    bool limits = false;
    for (int i = 1; i < count; ++i)
        limits = limits || is_limit(arguments[0], arguments[i]);
    if (command != NULL && !limits) {
        cli_call call = {.commands = commands, .options = calloc(1, command->size + 1)};
        fuzz_require(call.options != NULL, "out of memory");
        const int saved = silence(STDERR_FILENO);
        const bool good = cli_read_options(command, count, arguments, &call);
        restore(STDERR_FILENO, saved);
        for (size_t i = 0; good && i < call.operand_count; ++i)
            fuzz_require(call.operands[i] != NULL, "an operand that is none");
        const cli_option *option;
        for (size_t i = 0; good && (option = cli_option_at(command, i, NULL)) != NULL; ++i)
            if (call.texts[i] != NULL)
                fuzz_require(cli_given(&call, option->key.name) != NULL, "an option that was given is not");
        free(call.options);
    }
    free(text);
    return 0;
}

static const char *const lines[] = {
    "render a.xml -o a.exr --integrator path:max_depth=3 --spp 16 --width 64 --height 48 --seed 7",
    "render a.xml --crop 0,8,0,8 --filter box --sampler sobol -q -t 2 --no-cache --confine",
    "render a.xml --shard 2/3 -D n=4 -D room=large --checkpoint kept --checkpoint-every 10s --resume",
    "render a.xml --error 5% --rounds 7 --error-map --verbose",
    "render a.xml --error 0.01 --confidence 0.99 --time 2min --rays 1e9",
    "render a.xml --reference b.exr --errors c.csv",
    "merge 1.part 2.part -o a.exr",
    "points sobol -n 256 --scramble owen --seed 3 --format csv -o a.csv",
    "points bnot -n 64 --on sphere --plot a.svg",
    "measure sobol,hammersley -n 64,128,256 --measures star,t --replicates 8 --threads 1 --format json",
    "measure fibonacci --fit 10,1000 --plot a.svg",
    "nearest a.csv b.csv -k 3 --format tsv",
    "voronoi a.csv --on sphere --areas",
    "weights spherical-fibonacci -n 64 --lobe phong:50 --smoothness 1.4 --regularization 1e-6",
    "weights sobol -n 256 --lobe cosine --lobe2 ggx:0.3 --n2 64 --angles 16 --rotations 2 --table a.table",
    "irradiance a.xml --points a.pts --accuracy 2% --format npy -o a.npy",
    "viewfactors a.obj --rays 64 --format npz -o a.npz --tolerance 1e-4",
    "compare a.exr b.exr --metric flip --tolerance 1e-3 --crop 0,4,0,4",
    "convert a.exr b.png --exposure 1.5 --tone aces",
    "lab run keller-1994-table2 --quick -o lab",
    "info a.xml --format csv --confine",
    "sets --format json",
    "sets --json",
    "render a.xml --time soon",
    "render a.xml -D =1 -D a",
    "completion bash",
    "help integrator path",
    "render -- --help",
    "compare --tolerance=-1 a",
    "points --seed 99999999999999999999 --n nan",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof lines / sizeof lines[0], lines, index, capacity, data);
}
