// Every public header compiles as C++, alone and together.
#include <aureole-lighting/daylight.h>
#include <aureole-lighting/irradiance.h>
#include <aureole-lighting/view_factors.h>
#include <aureole-render/adaptive.h>
#include <aureole-render/film.h>
#include <aureole-render/gather.h>
#include <aureole-render/image.h>
#include <aureole-render/radiosity.h>
#include <aureole-render/render.h>
#include <aureole-render/scene.h>
#include <aureole/core.h>
#include <aureole/estimate.h>
#include <aureole/exact.h>
#include <aureole/integrate.h>
#include <aureole/nearest.h>
#include <aureole/pointset.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <aureole/ranks.h>
#include <aureole/rotations.h>
#include <aureole/sphere.h>
#include <aureole/statistics.h>
#include <aureole/symmetry.h>
#include <aureole/tables.h>
#include <aureole/text.h>
#include <aureole/version.h>

extern const char *aureole_headers_compile_as_cxx();

const char *aureole_headers_compile_as_cxx() {
    return aur_version();
}
