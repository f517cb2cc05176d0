/* Shapes. To add one: a file in the folder shapes, and one line in shapes/table.c. */
#pragma once

#include "render/scene/importers/meshes/mesh_data.h"
#include "render/scene/importers/xml/xml.h"
#include "render/scene/mesh.h"
#include "render/scene/patches.h"
#include "render/scene/scene.h"

typedef struct aur_shape_descriptor aur_shape_descriptor;

typedef struct aur_shape aur_shape;

/* A file from which a mesh is read (shapes/mesh_file.h). */
typedef struct aur_mesh_file aur_mesh_file;

/* A point of a shape, sampled uniformly by area. */
typedef struct aur_shape_point {
    aur_vector position, normal;
    aur_bsdf_point texture;
    float offset;   /* aur_surface_offset */
    float rounding; /* largest distance from the surface that rays intersect, as aur_triangle_rounding */
} aur_shape_point;

/* Curves with radii, such as hair. */
typedef struct aur_curves {
    size_t point_count, segment_count;
    double *positions; /* world coordinates of each control point, until the shape is recentred */
    float *points;     /* coordinates relative to the origin, and radius, of each control point */
    uint32_t *firsts;  /* first control point of each segment; 1 or 3 more follow */
    bool smooth;       /* cubic B-splines; else rounded cones between consecutive points */
} aur_curves;

/* The functions of a shape that is not a mesh. All coordinates are relative to the scene's origin. Hits have
 * primitive 0, except for curves, whose primitives are segments. */
typedef struct aur_curved {
    void (*bounds)(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]);
    /* The nearest hit with nearest < distance < farthest; `direction` may have any length. NULL for curves,
     * which Embree intersects. */
    bool (*intersect)(const aur_shape *shape, const double origin[3], const double direction[3],
                      double nearest, double farthest, double *distance);
    /* The surface point nearest to `position`, and its derivatives by the two texture coordinates unless
     * `tangents` is NULL. */
    void (*surface)(const aur_shape *shape, aur_vector position, const aur_hit *hit, aur_shape_point *point,
                    aur_vector tangents[2]);
    /* NULL for shapes that cannot be lights. */
    aur_shape_point (*sample)(const aur_shape *shape, float u, float v);
    /* Samples a point visible from `reference`; *pdf is by solid angle; with texture coordinates only if
     * `textured`, because their arc functions take long. The second function returns that pdf.
     * Both may be NULL; false or 0 means: sample by area, as from inside. */
    bool (*sample_seen)(const aur_shape *shape, aur_vector reference, float u, float v, bool textured,
                        aur_shape_point *point, float *pdf);
    float (*pdf_seen)(const aur_shape *shape, aur_vector reference);
    /* Maps texture coordinates such that equal areas of the primitive are equal areas of the unit square.
     * NULL: they are already. */
    void (*equal_area)(const aur_hit *hit, float coordinates[2]);
    /* NULL: the shape's. */
    double (*area)(const aur_shape *shape, size_t primitive);
} aur_curved;

struct aur_shape {
    const aur_shape_descriptor *descriptor;
    aur_location location;
    const char *name;         /* its id, or the name in a Radiance file; NULL: none */
    uint32_t index;           /* index among the shapes of the scene */
    const aur_curved *curved; /* NULL: a mesh */
    aur_mesh mesh;
    bool parallelogram; /* two triangles sampled by one continuous map: corners 0, 1, 2, 3 in order */
    bool ellipse;       /* flat, with the half axes axis[0] and axis[1] */
    bool flipped;       /* curved shapes: the normal is reversed */
    double position[3]; /* curved shapes: the local origin in the world */
    aur_vector
        center; /* curved shapes: the same relative to the scene's origin; 0 before aur_shape_recenter */
    aur_vector axis[3]; /* curved shapes: the local axes */
    float radius, length;
    float inner; /* radius of the hole in a disk of radius 1 */
    aur_curves curves;
    /* Attributes of the file's vertices and triangles, until the shape has extracted what its material reads.
     */
    size_t attribute_count;
    aur_mesh_attribute *attributes;
    aur_face_flaws flaws; /* of the faces of the mesh */
    char *file;           /* group of the shape; NULL: the scene */
    bool extreme;         /* a mesh with a triangle that is not aur_is_usual_square */
    bool smooth;          /* a mesh that is to get vertex normals */
    double area;
    const aur_bsdf *bsdf;
    uint32_t emitter; /* index of the shape's light, or AUR_NO_EMITTER */
    bool grouped;     /* part of a group: rays hit only its instances */
    /* Interior and exterior media, if `bounds_media`; NULL: none. */
    const aur_medium *interior, *exterior;
    bool bounds_media;
};

/* Parameters of every shape. */
typedef struct aur_shape_keys {
    aur_transform to_world;
    bool flip_normals;
    const aur_parameter *bsdf, *emitter, *interior, *exterior; /* read by the loader */
} aur_shape_keys;

/* Common input for the creation of shapes. */
typedef struct aur_shape_input {
    aur_parameters *parameters;
    aur_xml_document *document;       /* to resolve file names */
    aur_transform to_world, to_local; /* affine */
    bool flip_normals;
} aur_shape_input;

struct aur_shape_descriptor {
    aur_row row;              /* first, so that a row of the table is its descriptor */
    const aur_curved *curved; /* NULL: a mesh */
    /* Reads its parameters and builds the shape in world coordinates (flips included), as aur_shape_recenter
     * requires. */
    aur_result (*create)(const aur_shape_input *input, aur_shape *shape, aur_error *error);
    /* For meshes from files, whose `create` is aur_mesh_file_create: vertex normals are computed if the file
     * has none. */
    aur_result (*read_file)(aur_mesh_file *file, aur_shape *shape);
};

/* The number of primitives that rays can hit. */
static inline size_t aur_shape_primitives(const aur_shape *shape) {
    if (shape->curved == NULL)
        return shape->mesh.triangle_count;
    return shape->curves.segment_count != 0 ? shape->curves.segment_count : 1;
}

/* World bounds of a primitive of a curved shape, before the shape is recentred. */
void aur_shape_curved_bounds(const aur_shape *shape, size_t primitive, double lower[3], double upper[3]);

/* Given a point and its unit normal: offset and rounding if rays intersect the shape in doubles and
 * `position` was computed in doubles. Rounding to float happens once for the point and once for the ray's
 * origin: 2 of the 4 roundings of 6e-8 here. Doubles contribute about 1e-15 of `size`, the size of all
 * coordinates. */
static inline void aur_round_point(aur_vector position, aur_vector normal, float size,
                                   aur_shape_point *point) {
    point->position = position;
    point->normal = normal;
    point->rounding = 0.16f * aur_surface_rounding(position, normal) + 1e-15f * size;
    point->offset = point->rounding + AUR_LEAST_OFFSET;
}

static inline float aur_coordinate_sum(aur_vector a) {
    return fabsf(a.x) + fabsf(a.y) + fabsf(a.z);
}

/* The first root of a t^2 + 2 b t + c with nearest < t < farthest. */
bool aur_first_root(double a, double b, double c, double nearest, double farthest, double *root);

/* A point of any shape, sampled uniformly by area; u[0] selects a triangle of a mesh by `triangles`. */
aur_shape_point aur_shape_sample(const aur_shape *shape, const aur_distribution *triangles, const float u[3]);

/* The distribution of its triangles by area. Errors: MEMORY. */
aur_result aur_mesh_distribution(const aur_mesh *mesh, aur_distribution *triangles, aur_error *error);

/* A point of a triangle. */
aur_shape_point aur_triangle_sample(const aur_mesh *mesh, size_t triangle, float u, float v);

extern const aur_table aur_shape_table;

/* Builds the shape of parameters->plugin; the loader adds a BSDF and an emitter. */
aur_result aur_shape_create(aur_parameters *parameters, aur_xml_document *document, aur_shape **shape,
                            aur_error *error);
/* Converts the shape's coordinates to floats relative to `origin`, and updates dependent data. Rays can then
 * intersect the shape. `keep_points`: a mesh keeps its points in doubles. Errors: MEMORY. */
aur_result aur_shape_recenter(aur_shape *shape, const double origin[3], bool keep_points, aur_error *error);
void aur_shape_destroy(aur_shape *shape);
/* Uses the attribute of this name as vertex or triangle colours; one value becomes three. *found is false if
 * there is none with 1, or 3 or more values. Errors: MEMORY. */
aur_result aur_shape_use_attribute(aur_shape *shape, const char *name, bool *found, aur_error *error);
void aur_shape_release_attributes(aur_shape *shape);

/* For shapes built in local coordinates: transforms the mesh to the world, and flips it if requested. */
void aur_shape_transform(const aur_shape_input *input, aur_shape *shape);

/* Checks that a shape's to_world is a similarity: *scale is its factor. Errors: UNSUPPORTED. */
aur_result aur_shape_similarity(const aur_shape_input *input, double *scale, aur_error *error);

/* The dot product in double precision, for shapes whose rays need it. */
static inline double aur_shape_dot(const double a[3], aur_vector b) {
    return a[0] * (double)b.x + a[1] * (double)b.y + a[2] * (double)b.z;
}

/* The angle from x to y in turns, in [0,1]. */
static inline float aur_shape_azimuth(float x, float y) {
    const float azimuth = atan2f(y, x) / (2.0f * AUR_PI_F);
    return azimuth - floorf(azimuth);
}

static inline aur_vector aur_mesh_triple(const float *values, size_t index) {
    return (aur_vector){values[3 * index], values[3 * index + 1], values[3 * index + 2]};
}

/* Texture coordinates at barycentric coordinates of a triangle, which are the default; and mesh colours. */
static inline aur_bsdf_point aur_mesh_texture(const aur_mesh *mesh, size_t triangle, float b1, float b2) {
    aur_bsdf_point sum = {.u = 0.0f};
    if (mesh->face_colors != NULL)
        sum.face_color = aur_mesh_triple(mesh->face_colors, triangle);
    const float weight[3] = {1.0f - b1 - b2, b1, b2};
    for (size_t i = 0; mesh->vertex_colors != NULL && i < 3; ++i)
        sum.vertex_color =
            aur_vector_add_scaled(sum.vertex_color, weight[i],
                                  aur_mesh_triple(mesh->vertex_colors, mesh->indices[3 * triangle + i]));
    if (mesh->uvs == NULL) {
        sum.u = b1;
        sum.v = b2;
        return sum;
    }
    for (size_t i = 0; i < 3; ++i) {
        const float *const uv = &mesh->uvs[2 * (size_t)mesh->indices[3 * triangle + i]];
        sum.u += weight[i] * uv[0];
        sum.v += weight[i] * uv[1];
    }
    return sum;
}
