/* The tree of nodes: transforms of shapes, lights and cameras. */
#include <assimp/version.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/import/gltf.h"
#include "program/import/writer.h"

static const double pi = 3.14159265358979323846;

typedef struct triple {
    double x, y, z;
} triple;

static writer_matrix multiply(const writer_matrix *outer, const double inner[16]) {
    writer_matrix product;
    for (size_t i = 0; i < 16; ++i) {
        product.m[i] = 0.0;
        for (size_t k = 0; k < 4; ++k)
            product.m[i] += outer->m[i / 4 * 4 + k] * inner[4 * k + i % 4];
    }
    return product;
}

static writer_matrix below(const writer_matrix *outer, const struct aiNode *node, const gltf_node *exact) {
    const struct aiMatrix4x4 t = node->mTransformation;
    double inner[16] = {(double)t.a1, (double)t.a2, (double)t.a3, (double)t.a4, (double)t.b1, (double)t.b2,
                        (double)t.b3, (double)t.b4, (double)t.c1, (double)t.c2, (double)t.c3, (double)t.c4,
                        0.0,          0.0,          0.0,          1.0};
    gltf_refine(exact, inner);
    return multiply(outer, inner);
}

/* `w`: 1 for points, 0 for directions. */
static triple apply(const writer_matrix *to_world, double x, double y, double z, double w) {
    const double *const m = to_world->m;
    return (triple){m[0] * x + m[1] * y + m[2] * z + m[3] * w, m[4] * x + m[5] * y + m[6] * z + m[7] * w,
                    m[8] * x + m[9] * y + m[10] * z + m[11] * w};
}

static triple apply_vector(const writer_matrix *to_world, struct aiVector3D v, double w) {
    return apply(to_world, (double)v.x, (double)v.y, (double)v.z, w);
}

static triple add_scaled(triple a, double factor, triple b) {
    return (triple){a.x + factor * b.x, a.y + factor * b.y, a.z + factor * b.z};
}

static triple normalize(triple v) {
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > 0.0 ? (triple){v.x / length, v.y / length, v.z / length} : (triple){0.0, 0.0, -1.0};
}

static void put_matrix(writer *self, const writer_matrix *to_world) {
    const double *const m = to_world->m;
    writer_open(self, "transform", NULL);
    writer_set(self, "name", "to_world");
    writer_open(self, "matrix", NULL);
    writer_set(self, "value",
               "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g 0 0 0 1", m[0], m[1],
               m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11]);
    writer_close(self);
    writer_close(self);
}

static void copy(double to[3], triple from) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

/* --- shapes */

static void put_reference(writer *self, const char *kind, unsigned index) {
    writer_open(self, "ref", NULL);
    writer_set(self, "id", "%s-%u-%u", kind, self->first, index);
    writer_close(self);
}

/* A mesh with the transform `to_world`, or in a group (NULL). */
static void put_mesh(writer *self, unsigned index, const writer_matrix *to_world) {
    const struct aiMesh *const mesh = self->scene->mMeshes[index];
    const bool smooth = mesh->mNormals != NULL || !self->is_gltf;
    writer_open(self, "shape", "ply");
    writer_property(self, "string", "filename", "*%u", self->mesh_file[index]);
    writer_property(self, "boolean", "face_normals", "%s", smooth ? "false" : "true");
    if (mesh->mNormals == NULL && smooth)
        writer_property(self, "float", "crease_angle", "30");
    if (to_world != NULL)
        put_matrix(self, to_world);
    put_reference(self, "material", mesh->mMaterialIndex);
    if (writer_shines(self, mesh->mMaterialIndex))
        writer_put_emitter(self, mesh->mMaterialIndex);
    writer_close(self);
}

/* A mesh with several nodes becomes a group, unless it emits: an emitter is one shape. */
static bool is_group(writer *self, unsigned mesh) {
    return self->mesh_uses[mesh] > 1 && !writer_shines(self, self->scene->mMeshes[mesh]->mMaterialIndex);
}

static void write_mesh(writer *self, unsigned index, const writer_matrix *to_world) {
    if (self->mesh_file[index] == NO_FILE)
        return;
    if (!is_group(self, index)) {
        put_mesh(self, index, to_world);
        return;
    }
    writer_open(self, "shape", "instance");
    put_reference(self, "group", index);
    put_matrix(self, to_world);
    writer_close(self);
}

static void count_uses(writer *self, const struct aiNode *node, const gltf_node *exact) {
    double(*copies)[16];
    const size_t count = gltf_instances(self, exact, &copies);
    free(copies);
    for (unsigned i = 0; i < node->mNumMeshes; ++i)
        self->mesh_uses[node->mMeshes[i]] += count > 1 ? 2 : 1;
    for (unsigned i = 0; i < node->mNumChildren; ++i)
        count_uses(self, node->mChildren[i], gltf_child(self, exact, i));
}

static void put_groups(writer *self) {
    for (unsigned i = 0; i < self->scene->mNumMeshes; ++i) {
        if (self->mesh_file[i] == NO_FILE || !is_group(self, i))
            continue;
        writer_open(self, "shape", "shapegroup");
        writer_set(self, "id", "group-%u-%u", self->first, i);
        put_mesh(self, i, NULL);
        writer_close(self);
    }
}

/* --- lights */

static void put_color(writer *self, const char *name, struct aiColor3D color) {
    writer_property(self, "rgb", name, "%.9g %.9g %.9g", fmax(0.0, (double)color.r),
                    fmax(0.0, (double)color.g), fmax(0.0, (double)color.b));
}

static void put_triple(writer *self, const char *tag, const char *name, triple v) {
    writer_property(self, tag, name, "%.17g %.17g %.17g", v.x, v.y, v.z);
}

static void put_spot(writer *self, triple origin, triple direction) {
    /* The up direction does not matter, but must not be parallel. */
    const triple up = fabs(direction.y) < 0.9 ? (triple){0.0, 1.0, 0.0} : (triple){1.0, 0.0, 0.0};
    /* At geographic coordinates a target one unit away would round the direction. */
    const triple target =
        add_scaled(origin, 1.0 + fabs(origin.x) + fabs(origin.y) + fabs(origin.z), direction);
    writer_open(self, "transform", NULL);
    writer_set(self, "name", "to_world");
    writer_open(self, "lookat", NULL);
    writer_set(self, "origin", "%.17g %.17g %.17g", origin.x, origin.y, origin.z);
    writer_set(self, "target", "%.17g %.17g %.17g", target.x, target.y, target.z);
    writer_set(self, "up", "%g %g %g", up.x, up.y, up.z);
    writer_close(self);
    writer_close(self);
}

static void write_light(writer *self, const struct aiLight *light, const writer_matrix *to_world) {
    const triple origin = apply_vector(to_world, light->mPosition, 1.0);
    const triple direction = normalize(apply_vector(to_world, light->mDirection, 0.0));
    switch (light->mType) {
    case aiLightSource_DIRECTIONAL:
        writer_open(self, "emitter", "directional");
        put_triple(self, "vector", "direction", direction);
        put_color(self, "irradiance", light->mColorDiffuse);
        break;
    case aiLightSource_POINT:
        writer_open(self, "emitter", "point");
        put_triple(self, "point", "position", origin);
        put_color(self, "intensity", light->mColorDiffuse);
        break;
    case aiLightSource_SPOT: {
        /* Angle from the axis, as in glTF; other formats give the full cone angle. */
        const double part = self->is_gltf ? 180.0 / pi : 90.0 / pi;
        const double outer = fmin(fmax(part * (double)light->mAngleOuterCone, 0.1), 89.9);
        const double inner = fmin(fmax(part * (double)light->mAngleInnerCone, 0.0), 0.999 * outer);
        writer_open(self, "emitter", "spot");
        writer_property(self, "float", "cutoff_angle", "%.9g", outer);
        writer_property(self, "float", "beam_width", "%.9g", inner);
        put_color(self, "intensity", light->mColorDiffuse);
        put_spot(self, origin, direction);
        break;
    }
    default:
        writer_note("the light '%s' is of an unknown kind: it is left out", light->mName.data);
        return;
    }
    writer_close(self);
}

/* --- cameras */

/* Horizontal field of view in degrees. Up to 5.2 assimp multiplies glTF's vertical angle by the aspect ratio.
 */
static double angle_across(const writer *self, const struct aiCamera *camera) {
    const double given = (double)camera->mHorizontalFOV, ratio = (double)camera->mAspect;
    const bool multiplied = self->is_gltf && 100 * aiGetVersionMajor() + aiGetVersionMinor() <= 502;
    return 180.0 / pi * (multiplied && ratio > 0.0 ? 2.0 * atan(ratio * tan(0.5 * given / ratio)) : given);
}

/* Without an aspect ratio the angle is vertical. */
static void write_camera(writer *self, const struct aiCamera *camera, const writer_matrix *to_world) {
    aur_import_camera *const view = &self->camera;
    if (view->is_there != 0) {
        ++self->further_cameras;
        return;
    }
    /* assimp adds the node's translation to glTF cameras, which the node applies again. */
    const struct aiVector3D position = self->is_gltf ? (struct aiVector3D){0} : camera->mPosition;
    *view = (aur_import_camera){.is_there = 1,
                                .angle = angle_across(self, camera),
                                .angle_is_vertical = !(camera->mAspect > 0.0f),
                                .aspect = (double)camera->mAspect};
    copy(view->origin, apply_vector(to_world, position, 1.0));
    copy(view->direction, apply_vector(to_world, camera->mLookAt, 0.0));
    copy(view->up, apply_vector(to_world, camera->mUp, 0.0));
    if (camera->mOrthographicWidth > 0.0f)
        view->half_width = (double)camera->mOrthographicWidth;
}

/* --- the tree */

/* Lights and cameras take the transform of the node with their name. */
static void write_named(writer *self, const struct aiNode *node, const writer_matrix *to_world) {
    const struct aiScene *const scene = self->scene;
    for (unsigned i = 0; i < scene->mNumLights; ++i)
        if (strcmp(scene->mLights[i]->mName.data, node->mName.data) == 0)
            write_light(self, scene->mLights[i], to_world);
    for (unsigned i = 0; i < scene->mNumCameras; ++i)
        if (strcmp(scene->mCameras[i]->mName.data, node->mName.data) == 0)
            write_camera(self, scene->mCameras[i], to_world);
}

static const writer_matrix unmoved = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};

static void write_node(writer *self, const struct aiNode *node, const gltf_node *exact,
                       const writer_matrix *outer) {
    const writer_matrix to_world = below(outer, node, exact);
    double(*copies)[16];
    const size_t count = gltf_instances(self, exact, &copies);
    for (size_t k = 0; k < (count > 0 ? count : 1); ++k) {
        const writer_matrix copy_to_world = count > 0 ? multiply(&to_world, copies[k]) : to_world;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            const bool skinned = self->skinned && self->scene->mMeshes[node->mMeshes[i]]->mNumBones > 0;
            write_mesh(self, node->mMeshes[i], skinned ? &unmoved : &copy_to_world);
        }
    }
    free(copies);
    write_named(self, node, &to_world);
    for (unsigned i = 0; i < node->mNumChildren; ++i)
        write_node(self, node->mChildren[i], gltf_child(self, exact, i), &to_world);
}

void writer_put_nodes(writer *self) {
    const gltf_node *const root = gltf_root(self, self->scene->mRootNode);
    count_uses(self, self->scene->mRootNode, root);
    put_groups(self);
    write_node(self, self->scene->mRootNode, root, &unmoved);
    if (self->further_cameras > 0)
        writer_note("the first of %u cameras is used", self->further_cameras + 1);
}
