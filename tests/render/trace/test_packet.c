#define _DEFAULT_SOURCE /* setenv */
#include "../scene/scene_text.h"

#include <stdlib.h>

#include "points/base/random.h"
#include "render/scene/materials/sampling.h"
#include "render/trace/packet.h"

/* A mesh, a curved shape and copies of a group, so that every kind of hit is met. */
static const char *const body =
    "<shape type='cube'><transform name='to_world'><scale value='5'/></transform></shape>"
    "<shape type='sphere'><point name='center' x='1.5' y='0.2' z='-1'/></shape>"
    "<shape type='shapegroup' id='pair'><shape type='cube'/>"
    "<shape type='disk'><transform name='to_world'><scale value='1.5'/><translate "
    "z='1.5'/></transform></shape>"
    "</shape>"
    "<shape type='instance'><ref id='pair'/><transform name='to_world'><scale value='0.7'/>"
    "<translate x='-2' y='1'/></transform></shape>"
    "<shape type='instance'><ref id='pair'/><transform name='to_world'><rotate y='1' angle='50'/>"
    "<translate x='1' y='-3' z='2'/></transform></shape>";

static float unit(uint64_t a, uint64_t b) {
    return aur_unit_float((uint32_t)(aur_hash2(a, b) >> 32));
}

static aur_ray random_ray(uint64_t index) {
    return (aur_ray){
        .origin = {8.0f * unit(1, index) - 4.0f, 8.0f * unit(2, index) - 4.0f, 8.0f * unit(3, index) - 4.0f},
        .direction = aur_sample_sphere(unit(4, index), unit(5, index)),
        .farthest = index % 3 == 0 ? 3.0f * unit(6, index) : INFINITY};
}

/* Nothing of a lane without a ray is read. */
static void spoil(aur_packet *packet, size_t lane) {
    const aur_ray nonsense = {.origin = {NAN, NAN, NAN}, .direction = {NAN, NAN, NAN}, .farthest = INFINITY};
    aur_packet_set(packet, lane, &nonsense);
    packet->valid[lane] = 0;
}

/* Packets find the hits of single rays, lane by lane, for any active lanes and either order. Single rays and
 * packets are different code in Embree, so at an edge each may report another of the adjacent faces. */
static void packets_agree(const char *isa) {
    setenv("AUREOLE_EMBREE_ISA", isa, 1);
    aur_scene *const scene = must_load_body(body);
    size_t rays = 0, missed = 0, curved = 0, instanced = 0, elsewhere = 0, disagree = 0;
    for (uint64_t p = 0; p < 4000; ++p) {
        const uint32_t lanes = p % 4 == 0 ? 0xffff : (uint32_t)aur_hash2(7, p) & 0xffff;
        const aur_embree_order order = p % 2 == 0 ? AUR_EMBREE_COHERENT : AUR_EMBREE_INCOHERENT;
        aur_packet closest, shadow;
        aur_packet_clear(&closest);
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            const aur_ray ray = random_ray(AUR_PACKET_SIZE * p + k);
            if ((lanes >> k & 1) != 0)
                aur_packet_set(&closest, k, &ray);
            else
                spoil(&closest, k);
        }
        shadow = closest;
        const aur_packet spare = closest;
        const uint32_t hits = aur_scene_intersect16(scene, order, &closest);
        const uint32_t stopped = aur_scene_occluded16(scene, order, &shadow);
        assert_int_equal(hits & ~lanes, 0);
        assert_int_equal(stopped & ~lanes, 0);
        assert_int_equal(aur_scene_occluded_each(scene, &spare) & ~lanes, 0);
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
            if ((lanes >> k & 1) == 0)
                continue;
            const aur_ray ray = random_ray(AUR_PACKET_SIZE * p + k);
            aur_hit single;
            const bool found = aur_scene_intersect(scene, &ray, &single);
            ++rays;
            disagree += found != ((hits >> k & 1) != 0);
            disagree += aur_scene_occluded(scene, &ray) != ((stopped >> k & 1) != 0);
            missed += !found;
            if (!found || (hits >> k & 1) == 0)
                continue;
            const aur_hit hit = aur_packet_hit(scene, &closest, k);
            assert_near(hit.distance, single.distance, 1e-5f * (1.0f + single.distance));
            if (hit.shape != single.shape || hit.primitive != single.primitive ||
                hit.instance != single.instance) {
                ++elsewhere;
                continue;
            }
            assert_near(hit.u, single.u, 1e-5);
            assert_near(hit.v, single.v, 1e-5);
            curved += hit.shape == 1;
            instanced += hit.instance != AUR_NO_INSTANCE;
        }
    }
    assert_true(disagree <= 2);
    assert_true(elsewhere <= rays / 1000);
    assert_true(missed > 1000 && curved > 1000 && instanced > 1000);
    aur_scene_destroy(scene);
    unsetenv("AUREOLE_EMBREE_ISA");
}

/* By packets of 4, 8 and 16, the sizes of Embree's kernels. */
static void packets_agree_with_single_rays(void **state) {
    (void)state;
    packets_agree("portable");
    packets_agree("avx2");
    packets_agree("avx512");
}

/* Leaves its bytes on the stack for the next call to find in variables that it does not set. */
static __attribute__((noinline)) void spoil_stack(void) {
    volatile unsigned char bytes[1 << 16];
    for (size_t i = 0; i < sizeof bytes; ++i)
        bytes[i] = 0xff;
}

/* Without curved shapes Embree traverses instances by another path, which never ended for shadow rays flagged
 * as coherent. */
static void shadows_of_instances_end(void **state) {
    (void)state;
    aur_scene *const scene = must_load_body(
        "<shape type='rectangle'/><shape type='shapegroup' id='one'><shape type='rectangle'/></shape>"
        "<shape type='instance'><ref id='one'/><transform name='to_world'><translate z='1'/></transform>"
        "</shape>");
    aur_packet packet;
    aur_packet_clear(&packet);
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k) {
        const aur_ray ray = {.origin = {0.2f * (float)k, 0.0f, 2.0f},
                             .direction = {0.0f, 0.0f, k % 2 == 0 ? -1.0f : 1.0f},
                             .farthest = 10.0f};
        aur_packet_set(&packet, k, &ray);
    }
    spoil_stack();
    assert_int_equal(aur_scene_occluded16(scene, AUR_EMBREE_COHERENT, &packet), 0x15); /* x = 0, .4, .8 */
    aur_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(packets_agree_with_single_rays),
                                       cmocka_unit_test(shadows_of_instances_end)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
