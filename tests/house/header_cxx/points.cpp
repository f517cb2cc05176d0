// aureole.hpp: owners, spans, exceptions; the numbers are those of the C functions.
#include <aureole/aureole.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>

static int failures;

static void require(bool right, const char *what) {
    if (!right) {
        ++failures;
        std::printf("%s\n", what);
    }
}

template <class Function> static aur_result thrown(Function function) {
    try {
        function();
    } catch (const aureole::error &error) {
        require(std::strstr(error.what(), error.message()) != nullptr, "what() without the message");
        return error.result();
    }
    return AUR_OK;
}

int main() {
    using namespace aureole;
    point_set sobol("sobol", 64);
    const point_set moved = std::move(sobol);
    require(moved.size() == 64 && moved.dimension() == 2 && moved.points()[3] == 0.5, "a set of the square");
    double pair[2];
    moved.fill(1, pair);
    require(pair[0] == 0.5 && pair[1] == 0.5, "a part of a set");
    require(thrown([] { point_set("sobel", 4); }) == AUR_ERROR_NAME, "an unknown name");
    require(thrown([&] { moved.fill(64, pair); }) == AUR_ERROR_ARGUMENT, "beyond the set");

    const directions even("spherical-fibonacci", 128, AUR_DOMAIN_SPHERE);
    const std::vector<double> xyz = even.vectors();
    std::vector<double> weights(128);
    even.fill(0, span<double>(pair, 0), weights);
    std::vector<double> part(3 * 128);
    even.fill(0, part, weights);
    require(part == xyz && weights[7] == 1.0 / 128, "directions and weights");
    require(thrown([&] { even.fill(0, part, span<double>(pair, 2)); }) == AUR_ERROR_CAPACITY,
            "too few weights");

    aur_directions_options options =
        aureole::options<aur_directions_options>(aur_directions_options_init, 128, AUR_DOMAIN_SPHERE);
    const points generated("spherical-fibonacci", options);
    require(generated.size() == 128 && generated.weights().empty() && generated.coordinates()[5] == xyz[5],
            "points");
    require(measure("energy", generated.view()) == measure("energy", view_of(AUR_DOMAIN_SPHERE, 3, xyz)),
            "measures");
    require(thrown([] { points::read("nowhere.csv"); }) == AUR_ERROR_OPEN, "a file that is not there");

    aur_density density = aureole::options<aur_density>(aur_density_init);
    density.kind = AUR_DENSITY_SPHERE;
    const potential whole(density, 1.5);
    const std::vector<double> optimal = optimal_weights(xyz, whole);
    require(std::fabs(whole.mass() - 4.0 * 3.14159265358979323846) < 1e-12, "the mass of the sphere");
    require(worst_case_error(xyz, whole, optimal) < worst_case_error(xyz, whole),
            "optimal weights are better");

    aur_integrate_options tolerance =
        aureole::options<aur_integrate_options>(aur_integrate_options_init, AUR_DOMAIN_SPHERE);
    tolerance.relative = 1e-3;
    double largest = 0.0;
    const aur_integral found = integrate(
        [&](span<const double> u, span<const double> along, span<double> values) {
            require(along.empty(), "an axis that was not asked for");
            for (std::size_t i = 0; i < values.size(); ++i) {
                values[i] = u[3 * i + 2] * u[3 * i + 2];
                largest = std::fmax(largest, values[i]);
            }
        },
        tolerance);
    require(std::fabs(found.value - 4.18879020478639) < 3e-3 * found.value && largest > 0.9, "an integral");
    aur_integrate_options square =
        aureole::options<aur_integrate_options>(aur_integrate_options_init, AUR_DOMAIN_SQUARE);
    square.values = 2;
    std::vector<aur_estimated> both;
    integrate(
        [](span<const double> x, span<const double>, span<double> values) {
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = i % 2 == 0 ? x[i] : x[i] * x[i];
        },
        square, &both);
    require(both.size() == 2 && std::fabs(both[0].value - 0.5) < 0.01 &&
                std::fabs(both[1].value - 1.0 / 3.0) < 0.01,
            "integrals of two values");
    bool passed = false;
    try {
        integrate(
            [](span<const double>, span<const double>, span<double>) { throw std::runtime_error("mine"); },
            tolerance);
    } catch (const std::runtime_error &error) {
        passed = std::strcmp(error.what(), "mine") == 0;
    }
    require(passed, "what a function throws goes through the library");

    const nearest tree(generated.view());
    require(tree.find(span<const double>(xyz.data() + 30, 3), 3)[0] == 10, "the nearest point of a point");
    return failures != 0;
}
