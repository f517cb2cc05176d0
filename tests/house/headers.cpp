// Every public header compiles as C++, alone and together.
#include <aureole/core.h>
#include <aureole/estimate.h>
#include <aureole/exact.h>
#include <aureole/film.h>
#include <aureole/gather.h>
#include <aureole/image.h>
#include <aureole/integrate.h>
#include <aureole/irradiance.h>
#include <aureole/nearest.h>
#include <aureole/pointset.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <aureole/radiosity.h>
#include <aureole/ranks.h>
#include <aureole/render.h>
#include <aureole/rotations.h>
#include <aureole/scene.h>
#include <aureole/sphere.h>
#include <aureole/statistics.h>
#include <aureole/tables.h>
#include <aureole/text.h>
#include <aureole/version.h>
#include <aureole/view_factors.h>

extern const char *aureole_headers_compile_as_cxx();

const char *aureole_headers_compile_as_cxx() {
    return aur_version();
}
