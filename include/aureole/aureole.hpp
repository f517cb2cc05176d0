/* libaureole in C++17: owning classes, spans for arrays, exceptions for errors. Everything is inline and
 * calls the C functions; the C headers document the arguments. Objects can be moved, not copied; NULL
 * pointers of C are default arguments. Only the destructor of an empty (moved-from) object may be called. */
#ifndef AUREOLE_AUREOLE_HPP
#define AUREOLE_AUREOLE_HPP

#include <aureole/estimate.h>
#include <aureole/exact.h>
#include <aureole/integrate.h>
#include <aureole/nearest.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <aureole/sphere.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#if __cplusplus >= 202002L
#include <span>
#endif

namespace aureole {

#if __cplusplus >= 202002L
using std::span;
#else
/* The required part of std::span: a pointer and a size. */
template <class T> class span {
  public:
    constexpr span() noexcept = default;
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {
    }
    template <std::size_t N> constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {
    }
    template <class Container, class = std::enable_if_t<
                                   std::is_convertible_v<decltype(std::declval<Container &>().data()), T *>>>
    constexpr span(Container &&container) noexcept : data_(container.data()), size_(container.size()) {
    }

    constexpr T *data() const noexcept {
        return data_;
    }
    constexpr std::size_t size() const noexcept {
        return size_;
    }
    constexpr bool empty() const noexcept {
        return size_ == 0;
    }
    constexpr T &operator[](std::size_t index) const noexcept {
        return data_[index];
    }
    constexpr T *begin() const noexcept {
        return data_;
    }
    constexpr T *end() const noexcept {
        return data_ + size_;
    }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};
#endif

/* The exception of a failed call; what() is "FILE:LINE:COLUMN: message", or the parts that are set. */
class error : public std::runtime_error {
  public:
    explicit error(const aur_error &found) : std::runtime_error(text(found)), found_(found) {
    }
    aur_result result() const noexcept {
        return found_.result;
    }
    const char *message() const noexcept {
        return found_.message;
    }
    const char *file() const noexcept {
        return found_.file;
    }
    std::size_t line() const noexcept {
        return found_.line;
    }
    std::size_t column() const noexcept {
        return found_.column;
    }

  private:
    static std::string text(const aur_error &found) {
        std::string formatted(aur_error_format(&found, 0, nullptr), '\0');
        aur_error_format(&found, formatted.size() + 1, formatted.data());
        return formatted;
    }
    aur_error found_;
};

namespace detail {

/* Calls a function of the library, whose last argument is the aur_error. */
template <class Function, class... Arguments> void call(Function function, Arguments &&...arguments) {
    aur_error found{};
    if (function(std::forward<Arguments>(arguments)..., &found) != AUR_OK)
        throw error(found);
}

template <auto Destroy> struct destroyer {
    template <class T> void operator()(T *object) const noexcept {
        Destroy(object);
    }
};

template <class T, auto Destroy> using owner = std::unique_ptr<T, destroyer<Destroy>>;

/* Calls a caller's function: its exception is rethrown after the library's call. */
template <class Function> struct guarded {
    Function &function;
    std::exception_ptr thrown{};

    template <class... Arguments> aur_result operator()(Arguments &&...arguments) noexcept {
        try {
            function(std::forward<Arguments>(arguments)...);
            return AUR_OK;
        } catch (...) {
            thrown = std::current_exception();
            return AUR_ERROR_CANCELLED;
        }
    }
    template <class Call> void run(Call call) {
        try {
            call();
        } catch (const error &) {
            if (thrown)
                std::rethrow_exception(thrown);
            throw;
        }
    }
};

inline void require(bool right, const char *message) {
    if (!right) {
        aur_error found{};
        aur_fail(&found, AUR_ERROR_CAPACITY, "%s", message);
        throw error(found);
    }
}

} // namespace detail

/* An option struct with its defaults: options<aur_weights_options>(aur_weights_options_init), followed by the
 * function's arguments before the struct. */
template <class Options, class Init, class... Inputs> Options options(Init init, Inputs... inputs) {
    Options filled{};
    filled.size = sizeof filled;
    detail::call(init, inputs..., &filled);
    return filled;
}

/* A prepared set of the unit cube (aur_pointset). */
class point_set {
  public:
    point_set(const std::string &set, const aur_pointset_options &options) {
        aur_pointset *created = nullptr;
        detail::call(aur_pointset_create, set.c_str(), &options, &created);
        owned_.reset(created);
    }
    point_set(const std::string &set, std::uint64_t count)
        : point_set(set, aureole::options<aur_pointset_options>(aur_pointset_options_init, count)) {
    }

    std::uint64_t size() const noexcept {
        return aur_pointset_size(owned_.get());
    }
    std::size_t dimension() const noexcept {
        return aur_pointset_dimension(owned_.get());
    }
    /* Fills the span with points from `first` on. */
    void fill(std::uint64_t first, span<double> points) const {
        detail::call(aur_pointset_points, owned_.get(), first, points.size() / dimension(), points.size(),
                     points.data());
    }
    std::vector<double> points() const {
        std::vector<double> all(static_cast<std::size_t>(size()) * dimension());
        fill(0, all);
        return all;
    }
    const aur_pointset *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_pointset, aur_pointset_destroy> owned_;
};

/* A prepared set of directions (aur_directions). */
class directions {
  public:
    directions(const std::string &set, const aur_directions_options &options) {
        aur_directions *created = nullptr;
        detail::call(aur_directions_create, set.c_str(), &options, &created);
        owned_.reset(created);
    }
    directions(const std::string &set, std::uint64_t count, aur_domain domain)
        : directions(set,
                     aureole::options<aur_directions_options>(aur_directions_options_init, count, domain)) {
    }

    std::uint64_t size() const noexcept {
        return aur_directions_size(owned_.get());
    }
    /* Fills the span with unit vectors from `first` on, three numbers each; and the weights unless empty. */
    void fill(std::uint64_t first, span<double> xyz, span<double> weights = {}) const {
        const std::size_t count = xyz.size() / 3;
        detail::require(weights.empty() || weights.size() >= count,
                        "there are fewer weights than directions");
        detail::call(aur_directions_points, owned_.get(), first, count, xyz.size(), xyz.data(),
                     weights.empty() ? nullptr : weights.data());
    }
    std::vector<double> vectors() const {
        std::vector<double> xyz(3 * static_cast<std::size_t>(size()));
        fill(0, xyz);
        return xyz;
    }
    const aur_directions *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_directions, aur_directions_destroy> owned_;
};

/* Points that the library computed or read (aur_points). */
class points {
  public:
    points(const std::string &set, const aur_points_request &request) {
        aur_points *created = nullptr;
        detail::call(aur_points_generate, set.c_str(), &request, &created);
        owned_.reset(created);
    }
    points(const std::string &set, const aur_directions_options &options)
        : points(set, aureole::options<aur_points_request>(aur_points_request_init, &options)) {
    }
    static points read(const std::string &path) {
        aur_points *created = nullptr;
        detail::call(aur_points_read, path.c_str(), nullptr, &created);
        return points(created);
    }

    const aur_points_view &view() const noexcept {
        return *aur_points_get_view(owned_.get());
    }
    std::size_t size() const noexcept {
        return view().count;
    }
    span<const double> coordinates() const noexcept {
        return {view().coordinates, view().count * view().stride};
    }
    /* Empty if all are equal. */
    span<const double> weights() const noexcept {
        return {view().weights, view().weights != nullptr ? view().count : 0};
    }

  private:
    explicit points(aur_points *created) : owned_(created) {
    }
    detail::owner<aur_points, aur_points_destroy> owned_;
};

/* The caller's coordinates as a view for measures; `coordinates` must outlive it. */
inline aur_points_view view_of(aur_domain domain, std::size_t dimension, span<const double> coordinates) {
    return aur_points_view_of(domain, coordinates.size() / dimension, dimension, coordinates.data());
}

inline double measure(
    const std::string &metric, const aur_points_view &view,
    const aur_measure_options &options = aureole::options<aur_measure_options>(aur_measure_options_init)) {
    double value = 0.0;
    detail::call(aur_measure, metric.c_str(), &view, &options, &value);
    return value;
}

/* A density for integrands of one smoothness (aur_potential). */
class potential {
  public:
    explicit potential(const aur_density &density, double smoothness = 0.0) {
        aur_potential *created = nullptr;
        detail::call(aur_potential_create, &density, smoothness, &created);
        owned_.reset(created);
    }
    double mass() const noexcept {
        return aur_potential_mass(owned_.get());
    }
    const aur_potential *get() const noexcept {
        return owned_.get();
    }

  private:
    detail::owner<aur_potential, aur_potential_destroy> owned_;
};

/* `weights` empty: 1/N. */
inline double worst_case_error(span<const double> xyz, const potential &of, span<const double> weights = {},
                               const aur_worst_case_options &options =
                                   aureole::options<aur_worst_case_options>(aur_worst_case_options_init)) {
    detail::require(weights.empty() || weights.size() == xyz.size() / 3,
                    "there are not as many weights as directions");
    double value = 0.0;
    detail::call(aur_worst_case_error, xyz.size() / 3, xyz.data(), weights.empty() ? nullptr : weights.data(),
                 of.get(), &options, &value);
    return value;
}

/* The optimal weights of unit vectors for one density. */
inline std::vector<double> optimal_weights(
    span<const double> xyz, const potential &of,
    const aur_weights_options &options = aureole::options<aur_weights_options>(aur_weights_options_init)) {
    std::vector<double> weights(xyz.size() / 3);
    const aur_potential *const one = of.get();
    detail::call(aur_weights_solve, weights.size(), xyz.data(), std::size_t{1}, &one, &options,
                 weights.size(), weights.data(), nullptr, nullptr);
    return weights;
}

/* The integral of function(span<const double> points, span<const double> along, span<double> values), which
 * fills options.values values per point; `along` is empty without an axis. `results`, unless null, becomes
 * the value and interval of each. Exceptions of the function are rethrown. */
template <class Function>
aur_integral integrate(Function &&function, const aur_integrate_options &options,
                       std::vector<aur_estimated> *results = nullptr) {
    struct context {
        detail::guarded<Function> guard;
        std::size_t coordinates, values;
    } work{{function}, aur_integrate_coordinates(&options), options.values > 0 ? options.values : 1};
    aur_integral found{};
    found.size = sizeof found;
    if (results != nullptr)
        results->resize(work.values);
    const aur_integrand integrand = [](void *user, size_t count, const double *points, const double *along,
                                       double *values, aur_error *) {
        context &c = *static_cast<context *>(user);
        return c.guard(span<const double>(points, c.coordinates * count),
                       span<const double>(along, along != nullptr ? count : 0),
                       span<double>(values, c.values * count));
    };
    work.guard.run([&] {
        detail::call(aur_integrate_values, integrand, static_cast<void *>(&work), &options,
                     results != nullptr ? results->data() : nullptr, &found);
    });
    return found;
}

/* Nearest neighbours among points (aur_nearest). */
class nearest {
  public:
    explicit nearest(const aur_points_view &view) {
        aur_nearest *created = nullptr;
        detail::call(aur_nearest_create, &view, &created);
        owned_.reset(created);
    }
    /* The indices of options.neighbours points per query, nearest first. */
    std::vector<std::size_t> find(span<const double> queries, std::size_t dimension,
                                  const aur_nearest_options &options =
                                      aureole::options<aur_nearest_options>(aur_nearest_options_init)) const {
        const std::size_t count = queries.size() / dimension;
        std::vector<std::size_t> indices(count * (options.neighbours != 0 ? options.neighbours : 1));
        detail::call(aur_nearest_find, owned_.get(), &options, count, queries.data(), indices.data(),
                     nullptr);
        return indices;
    }

  private:
    detail::owner<aur_nearest, aur_nearest_destroy> owned_;
};

} // namespace aureole

#endif
