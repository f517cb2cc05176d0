/* libaureole-render in C++17, as aureole.hpp is for libaureole: images, scenes and renders. */
#ifndef AUREOLE_RENDER_HPP
#define AUREOLE_RENDER_HPP

#include <aureole-render/render.h>
#include <aureole/aureole.hpp>

namespace aureole {

/* An image (aur_image). */
class image {
  public:
    image(std::size_t width, std::size_t height, std::size_t channels) {
        aur_image *created = nullptr;
        detail::call(aur_image_create, width, height, channels, &created);
        owned_.reset(created);
    }
    explicit image(aur_image *created) noexcept : owned_(created) {
    } /* takes it over */
    static image read(const std::string &path) {
        aur_image *created = nullptr;
        detail::call(aur_image_read, path.c_str(), &created);
        return image(created);
    }

    std::size_t width() const noexcept {
        return aur_image_width(owned_.get());
    }
    std::size_t height() const noexcept {
        return aur_image_height(owned_.get());
    }
    std::size_t channels() const noexcept {
        return aur_image_channel_count(owned_.get());
    }
    /* Row by row from the top, channels side by side. */
    span<float> data() noexcept {
        return {aur_image_data(owned_.get()), width() * height() * channels()};
    }
    span<const float> data() const noexcept {
        return {aur_image_data(owned_.get()), width() * height() * channels()};
    }
    void write(const std::string &path,
               const aur_image_write_options &options =
                   aureole::options<aur_image_write_options>(aur_image_write_options_init)) const {
        detail::call(aur_image_write, path.c_str(), owned_.get(), &options);
    }
    const aur_image *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_image, aur_image_destroy> owned_;
};

/* A scene that was read (aur_scene). It must outlive its renderers. */
class scene {
  public:
    explicit scene(const std::string &path, const aur_scene_options &options =
                                                aureole::options<aur_scene_options>(aur_scene_options_init)) {
        aur_scene *created = nullptr;
        detail::call(aur_scene_load, path.c_str(), &options, &created);
        owned_.reset(created);
    }
    aur_scene_description describe() const {
        aur_scene_description found{};
        found.size = sizeof found;
        detail::call(aur_scene_get_description, owned_.get(), &found);
        return found;
    }
    const aur_scene *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_scene, aur_scene_destroy> owned_;
};

/* Makes images of one scene and keeps between them what they share (aur_renderer). */
class renderer {
  public:
    explicit renderer(const scene &of) {
        aur_renderer *created = nullptr;
        detail::call(aur_renderer_create, of.get(), &created);
        owned_.reset(created);
    }
    image
    render(const aur_render_options &options = aureole::options<aur_render_options>(aur_render_options_init),
           aur_render_statistics *statistics = nullptr) {
        aur_error found{};
        aur_image *created = nullptr;
        const aur_result result = aur_renderer_render(owned_.get(), &options, &created, statistics, &found);
        image rendered(created); /* that of a render that was cancelled is freed */
        if (result != AUR_OK)
            throw error(found);
        return rendered;
    }
    aur_renderer *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_renderer, aur_renderer_destroy> owned_;
};

} // namespace aureole

#endif
