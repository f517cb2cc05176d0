/* Calls each function of core.h, text.h, statistics.h and tables.h. */
#include <aureole/statistics.h>
#include <aureole/tables.h>
#include <aureole/text.h>
#include <aureole/version.h>

#include "calls.h"

static void errors(void) {
    aur_error problem = {0};
    require(aur_fail(&problem, AUR_ERROR_FORMAT, "%d words", 2) == AUR_ERROR_FORMAT, "aur_fail");
    char text[32];
    require(aur_error_format(&problem, sizeof text, text) == strlen(text), "aur_error_format");
    require(strlen(aur_result_string((aur_result)99)) > 0, "aur_result_string");
    int major;
    require(sscanf(aur_version(), "%d.", &major) == 1 && major == AUREOLE_VERSION_MAJOR, "aur_version");
    accept(aur_file_write("calls.txt", 4, "text", &problem), &problem);
    refuse(aur_file_write("no such folder/calls.txt", 4, "text", &problem), AUR_ERROR_WRITE, &problem);
    remove("calls.txt");
}

static void texts(void) {
    double real = 0.0;
    uint64_t integer = 0;
    require(aur_parse_double("1.5", &real) && real == 1.5 && !aur_parse_double("1,5", &real),
            "aur_parse_double");
    require(aur_parse_integer("7", 7, &integer) && !aur_parse_integer("8", 7, &integer), "aur_parse_integer");
    char text[32];
    require(aur_format(text, sizeof text, "%g", 0.5) == 3 && strcmp(text, "0.5") == 0, "aur_format");
    const char *const names[] = {"sobol", "halton"};
    require(aur_nearest_name("sobal", 2, names) == names[0], "aur_nearest_name");
    require(aur_list_names(2, names, sizeof text, text) == strlen("sobol, halton"), "aur_list_names");
    char *json_text = NULL;
    size_t size = 0;
    aur_json json = {.stream = open_memstream(&json_text, &size)};
    require(json.stream != NULL, "open_memstream");
    aur_json_open(&json, '{', false);
    aur_json_name(&json, "a");
    aur_json_open(&json, '[', false);
    aur_json_number(&json, 0.5);
    aur_json_integer(&json, 2);
    aur_json_boolean(&json, true);
    aur_json_string(&json, "\"");
    aur_json_close(&json, ']');
    aur_json_close(&json, '}');
    require(aur_print(json.stream, "%d", 3) == 1, "aur_print");
    fclose(json.stream);
    require(strcmp(json_text, "{\"a\": [0.5, 2, true, \"\\\"\"]}\n3") == 0, json_text);
    free(json_text);
}

static void statistics(void) {
    aur_moments moments = {0};
    for (int i = 0; i < 3; ++i)
        aur_moments_add(&moments, i);
    require(aur_moments_variance(&moments) == 1.0, "aur_moments_variance");
    require(fabs(aur_moments_standard_error(&moments) - sqrt(1.0 / 3.0)) < 1e-15,
            "aur_moments_standard_error");
    require(aur_moments_interval(&moments, 0.95) > 2.0, "aur_moments_interval");
    require(fabs(aur_student_quantile(1, 0.75) - 1.0) < 1e-9 && isnan(aur_student_quantile(0, 0.5)),
            "aur_student_quantile");
}

static void tables(void) {
    const aur_table *const sets = aur_table_at(0);
    require(sets != NULL && aur_table_at(1000) == NULL, "aur_table_at");
    const aur_row *row = NULL;
    for (size_t i = 0; i < sets->count && row == NULL; ++i)
        if (strcmp(sets->rows[i]->name, "faure") == 0)
            row = sets->rows[i];
    require(row != NULL && aur_row_key(row, 0) != NULL && aur_row_key(row, 1000) == NULL, "aur_row_key");
    const aur_key *const key = aur_row_find_key(row, "base");
    require(key != NULL && aur_row_find_key(row, "nothing") == NULL, "aur_row_find_key");
    require(strcmp(aur_key_type_name(key->type), "integer") == 0, "aur_key_type_name");
    _Alignas(8) char fields[512] = {0};
    char text[64];
    require(key->offset + key->size <= sizeof fields, "a key's place");
    require(aur_key_parse(key, "3", fields, sizeof text, text), "aur_key_parse");
    require(!aur_key_parse(key, "x", fields, sizeof text, text) && text[0] != '\0', "aur_key_parse");
    require(aur_key_range(key, sizeof text, text) > 0, "aur_key_range");
}

int main(void) {
    errors();
    texts();
    statistics();
    tables();
    return 0;
}
