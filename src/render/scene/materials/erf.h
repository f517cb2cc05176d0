/* The inverse of the error function, for drawing from Gaussians. */
#pragma once

/* x with erf(x) = y for -1 < y < 1, to a few parts in 10^7 (Giles 2012, "Approximating the erfinv function",
 * single precision). */
float aur_inverse_erf(float y);
