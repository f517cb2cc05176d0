/* Blocks of a film, in their order. */
#include "check.h"

#include "render/film/blocks.h"

/* Each block once, and the first ones spread over the image. */
static void test_blocks(void **state) {
    (void)state;
    enum { WIDTH = 37, HEIGHT = 22, BLOCKS = 10 * 6 };
    size_t seen[BLOCKS] = {0}, quarters[4] = {0}, pixels[AUR_BLOCK_PIXELS], covered = 0;
    aur_blocks blocks;
    assert_int_equal(aur_blocks_create(WIDTH, HEIGHT, &blocks, NULL), AUR_OK);
    assert_int_equal(blocks.count, BLOCKS);
    for (size_t i = 0; i < BLOCKS; ++i) {
        const size_t block = blocks.order[i];
        ++seen[block];
        covered += aur_blocks_pixels(&blocks, block, pixels);
        assert_int_equal(pixels[0], block / 10 * 4 * WIDTH + block % 10 * 4);
        if (i < 16)
            ++quarters[block % 10 / 5 + 2 * (block / 10 / 3)];
    }
    for (size_t i = 0; i < BLOCKS; ++i)
        assert_int_equal(seen[i], 1);
    for (size_t i = 0; i < 4; ++i)
        assert_in_range(quarters[i], 3, 5);
    assert_int_equal(covered, WIDTH * HEIGHT);
    aur_blocks_release(&blocks);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_blocks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
