/* Lumens a watt of the sky and the sun: Perez, Ineichen, Seals, Michalsky and Stewart (1990), Solar Energy
 * 44(5), 271-289, equations (7) and (8) with the coefficients of table 4, where `water` is in cm. */
#pragma once

#include "render/scene/lights/sky_model.h"

double aur_efficacy_of_sky(const aur_perez_conditions *conditions, double water);
double aur_efficacy_of_sun(const aur_perez_conditions *conditions, double water);

/* Water in the air, in cm, by the dew point in degrees Celsius (their equation (3)); 2 where that is NaN. */
double aur_precipitable_water(double dew_point);
