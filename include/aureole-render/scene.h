/* Scenes: Mitsuba 3 XML, and models in other forms, loaded into shapes, materials, lights and a camera.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_SCENE_H
#define AUREOLE_SCENE_H

#include <aureole/core.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Immutable once loaded; any number of threads may render it and ask it. It must outlive its renderers. */
typedef struct aur_scene aur_scene;

/* One `-D name=value`. */
typedef struct aur_definition {
    const char *name;
    const char *value;
} aur_definition;

/* Whether a model that is the whole scene is lit by the environment "studio" (aur_scene_stage). */
typedef enum aur_model_light {
    AUR_MODEL_LIGHT_AUTO,   /* added unless the model has a light source that is no emitting surface */
    AUR_MODEL_LIGHT_ALWAYS, /* added to what the model has */
    AUR_MODEL_LIGHT_NONE    /* never added */
} aur_model_light;

enum { AUR_MODEL_LIGHT_COUNT = AUR_MODEL_LIGHT_NONE + 1 };

/* "auto", "always", "none" to the value and back. Errors: NAME, *light untouched; the name of a value out of
 * range is NULL. */
AUR_EXPERIMENTAL aur_result aur_model_light_from_name(const char *name, aur_model_light *light,
                                                      aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL const char *aur_model_light_name(aur_model_light light);

/* Daylight that is added to a scene: the emitter `sky`, and for perez the emitter `sun`. */
typedef struct aur_scene_sky {
    /* "uniform", "cie-overcast", "cie-clear" (type 12), "cie:N" with N from 1 to 15, or "perez:DNI,DHI" in
     * W/m2. NULL: none. All but the first two need `date` and `location`. */
    const char *model;
    const char *date;     /* "YYYY-MM-DDTHH:MM", by the clock of the time zone */
    const char *location; /* "LATITUDE,LONGITUDE,TIMEZONE": degrees north, degrees east, hours ahead of UTC */
    double illuminance;   /* of the sky on the horizontal plane, lux at 179 lm/W; 0: 10,000; not for perez */
    double ground_albedo; /* what is below the horizon reflects so much of it */
    double up[3],
        north[3]; /* 0 0 0: +z and +y where a file of Radiance's is among the scene's, else +y, -z */
    bool alone;   /* the scene's own lights are left out */
} aur_scene_sky;

/* A measured lamp that is added to a scene: the emitter `photometric`. */
typedef struct aur_scene_lamp {
    const char *file;   /* IES (LM-63) or EULUMDAT */
    double position[3]; /* of the middle of its opening */
    double aim[3];      /* where it points (gamma 0), of any length; 0 0 0: down */
    double turn;        /* degrees about that direction; 0: C 0 lies along +x where it points down */
} aur_scene_lamp;

/* Moves all that one file of a scene has: it is scaled, turned about the upward axis and shifted, in this
 * order. */
typedef struct aur_scene_placement {
    size_t file;        /* 0: the scene's own; i: `further` file i, counted from 1 */
    double position[3]; /* the shift, scene units */
    double turn;        /* degrees, counter-clockwise seen from above */
    double scale;       /* above 0; 0 stands for 1 */
} aur_scene_placement;

/* What models stand on: a surface that shows their shadows, at the height of their lowest point. */
typedef enum aur_scene_ground {
    AUR_SCENE_GROUND_AUTO, /* there is one in the environments "studio" and "sky" */
    AUR_SCENE_GROUND_SHADOW,
    AUR_SCENE_GROUND_NONE
} aur_scene_ground;

enum { AUR_SCENE_GROUND_COUNT = AUR_SCENE_GROUND_NONE + 1 };

/* Which axis of the scene points up. */
typedef enum aur_scene_up {
    AUR_SCENE_UP_AUTO, /* +z for a scene that is an .stl, and with Radiance's files; else +y */
    AUR_SCENE_UP_Y,
    AUR_SCENE_UP_Z
} aur_scene_up;

enum { AUR_SCENE_UP_COUNT = AUR_SCENE_UP_Z + 1 };

/* How a scene is seen and lit, in place of what its files say. All zero keeps the scene as it is; a model
 * without a camera or light source gets the camera "corner" and the environment "studio". */
typedef struct aur_scene_stage {
    /* Views that show all of the scene as large as the image allows: "front" (from +z, or -y where +z is up),
     * "back", "left", "right", "top", "bottom", "corner" (26.6 degrees to the right of the front and 17.4
     * above it), "iso" (45 and 35.3), or "AZIMUTH,ELEVATION" in degrees. "X,Y,Z,X,Y,Z" is a camera at the
     * first point that looks at the second; a seventh number is the field of view across the height, degrees.
     * NULL: the camera of the scene. */
    const char *camera;
    /* "studio": light boxes around the front of the camera, before a plain background; "sky" or
     * "sky:TURBIDITY" (1 to 10): sun and clear sky (Hosek and Wilkie 2012), scaled so that white is about 1;
     * "none"; else the path of an image of radiance in latitude and longitude. It replaces environments and
     * other light sources at infinity; NULL keeps them. */
    const char *environment;
    aur_scene_ground ground;
    bool has_time; /* that of models which assimp reads: where their first animation has nodes and skins */
    double time;   /* seconds */
    bool has_background;
    double background[3]; /* radiance, RGB, of what the camera sees where there is no surface */
    double aspect;        /* width over height of the image that is framed; 0: the film's */
    size_t placement_count;
    const aur_scene_placement *placements;
    aur_scene_up up;     /* for views, environments, the ground and placements; no file is turned */
    const char *variant; /* of the materials of glTF models (KHR_materials_variants); NULL: none */
} aur_scene_stage;

/* All zero but `size`, as aur_scene_options_init fills it, takes the scene as it stands. */
typedef struct aur_scene_options {
    size_t size; /* of the caller's struct, so that it can grow */
    size_t definition_count;
    const aur_definition
        *definitions;      /* they override <default> values of the scene; an unused one is an error */
    aur_warnings warnings; /* legacy parameters and the like */
    bool confine; /* no file is read that lies outside of the scene's folder, by whatever name or link */
    /* Paths of more files of the scene, read in this order as if it included them at its end, of any kind.
     * Materials of a file of Radiance's are known in those after it, as by oconv. */
    size_t further_count;
    const char *const *further;
    /* Threads that build the acceleration structure of scenes with a million primitives or more (smaller
     * ones use one thread). 0: all processors. The result does not depend on it. */
    size_t threads;
    aur_model_light model_light;
    /* Asked, while a model is read, whether to stop. Those that assimp reads are read by a process of their
     * own (AUR_ERROR_CANCELLED ends it), so that files which crash or hang their reader are errors. */
    aur_progress progress;
    /* Patterns, textures and materials of Radiance's files that are not read become what they have that is
     * diffuse, where that is known; a warning counts them. Else a surface that uses one is an error. */
    bool diffuse;
    aur_scene_sky sky;
    size_t lamp_count;
    const aur_scene_lamp *lamps;
    aur_scene_stage stage;
    /* Bytes of bitmap textures that are in memory at a time, at least 4 MiB; the rest lies in a file without
     * a name in TMPDIR or /var/tmp. 0: all are in memory. The result does not depend on it. */
    size_t texture_memory;
} aur_scene_options;

AUR_EXPERIMENTAL aur_result aur_scene_options_init(aur_scene_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Whether a file is a scene by the end of its name: Radiance's (.rad, .mat, .sky), which aur_scene_load tells
 * by their content too, and models: .obj, .ply, .stl, .off, and .glb, .gltf, .fbx, .dae and .3ds, which a
 * build with assimp reads. */
AUR_EXPERIMENTAL bool aur_scene_is_name(const char *path) AUR_NONNULL(1);

/* Reads a scene and all files that it names: includes, meshes, images and point sets. Relative names are
 * looked for beside the file that has them, beside the scene, in the folders of <path>, and in the folder of
 * the process; only regular files are read, and none is written but that of `texture_memory`. `options` may
 * be NULL. Errors carry file, line and column: OPEN (a file is not there, is no regular file, or lies where
 * `confine` does not let it), FORMAT (what is written cannot be meant), NAME (an unknown element, plugin,
 * parameter or definition; the message suggests the nearest), UNSUPPORTED (Mitsuba has it, Aureole has not),
 * ARGUMENT (`options`), MEMORY.
 */
AUR_EXPERIMENTAL aur_result aur_scene_load(const char *path, const aur_scene_options *options,
                                           aur_scene **scene, aur_error *error) AUR_NONNULL(1, 3);
/* The same from the `bytes` bytes of a scene file in memory. `name` stands for its path: in messages, and as
 * the place beside which files are looked for. */
AUR_EXPERIMENTAL aur_result aur_scene_load_memory(const char *name, size_t bytes, const void *data,
                                                  const aur_scene_options *options, aur_scene **scene,
                                                  aur_error *error) AUR_NONNULL(1, 3, 5);
/* Moves the camera about the middle of the scene: by `azimuth` to the right and `elevation` up, degrees, to
 * `distance` times its distance; never through the poles or below the ground of the stage. Not while a
 * renderer of the scene lives, whose caches may be of the camera before. Errors: ARGUMENT for numbers that
 * are not finite, a distance that is not above 0, and cameras that cannot turn (a batch). */
AUR_EXPERIMENTAL aur_result aur_scene_turn(aur_scene *scene, double azimuth, double elevation,
                                           double distance, aur_error *error) AUR_NONNULL(1);
/* Not while a renderer of the scene lives. */
AUR_EXPERIMENTAL void aur_scene_destroy(aur_scene *scene); /* NULL is allowed */

/* What is in a scene, for people and for `aureole info`. `size` is set by the caller to that of the struct.
 */
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

/* What clip planes hide of the surfaces before the camera, by rays spread evenly over its image. `size` is
 * set by the caller to that of the struct. */
typedef struct aur_clip_description {
    size_t size;
    size_t rays;
    size_t seen;                /* of them, those that meet a surface between the planes */
    size_t too_near;            /* that meet one before near_clip alone */
    size_t too_far;             /* that meet the first one beyond far_clip */
    double near_clip, far_clip; /* depths, of the first camera of a batch */
} aur_clip_description;

/* Errors: ARGUMENT when `size` is not set, FORMAT when the scene has no camera. */
AUR_EXPERIMENTAL aur_result aur_scene_get_clips(const aur_scene *scene, aur_clip_description *description,
                                                aur_error *error) AUR_NONNULL(1, 2);

#ifdef __cplusplus
}
#endif

#endif
