/* Scenes: Mitsuba 3 XML, and models in other formats, loaded into shapes, materials, lights and a camera.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_SCENE_H
#define AUREOLE_SCENE_H

#include <aureole/core.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Immutable once loaded; any number of threads may render and query it. It must outlive its renderers. */
typedef struct aur_scene aur_scene;

/* Definition of a scene variable, as by `-D name=value`. */
typedef struct aur_definition {
    const char *name;
    const char *value;
} aur_definition;

/* Whether a model used as scene is lit by the environment "studio" (aur_scene_stage). */
typedef enum aur_model_light {
    AUR_MODEL_LIGHT_AUTO,   /* added unless the model has a light source other than emitting surfaces */
    AUR_MODEL_LIGHT_ALWAYS, /* added to the model's light sources */
    AUR_MODEL_LIGHT_NONE    /* never added */
} aur_model_light;

enum { AUR_MODEL_LIGHT_COUNT = AUR_MODEL_LIGHT_NONE + 1 };

/* Converts between value and name ("auto", "always", "none"). Errors: NAME, with *light unchanged. The name
 * of a value out of range is NULL. */
AUR_EXPERIMENTAL aur_result aur_model_light_from_name(const char *name, aur_model_light *light,
                                                      aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL const char *aur_model_light_name(aur_model_light light);

/* Daylight added to a scene: the emitter `sky`, and for perez the emitter `sun`. */
typedef struct aur_scene_sky {
    /* "uniform", "cie-overcast", "cie-clear" (type 12), "cie:N" with N from 1 to 15, or "perez:DNI,DHI" in
     * W/m2. NULL: none. All but the first two need `date` and `location`. */
    const char *model;
    const char *date;     /* "YYYY-MM-DDTHH:MM", in the time zone of `location` */
    const char *location; /* "LATITUDE,LONGITUDE,TIMEZONE": degrees north, degrees east, hours ahead of UTC */
    double illuminance;   /* of the sky on the horizontal plane, lux at 179 lm/W; 0: 10,000; not for perez */
    double ground_albedo; /* fraction of it reflected by the ground below the horizon */
    double up[3], north[3]; /* 0 0 0: +z and +y for scenes with Radiance files, else +y, -z */
    bool alone;             /* the scene's other lights are removed */
} aur_scene_sky;

/* A photometric luminaire added to a scene: the emitter `photometric`. */
typedef struct aur_scene_luminaire {
    const char *file;   /* IES (LM-63) or EULUMDAT */
    double position[3]; /* centre of its opening */
    double aim[3];      /* direction of gamma 0, of any length; 0 0 0: down */
    double turn;        /* degrees about that direction; 0: C 0 lies along +x where it points down */
} aur_scene_luminaire;

/* Transforms the content of one file of a scene: scaled, rotated about the upward axis and translated, in
 * this order. */
typedef struct aur_scene_placement {
    size_t file;        /* 0: the scene's main file; i: `further` file i, counted from 1 */
    double position[3]; /* translation, scene units */
    double turn;        /* degrees, counter-clockwise seen from above */
    double scale;       /* above 0; 0: default 1 */
} aur_scene_placement;

/* Ground below a model: a surface that shows shadows, at the height of the lowest point. */
typedef enum aur_scene_ground {
    AUR_SCENE_GROUND_AUTO, /* shadow with the environments "studio" and "sky", else none */
    AUR_SCENE_GROUND_SHADOW,
    AUR_SCENE_GROUND_NONE
} aur_scene_ground;

enum { AUR_SCENE_GROUND_COUNT = AUR_SCENE_GROUND_NONE + 1 };

/* Which axis of the scene points up. */
typedef enum aur_scene_up {
    AUR_SCENE_UP_AUTO, /* +z for .stl scenes and with Radiance files, else +y */
    AUR_SCENE_UP_Y,
    AUR_SCENE_UP_Z
} aur_scene_up;

enum { AUR_SCENE_UP_COUNT = AUR_SCENE_UP_Z + 1 };

/* Camera and lighting that replace those of the scene's files. All zero leaves the scene unchanged, except
 * that a model without a camera or light source gets the camera "corner" and the environment "studio". */
typedef struct aur_scene_stage {
    /* Views that fit the scene to the image: "front" (from +z, or -y where +z is up),
     * "back", "left", "right", "top", "bottom", "corner" (26.6 degrees to the right of the front and 17.4
     * above it), "iso" (45 and 35.3), or "AZIMUTH,ELEVATION" in degrees. "X,Y,Z,X,Y,Z" is a camera at the
     * first point that looks at the second; a seventh number is the vertical field of view in degrees.
     * "-vp X Y Z -vd X Y Z ...": a view in the options of Radiance's rpict (-vtv only) with its own film,
     * which replaces the scene's sensors. NULL: the camera of the scene. */
    const char *camera;
    /* "studio": light boxes around the camera, with a plain background; "sky" or
     * "sky:TURBIDITY" (1 to 10): sun and clear sky (Hosek and Wilkie 2012), scaled so that white is about 1;
     * "none"; else the path of a latitude-longitude radiance image. It replaces environments and other light
     * sources at infinity; NULL keeps them. */
    const char *environment;
    aur_scene_ground ground;
    bool has_time; /* for models read by assimp: pose nodes and skins by the first animation at `time` */
    double time;   /* seconds */
    bool has_background;
    double background[3]; /* RGB radiance seen by the camera where there is no surface */
    double aspect;        /* width over height of the image, for views; 0: the film's */
    size_t placement_count;
    const aur_scene_placement *placements;
    aur_scene_up up;     /* for views, environments, the ground and placements; files are not rotated */
    const char *variant; /* material variant of glTF models (KHR_materials_variants); NULL: none */
} aur_scene_stage;

/* Defaults (aur_scene_options_init: all zero but `size`) load the scene unchanged. */
typedef struct aur_scene_options {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t definition_count;
    const aur_definition
        *definitions;      /* they override <default> values of the scene; an unused one is an error */
    aur_warnings warnings; /* legacy parameters and the like */
    bool confine;          /* read only files in the scene's folder, after resolving names and links */
    /* Paths of more files of the scene, of any format, read in this order as if included at its end. Later
     * Radiance files can use materials of earlier ones, as with oconv. */
    size_t further_count;
    const char *const *further;
    /* Threads that build the acceleration structure of scenes with a million primitives or more (smaller
     * ones use one thread). 0: all processors. The result does not depend on it. */
    size_t threads;
    aur_model_light model_light;
    /* Called while a model is read; it may cancel (AUR_ERROR_CANCELLED). Models for assimp are read in a
     * separate process, so that files which crash or hang the reader are errors. */
    aur_progress progress;
    /* Replace unsupported patterns, textures and materials of Radiance files by their diffuse parts, if these
     * can be determined; a warning gives their number. If false, surfaces that use them are errors. */
    bool diffuse;
    aur_scene_sky sky;
    size_t luminaire_count;
    const aur_scene_luminaire *luminaires;
    aur_scene_stage stage;
    /* Limit of bitmap textures in memory, in bytes, at least 4 MiB; the rest is in an unnamed file in TMPDIR
     * or /var/tmp. 0: all in memory. The result does not depend on it. */
    size_t texture_memory;
    /* Only light sources of this material of Radiance's files emit; the others of such files are black. NULL:
     * all. An error (NAME) if there is none. */
    const char *light_modifier;
} aur_scene_options;

AUR_EXPERIMENTAL aur_result aur_scene_options_init(aur_scene_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Whether the extension is that of a Radiance file (.rad, .mat, .sky) or a model: .obj, .ply, .stl, .off,
 * and, in a build with assimp, .glb, .gltf, .fbx, .dae and .3ds. aur_scene_load recognises Radiance files by
 * content too. */
AUR_EXPERIMENTAL bool aur_scene_is_name(const char *path) AUR_NONNULL(1);

/* Reads a scene and all files that it references: includes, meshes, images and point sets. Relative names are
 * searched in the folder of the referencing file, that of the scene, those of <path>, and the working folder.
 * Only regular files are read, and only that of `texture_memory` is written. `options` may be NULL. Errors
 * have file, line and column: OPEN (a file does not exist, is not regular, or is excluded by `confine`),
 * FORMAT (invalid content), NAME (an unknown element, plugin, parameter or definition; the message suggests
 * the nearest), UNSUPPORTED (a feature of Mitsuba that Aureole lacks), ARGUMENT (`options`), MEMORY. */
AUR_EXPERIMENTAL aur_result aur_scene_load(const char *path, const aur_scene_options *options,
                                           aur_scene **scene, aur_error *error) AUR_NONNULL(1, 3);
/* The same from the `bytes` bytes of a scene file in memory. `name` replaces its path in messages and in
 * the search for referenced files. */
AUR_EXPERIMENTAL aur_result aur_scene_load_memory(const char *name, size_t bytes, const void *data,
                                                  const aur_scene_options *options, aur_scene **scene,
                                                  aur_error *error) AUR_NONNULL(1, 3, 5);
/* Orbits the camera about the centre of the scene: by `azimuth` to the right and `elevation` up, in degrees,
 * to `distance` times its distance; never through the poles or below the ground of the stage. Must not be
 * called while a renderer of the scene exists, as its caches may depend on the camera. Errors: ARGUMENT for
 * numbers that are not finite, a distance that is not above 0, and a batch of cameras. */
AUR_EXPERIMENTAL aur_result aur_scene_turn(aur_scene *scene, double azimuth, double elevation,
                                           double distance, aur_error *error) AUR_NONNULL(1);
/* Must not be called while a renderer of the scene exists. */
AUR_EXPERIMENTAL void aur_scene_destroy(aur_scene *scene); /* NULL is allowed */

/* Summary of a scene, as printed by `aureole info`. The caller sets `size` to the size of the struct. */
typedef struct aur_scene_description {
    size_t size;
    size_t shapes, triangles, emitters, materials;
    size_t width, height, samples_per_pixel;
    double lower[3], upper[3]; /* bounding box, scene units */
    const char *integrator;    /* owned by the scene */
    const char *sampler;       /* SET syntax, owned by the scene */
    const char *filter;        /* static storage */
} aur_scene_description;

/* Errors: ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_scene_get_description(const aur_scene *scene,
                                                      aur_scene_description *description, aur_error *error)
    AUR_NONNULL(1, 2);

/* A photometric file (IES LM-63 or EULUMDAT); the caller sets `size` to that of the struct. */
typedef struct aur_luminaire_description {
    size_t size;
    const char *format;    /* "IES LM-63", "EULUMDAT" */
    const char *type;      /* of the goniometer: "A", "B" or "C" */
    const char *symmetry;  /* "rotational", "quadrants", "plane C 0-180", "plane C 90-270", "vertical plane"
                            * (types A and B) or "none" */
    size_t planes, angles; /* stored in the file */
    double lumens;         /* integral of the intensities over all directions */
    double lamp_lumens;    /* of the lamps, as stated; 0: absolute photometry */
    double peak;           /* largest intensity, candela */
    double length, width;  /* of the luminous opening, along C 0 and C 90, metres */
    double height;         /* metres */
    bool round;            /* the opening is an ellipse */
} aur_luminaire_description;

/* Reads `bytes` bytes of `data`, or the file `path` if data is NULL; `path` is also for messages. Errors:
 * OPEN, MEMORY, FORMAT with the line, ARGUMENT (size). */
AUR_EXPERIMENTAL aur_result aur_luminaire_describe(const char *path, size_t bytes, const void *data,
                                                   aur_luminaire_description *description, aur_error *error)
    AUR_NONNULL(1, 4);

/* Effect of the clip planes, from camera rays distributed evenly over the image. The caller sets `size` to
 * the size of the struct. */
typedef struct aur_clip_description {
    size_t size;
    size_t rays;
    size_t seen;                /* rays that hit a surface between the planes */
    size_t too_near;            /* rays that hit surfaces only before near_clip */
    size_t too_far;             /* rays whose first hit is beyond far_clip */
    double near_clip, far_clip; /* depths, of the first camera of a batch */
} aur_clip_description;

/* Errors: ARGUMENT when `size` is not set, FORMAT when the scene has no camera. */
AUR_EXPERIMENTAL aur_result aur_scene_get_clips(const aur_scene *scene, aur_clip_description *description,
                                                aur_error *error) AUR_NONNULL(1, 2);

#ifdef __cplusplus
}
#endif

#endif
