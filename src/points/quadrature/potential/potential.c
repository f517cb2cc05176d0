#include "points/quadrature/potential/potential.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/quadrature/check.h"

enum { NODES_DEFAULT = 4096, NODES_MOST = 1 << 24 };

static aur_result check_lobe(const aur_density *density, aur_error *error) {
    const aur_result result = aur_check_exponent(density->exponent, error);
    if (result == AUR_OK && !aur_is_unit(density->axis))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the axis (%g, %g, %g) of a lobe is not a unit vector",
                        density->axis[0], density->axis[1], density->axis[2]);
    return result;
}

static aur_result create_lobe(aur_potential *potential, aur_error *error) {
    const aur_density *const density = &potential->density;
    const aur_result result = check_lobe(density, error);
    if (result != AUR_OK)
        return result;
    potential->mass = 2.0 * AUR_PI / (density->exponent + 1.0);
    if (density->clipped) {
        if (!(density->axis[2] >= 0.0))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the axis of a clipped lobe must not point below the surface (z = %g)",
                            density->axis[2]);
        aur_lune_init(&potential->lune, density->axis, density->exponent);
        potential->mass *= 1.0 - potential->lune.fraction;
    }
    return aur_zonal_create(density->exponent, potential->rule.smoothness, &potential->zonal, error);
}

static aur_result copy_nodes(const aur_density *density, double *columns, double *masses, aur_error *error) {
    const size_t count = density->node_count;
    const aur_result result = aur_check_directions(count, density->nodes, error);
    if (result != AUR_OK)
        return result;
    aur_columns_split(count, density->nodes, columns);
    for (size_t i = 0; i < count; ++i) {
        masses[i] = density->masses[i];
        if (!(masses[i] >= 0.0 && isfinite(masses[i])))
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "the mass of node %zu is %g: it must be finite and not negative", i, masses[i]);
    }
    return AUR_OK;
}

static aur_result fill_nodes(const aur_density *density, double *columns, double *masses, aur_error *error) {
    if (density->kind == AUR_DENSITY_GGX)
        return aur_nodes_ggx(density, columns, masses, error);
    if (density->kind == AUR_DENSITY_NODES)
        return copy_nodes(density, columns, masses, error);
    const aur_result result = check_lobe(density, error);
    return result == AUR_OK ? aur_nodes_function(density, columns, masses, error) : result;
}

static aur_result create_nodes(aur_potential *potential, aur_error *error) {
    aur_density *const density = &potential->density;
    if (density->kind != AUR_DENSITY_NODES && density->node_count == 0)
        density->node_count = NODES_DEFAULT;
    const size_t count = density->node_count;
    if (count == 0 || count > NODES_MOST)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a density needs 1 to %d nodes, not %zu", NODES_MOST,
                        count);
    if (density->kind == AUR_DENSITY_FUNCTION && density->function == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a density of kind FUNCTION needs its function");
    if (density->kind == AUR_DENSITY_NODES && (density->nodes == NULL || density->masses == NULL))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a density of kind NODES needs its nodes and masses");
    double *const columns = malloc(4 * count * sizeof *columns);
    if (columns == NULL)
        return aur_fail_memory(error);
    double *const masses = columns + 3 * count;
    potential->storage = columns;
    potential->nodes = (aur_columns){columns, columns + count, columns + 2 * count};
    potential->node_masses = masses;
    const aur_result result = fill_nodes(density, columns, masses, error);
    if (result != AUR_OK)
        return result;
    density->nodes = NULL;
    density->masses = NULL;
    for (size_t i = 0; i < count; ++i)
        potential->mass += masses[i];
    if (!(potential->mass > 0.0 && isfinite(potential->mass)))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the density is zero at every node");
    for (size_t i = 0; i < count; ++i)
        masses[i] /= potential->mass;
    return AUR_OK;
}

static aur_result create(aur_potential *potential, aur_error *error) {
    switch (potential->density.kind) {
    case AUR_DENSITY_COSINE_POWER:
        return create_lobe(potential, error);
    case AUR_DENSITY_SPHERE:
        potential->mass = 4.0 * AUR_PI;
        aur_kernel_coefficients(potential->rule.smoothness, 1, &potential->zonal.self_energy);
        return AUR_OK;
    case AUR_DENSITY_GGX:
    case AUR_DENSITY_FUNCTION:
    case AUR_DENSITY_NODES:
        return create_nodes(potential, error);
    }
    return aur_fail(error, AUR_ERROR_ARGUMENT, "no such kind of density: %d", (int)potential->density.kind);
}

aur_result aur_potential_create(const aur_density *density, double smoothness, aur_potential **potential,
                                aur_error *error) {
    *potential = NULL;
    if (smoothness == 0.0)
        smoothness = 1.5;
    aur_result result = aur_check_smoothness(smoothness, error);
    if (result != AUR_OK)
        return result;
    aur_potential *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->rule = aur_kernel_rule_make(smoothness);
    aur_density *const copy = &created->density;
    result = aur_options_read(density, sizeof *copy, copy, "aur_density", error);
    if (aur_is_default_axis(copy->axis))
        copy->axis[2] = 1.0;
    if (result == AUR_OK)
        result = create(created, error);
    if (result == AUR_OK)
        *potential = created;
    else
        aur_potential_destroy(created);
    return result;
}

void aur_potential_destroy(aur_potential *potential) {
    if (potential == NULL)
        return;
    aur_zonal_release(&potential->zonal);
    free(potential->storage);
    free(potential);
}

double aur_potential_smoothness(const aur_potential *potential) {
    return potential->rule.smoothness;
}

double aur_potential_mass(const aur_potential *potential) {
    return potential->mass;
}

static void evaluate_lobe(const aur_potential *potential, size_t count, const double *xyz, double *z) {
    enum { BLOCK = 256 };
    double cosine[BLOCK];
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t size = count - first < BLOCK ? count - first : BLOCK;
        for (size_t i = 0; i < size; ++i)
            cosine[i] = aur_dot3(xyz + 3 * (first + i), potential->density.axis);
        aur_zonal_evaluate(&potential->zonal, size, cosine, z + first);
    }
    if (potential->lune.fraction <= 0.0)
        return;
    const double visible = 1.0 - potential->lune.fraction;
    for (size_t i = 0; i < count; ++i)
        z[i] = (z[i] - aur_lune_potential(&potential->lune, &potential->rule, xyz + 3 * i)) / visible;
}

void aur_potential_evaluate(const aur_potential *potential, size_t count, const double *xyz, double *z) {
    if (potential->density.kind == AUR_DENSITY_COSINE_POWER) {
        evaluate_lobe(potential, count, xyz, z);
        return;
    }
    for (size_t i = 0; i < count; ++i)
        z[i] = potential->node_masses == NULL
                   ? potential->zonal.self_energy /* for the sphere z is constant */
                   : aur_kernel_sum(&potential->rule, xyz + 3 * i, potential->density.node_count,
                                    potential->nodes, potential->node_masses);
}

static double clipped_self_energy(const aur_potential *potential) {
    double xyz[3 * AUR_LUNE_VISIBLE], weights[AUR_LUNE_VISIBLE], z[AUR_LUNE_VISIBLE];
    aur_lune_visible(&potential->lune, xyz, weights);
    aur_potential_evaluate(potential, AUR_LUNE_VISIBLE, xyz, z);
    double energy = 0.0;
    for (size_t i = 0; i < AUR_LUNE_VISIBLE; ++i)
        energy += weights[i] * z[i];
    return energy / (1.0 - potential->lune.fraction);
}

double aur_potential_self_energy(const aur_potential *potential) {
    if (potential->lune.fraction > 0.0)
        return clipped_self_energy(potential);
    if (potential->node_masses == NULL)
        return potential->zonal.self_energy;
    double energy = 0.0;
    for (size_t i = 0; i < potential->density.node_count; ++i) {
        const double point[3] = {potential->nodes.x[i], potential->nodes.y[i], potential->nodes.z[i]};
        energy +=
            potential->node_masses[i] * aur_kernel_sum(&potential->rule, point, potential->density.node_count,
                                                       potential->nodes, potential->node_masses);
    }
    return energy;
}

/* The unnormalised density, for kinds with a formula. */
static double formula(const aur_density *density, const double direction[3]) {
    if (density->kind == AUR_DENSITY_SPHERE)
        return 1.0;
    if (density->kind == AUR_DENSITY_GGX)
        return aur_ggx_value(density, direction);
    const double cosine = aur_dot3(direction, density->axis);
    const bool below = cosine <= 0.0 || (density->clipped && direction[2] < 0.0);
    return below ? 0.0 : pow(cosine, density->exponent);
}

aur_result aur_potential_density(const aur_potential *potential, size_t count, const double *xyz,
                                 double *values, aur_error *error) {
    const aur_density *const density = &potential->density;
    if (density->kind == AUR_DENSITY_NODES)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "point masses have no density");
    aur_result result = AUR_OK;
    if (density->kind == AUR_DENSITY_FUNCTION)
        result = density->function(density->user, count, xyz, values, error);
    else
        for (size_t i = 0; i < count; ++i)
            values[i] = formula(density, xyz + 3 * i);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        values[i] /= potential->mass;
    return result;
}

aur_result aur_density_from_lobe(const aur_lobe *lobe, aur_domain domain, aur_density *density,
                                 aur_error *error) {
    aur_density copy = {.size = sizeof copy};
    aur_density_init(&copy, NULL);
    const bool sphere = domain == AUR_DOMAIN_SPHERE, ggx = lobe->kind == AUR_LOBE_GGX;
    if (lobe->kind == AUR_LOBE_VISIBLE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "weights are for the light that is reflected, ggx:ALPHA:VIEW, not for visible "
                        "normals, which are for "
                        "points");
    if (sphere && (ggx || lobe->exponent != 0.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "on the sphere the lobe must be uniform: others live on the hemisphere");
    if (!sphere && domain != AUR_DOMAIN_HEMISPHERE)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "densities are on the hemisphere or the sphere: points of the square need a map first");
    copy.kind = sphere ? AUR_DENSITY_SPHERE : ggx ? AUR_DENSITY_GGX : AUR_DENSITY_COSINE_POWER;
    copy.exponent = lobe->exponent;
    copy.alpha = lobe->alpha;
    copy.view_degrees = lobe->view_degrees;
    return aur_description_write(&copy, sizeof copy, density, "aur_density", error);
}

aur_result aur_density_init(aur_density *density, aur_error *error) {
    static const aur_density defaults = {.size = sizeof defaults};
    return aur_description_write(&defaults, sizeof defaults, density, "aur_density", error);
}
