/* Radiance's scene descriptions. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "render/scene/importers/rad/rad.h"
#include "render/scene/scene_data.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_scene *scene = NULL;
    const aur_scene_options options = {.size = sizeof options, .diffuse = size % 2 == 1};
    const aur_result result = aur_scene_load_memory("input.rad", size, data, &options, &scene, &error);
    if (result != AUR_OK) {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
    }
    aur_scene_destroy(scene);
    return 0;
}

static const char *const seeds[] = {
    "# a room\nvoid plastic a\n0\n0\n5 .5 .5 .5 0 0\nvoid glass g 0 0 4 .9 .9 .9 1.5\nvoid alias b a\n"
    "b polygon f\n0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\nb polygon l 0 0 18 0 0 1 2 0 1 2 1 1 1 1 1 1 2 1 0 2 1\n"
    "g sphere s 0 0 4 1 2 3 .5\na bubble u 0 0 4 1 2 3 -5\n",
    "void light l 0 0 3 1 2 3\nvoid glow g 0 0 4 1 1 1 0\nl ring r 0 0 8 0 0 2 0 0 -1 0 1\n"
    "l source s 0 0 4 0 0 1 .533\ng source d 0 0 4 0 0 1 180\nl tube t 0 0 7 0 0 0 1 1 1 .5\n"
    "l mesh m 1 a&b$.obj 0 0\n!xform a.rad\n",
    "void trans \"a b\" 0 0 7 .5 .5 .5 .1 .1 .5 .5\nvoid metal m 0 0 5 .5 .5 .5 .9 0\n"
    "!genbox \"a b\" x 1 2 3 -r .1 -i | xform -t 1 2 3 -a 2 -rz 90 -a 3 -mx -i 2 -s .5\n"
    "!genbox m x 1 2 3 -b .1 | \\\n xform -m m -n y -I\n!genprism m p 3 0 0 1 0 0 1 -l 0 0 2 -e -c\n"
    "m cone c 0 0 8 0 0 0 0 0 1 1 .5\nm cup c 0 0 8 0 0 0 0 0 1 0 .5\nvoid ring r 0 0 8 0 0 0 0 0 1 0 1\n",
    "void brightfunc f 2 skybr skybright.cal 0 7 1 30 5 2 0 0 1\nf glow g 0 0 4 1 1 1 0\n"
    "g source s 0 0 4 0 0 1 180\ng source s 0 0 4 0 0 -1 180\n",
    "void brightfunc f 2 skybright perezlum.cal 0 10 2 3 -.9 -.2 8 -3 .3 0 .6 .8\nf light g 0 0 3 1 1 1\n"
    "g source s 0 0 4 0 0 1 360\n",
    "void texfunc t 4 a b c d 0 1 2\nt plastic2 p 4 a b c d 0 6 .5 .5 .5 .1 .1 .1\nvoid mixfunc x 4 p void a "
    "b 0 0\n"
    "x sphere s 0 0 4 0 0 0 1\nvoid dielectric d 0 0 5 .5 .5 .5 1.5 0\nd bubble s 0 0 4 5 0 0 1\n"
    "void interface i 0 0 8 1 1 1 1.5 1 1 1 1.3\nvoid BRTDfunc f 10 a b c d e f g h i j 0 9 1 1 1 0 0 0 0 0 "
    "0\n"
    "void illum l 1 d 0 3 1 1 1\nl ring r 0 0 8 0 0 2 0 0 -1 0 1\nf instance i 3 none.rad -s 2 0 0\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof seeds / sizeof seeds[0], seeds, index, capacity, data);
}
