/* Every row of every table: its keys are printed in full, and their defaults are valid values. */
#include "check.h"

#include <aureole-render/render.h>
#include <string.h>

static void check_key(const aur_table *table, const aur_row *row, const aur_key *key) {
    char fields[4096] = {0}, expected[512];
    print_message("%s %s %s\n", table->kind, row->name, key->name);
    assert_true(key->help != NULL && key->help[0] != '\0');
    assert_non_null(aur_key_type_name(key->type));
    assert_true(key->type != AUR_KEY_CHOICE || (key->words != NULL && key->words[0] != NULL));
    assert_true(!key->computed || key->default_text != NULL);
    assert_true(!(key->minimum > key->maximum));
    assert_true(key->offset + key->size <= sizeof fields);
    if (key->default_text != NULL && !key->computed && key->type != AUR_KEY_ITEM)
        assert_true(aur_key_parse(key, key->default_text, fields, sizeof expected, expected));
    assert_ptr_equal(aur_row_find_key(row, key->name), key); /* names are unique */
}

static void check_table(const aur_table *table) {
    assert_non_null(table->rows[0]);
    for (size_t r = 0; r < table->count; ++r) {
        const aur_row *const row = table->rows[r];
        assert_true(row->name[0] != '\0' && row->summary[0] != '\0');
        for (size_t k = 0; aur_row_key(row, k) != NULL; ++k)
            check_key(table, row, aur_row_key(row, k));
    }
}

static void prints_every_key_in_full(void **state) {
    (void)state;
    for (size_t t = 0; aur_table_at(t) != NULL; ++t)
        check_table(aur_table_at(t));
    for (size_t t = 0; aur_render_table_at(t) != NULL; ++t)
        check_table(aur_render_table_at(t));
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(prints_every_key_in_full)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
