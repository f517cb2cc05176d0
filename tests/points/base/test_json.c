#include "check.h"

#include <stdio.h>
#include <stdlib.h>

#include <aureole/text.h>

static void writes_nested_values(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    aur_json json = {.stream = open_memstream(&text, &size)};
    assert_non_null(json.stream);
    aur_json_open(&json, '[', true);
    for (int i = 0; i < 2; ++i) {
        aur_json_open(&json, '{', false);
        aur_json_name(&json, "a \"b\"\n");
        aur_json_number(&json, i == 0 ? 0.1 : (double)INFINITY);
        aur_json_name(&json, "list");
        aur_json_open(&json, '[', false);
        aur_json_integer(&json, 1);
        aur_json_string(&json, "\\");
        aur_json_boolean(&json, true);
        aur_json_close(&json, ']');
        aur_json_close(&json, '}');
    }
    aur_json_open(&json, '[', true);
    aur_json_close(&json, ']');
    aur_json_close(&json, ']');
    fclose(json.stream);
    assert_string_equal(text,
                        "[\n"
                        "  {\"a \\\"b\\\"\\u000a\": 0.10000000000000001, \"list\": [1, \"\\\\\", true]},\n"
                        "  {\"a \\\"b\\\"\\u000a\": null, \"list\": [1, \"\\\\\", true]},\n"
                        "  []\n"
                        "]\n");
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(writes_nested_values)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
