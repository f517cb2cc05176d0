/* The GGX lobe of visible normals: what lobe.c dispatches to. */
#pragma once

#include <aureole/sphere.h>

void aur_ggx_warp(const aur_lobe *lobe, const double uniform[3], double direction[3]);
void aur_ggx_unwarp(const aur_lobe *lobe, const double direction[3], double uniform[3]);
double aur_ggx_pdf(const aur_lobe *lobe, const double direction[3]);
