/* render.hpp: images, scenes, renders. */
#include <aureole-render/render.hpp>

#include <cstdio>

int main(int, char **arguments) {
    using namespace aureole;
    const scene box(arguments[1]);
    if (box.describe().shapes == 0)
        return std::puts("a scene without shapes"), 1;
    renderer maker(box);
    aur_render_options options = aureole::options<aur_render_options>(aur_render_options_init);
    options.width = options.height = 8;
    options.samples_per_pixel = 1;
    const image rendered = maker.render(options);
    rendered.write("picture.pfm");
    const image again = image::read("picture.pfm");
    if (rendered.width() != 8 || again.data()[7] != rendered.data()[7 / 3 * rendered.channels() + 7 % 3])
        return std::puts("the picture that was written is another one"), 1;
    try {
        options.integrator = "pasta";
        maker.render(options);
    } catch (const error &found) {
        return found.result() != AUR_ERROR_NAME;
    }
    return std::puts("an unknown integrator was taken"), 1;
}
