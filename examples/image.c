/* An image of a scene or model, rendered to a target error.
 *
 *     cc examples/image.c -laureole-render -lm -o image && ./image cornell-box.xml cornell.png
 *
 * Without arguments it renders a grey sphere (reflectance 0.5) below an even sky of radiance 1. Prints the
 * middle pixel, which is 0.5 for the sphere, and the error relative to the mean of the image. */
#include <aureole-render/adaptive.h>
#include <stdio.h>
#include <string.h>

static const char sphere[] =
    "<scene version='3.0.0'><emitter type='constant'/>"
    "<sensor type='perspective'><transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/>"
    "</transform><film type='hdrfilm'><integer name='width' value='32'/><integer name='height' value='32'/>"
    "</film></sensor><shape type='sphere'><bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf>"
    "</shape></scene>";

int main(int argc, char **argv) {
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    aur_adaptive *render = NULL;
    aur_image *image = NULL;
    aur_error error = {0};
    aur_adaptive_options options = {.size = sizeof options};
    aur_adaptive_report report = {.size = sizeof report};
    aur_adaptive_options_init(&options, NULL);
    options.error = 0.02; /* stop at 2 % */
    const aur_result loaded =
        argc > 1 ? aur_scene_load(argv[1], NULL, &scene, &error)
                 : aur_scene_load_memory("sphere.xml", strlen(sphere), sphere, NULL, &scene, &error);
    const bool done = loaded == AUR_OK && aur_renderer_create(scene, &renderer, &error) == AUR_OK &&
                      aur_adaptive_create(renderer, NULL, &options, &render, &error) == AUR_OK &&
                      aur_adaptive_run(render, &error) == AUR_OK &&
                      aur_adaptive_develop(render, false, &image, &error) == AUR_OK &&
                      aur_adaptive_get_report(render, &report, &error) == AUR_OK &&
                      (argc < 3 || aur_image_write(argv[2], image, NULL, &error) == AUR_OK);
    if (done) {
        const size_t width = aur_image_width(image),
                     middle = width * (aur_image_height(image) / 2) + width / 2;
        printf("middle %.4f error %.4f\n",
               (double)aur_image_data(image)[middle * aur_image_channel_count(image)], report.error);
    } else {
        fprintf(stderr, "%s\n", error.message);
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(render);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return done ? 0 : 1;
}
