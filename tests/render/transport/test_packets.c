/* The helpers of packets: pixels of sixteen lanes, lane masks, and the coherence criterion. */
#include "check.h"

#include "points/base/random.h"
#include "render/trace/interleave.h"
#include "render/trace/packet_rays.h"

/* The groups part the tile: every pixel is one lane of one group, and the ranks number the groups. */
static void groups_part_the_tile(uint64_t hash) {
    unsigned pixels[AUR_TILE_PIXELS] = {0}, ranks[AUR_GROUP_COUNT] = {0};
    for (uint32_t group = 0; group < AUR_GROUP_COUNT; ++group) {
        size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
        aur_group_pixels(hash, group, 32, 48, x, y);
        ++ranks[aur_group_rank(group)];
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
            const size_t pixel = aur_group_pixel(hash, group, lane);
            ++pixels[pixel];
            assert_int_equal(x[lane], 32 + pixel % AUR_TILE_SIZE);
            assert_int_equal(y[lane], 48 + pixel / AUR_TILE_SIZE);
        }
        /* Of an image that ends two blocks into the tile, the left or upper half of the lanes is left. */
        assert_int_equal(aur_group_lanes_within(x, y, 0, 40, 0, 64), 0x3333);
        assert_int_equal(aur_group_lanes_within(x, y, 0, 48, 0, 56), 0x00ff);
        assert_int_equal(aur_group_lanes_within(x, y, 40, 48, 56, 64), 0xcc00);
    }
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i)
        assert_int_equal(pixels[i], 1);
    for (size_t i = 0; i < AUR_GROUP_COUNT; ++i)
        assert_int_equal(ranks[i], 1);
}

static void groups_part_the_tile_by_every_arrangement(void **state) {
    (void)state;
    groups_part_the_tile(0);
    groups_part_the_tile(UINT64_C(0xfedcba9876543210));
    for (uint64_t k = 0; k < 100; ++k)
        groups_part_the_tile(aur_mix64(k));
}

/* The blocks part the tile, too, and each is 4 x 4 neighbours. */
static void blocks_part_the_tile(void **state) {
    (void)state;
    unsigned pixels[AUR_TILE_PIXELS] = {0};
    for (uint32_t block = 0; block < AUR_GROUP_COUNT; ++block) {
        size_t x[AUR_PACKET_SIZE], y[AUR_PACKET_SIZE];
        aur_block_pixels(block, 32, 48, x, y);
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
            assert_in_range(x[lane], 32, 47);
            assert_in_range(y[lane], 48, 63);
            assert_int_equal(x[lane] / 4, x[0] / 4);
            assert_int_equal(y[lane] / 4, y[0] / 4);
            ++pixels[(y[lane] - 48) * AUR_TILE_SIZE + (x[lane] - 32)];
        }
    }
    for (size_t i = 0; i < AUR_TILE_PIXELS; ++i)
        assert_int_equal(pixels[i], 1);
}

/* Horizontal neighbours in one half of the blocks correspond to vertical neighbours in the other: the share
 * is .5 within five deviations of as many coin tosses, sqrt(1600) / 2 = 20 each. */
static void rows_and_columns_change_places_in_half_of_the_blocks(void **state) {
    (void)state;
    size_t columns = 0;
    for (uint64_t k = 0; k < 100; ++k) {
        const uint64_t hash = aur_group_arrangement(k);
        for (size_t lane = 0; lane < AUR_PACKET_SIZE; ++lane) {
            const uint32_t apart =
                aur_group_pixel_index(hash, 0, lane) ^ aur_group_pixel_index(hash, 1, lane);
            assert_true(apart == 1 || apart == AUR_GROUPS_A_SIDE);
            columns += apart != 1;
        }
    }
    assert_in_range(columns, 700, 900);
}

static void packets_preserve_rays_and_lanes(void **state) {
    (void)state;
    aur_packet packet;
    aur_packet_clear(&packet);
    const aur_ray ray = {.origin = {1, 2, 3}, .nearest = 0.5f, .direction = {0, 0, 1}, .farthest = 7.0f};
    aur_packet_set(&packet, 5, &ray);
    assert_int_equal(aur_lanes_set(packet.valid), 1u << 5);
    const aur_ray stored = aur_packet_ray(&packet, 5);
    assert_memory_equal(&stored, &ray, sizeof ray);
    aur_packet_set_lanes(&packet, 0x8421);
    assert_int_equal(aur_lanes_set(packet.valid), 0x8421);
    aur_packet_empty(&packet);
    assert_int_equal(aur_lanes_set(packet.valid), 0);
    assert_int_equal(aur_first_lane(0x8420), 5);
    assert_int_equal(aur_lane_count(0x8421), 4);
    assert_true(aur_has_lane(0x8421, 15) && !aur_has_lane(0x8421, 14));
}

/* A tenth of the distance off the plane, or an angle whose cosine is .995, is the limit. */
static void coherent_is_one_plane(void **state) {
    (void)state;
    const aur_vector up = {0.0f, 0.0f, 1.0f};
    assert_false(aur_is_off_plane((aur_vector){0}, up, 1.0f));
    assert_false(aur_is_off_plane((aur_vector){1.0f, 0.0f, 0.099f}, up, 1.0f));
    assert_true(aur_is_off_plane((aur_vector){1.0f, 0.0f, -0.102f}, up, 1.0f));
    assert_false(aur_is_off_plane((aur_vector){3.0f, 4.0f, 0.0f}, up, 0.996f));
    assert_true(aur_is_off_plane((aur_vector){3.0f, 4.0f, 0.0f}, up, 0.994f));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_part_the_tile_by_every_arrangement),
        cmocka_unit_test(blocks_part_the_tile),
        cmocka_unit_test(rows_and_columns_change_places_in_half_of_the_blocks),
        cmocka_unit_test(packets_preserve_rays_and_lanes),
        cmocka_unit_test(coherent_is_one_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
