/* Animated models: nodes, morph targets and skins at one time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/import/gltf.h"
#include "program/import/writer.h"

/* --- keys */

/* The interpolation weight of `time` between key `*first` and the next one; the keys have `count` >= 1 times.
 */
static float between(double time, unsigned count, const char *keys, size_t size, unsigned *first) {
    double before, after;
    *first = 0;
    for (unsigned i = 1; i < count; ++i) {
        memcpy(&before, keys + i * size, sizeof before); /* mTime is the first member of every key type */
        if (before <= time)
            *first = i;
    }
    if (*first + 1 >= count)
        return 0.0f;
    memcpy(&before, keys + *first * size, sizeof before);
    memcpy(&after, keys + (*first + 1) * size, sizeof after);
    return after > before ? (float)fmin(fmax((time - before) / (after - before), 0.0), 1.0) : 0.0f;
}

static void vector_at(double time, unsigned count, const struct aiVectorKey *keys, double to[3]) {
    unsigned i;
    const float t = between(time, count, (const char *)keys, sizeof *keys, &i);
    const struct aiVector3D a = keys[i].mValue, b = keys[i + 1 < count ? i + 1 : i].mValue;
    to[0] = (double)(a.x + t * (b.x - a.x));
    to[1] = (double)(a.y + t * (b.y - a.y));
    to[2] = (double)(a.z + t * (b.z - a.z));
}

/* Along the shorter arc. */
static void turn_at(double time, unsigned count, const struct aiQuatKey *keys, double to[4]) {
    unsigned i;
    const double t = (double)between(time, count, (const char *)keys, sizeof *keys, &i);
    const struct aiQuaternion a = keys[i].mValue, b = keys[i + 1 < count ? i + 1 : i].mValue;
    const double from[4] = {(double)a.x, (double)a.y, (double)a.z, (double)a.w};
    const double end[4] = {(double)b.x, (double)b.y, (double)b.z, (double)b.w};
    double cosine = 0.0, length = 0.0;
    for (size_t k = 0; k < 4; ++k)
        cosine += from[k] * end[k];
    const double sign = cosine < 0.0 ? -1.0 : 1.0, angle = acos(fmin(fabs(cosine), 1.0));
    const bool close = angle < 1e-6;
    const double u = close ? 1.0 - t : sin((1.0 - t) * angle) / sin(angle);
    const double v = close ? t : sin(t * angle) / sin(angle);
    for (size_t k = 0; k < 4; ++k) {
        to[k] = u * from[k] + sign * v * end[k];
        length += to[k] * to[k];
    }
    for (size_t k = 0; k < 4; ++k)
        to[k] /= length > 0.0 ? sqrt(length) : 1.0;
}

static struct aiNode *find_node(struct aiNode *node, const char *name) {
    if (strcmp(node->mName.data, name) == 0)
        return node;
    struct aiNode *found = NULL;
    for (unsigned i = 0; found == NULL && i < node->mNumChildren; ++i)
        found = find_node(node->mChildren[i], name);
    return found;
}

static void set_node(const struct aiNodeAnim *channel, double time, struct aiNode *node) {
    double t[3], q[4], s[3], m[16];
    if (channel->mNumPositionKeys == 0 || channel->mNumRotationKeys == 0 || channel->mNumScalingKeys == 0)
        return;
    vector_at(time, channel->mNumPositionKeys, channel->mPositionKeys, t);
    turn_at(time, channel->mNumRotationKeys, channel->mRotationKeys, q);
    vector_at(time, channel->mNumScalingKeys, channel->mScalingKeys, s);
    gltf_matrix(t, q, s, m);
    float *const to = &node->mTransformation.a1;
    for (size_t i = 0; i < 16; ++i)
        to[i] = (float)m[i];
}

/* --- morph targets */

static void set_weights(const struct aiMeshMorphAnim *channel, double time, struct aiMesh *mesh) {
    unsigned i;
    if (channel->mNumKeys == 0)
        return;
    const float t =
        between(time, channel->mNumKeys, (const char *)channel->mKeys, sizeof *channel->mKeys, &i);
    const struct aiMeshMorphKey *const a = &channel->mKeys[i],
                                       *const b = &channel->mKeys[i + 1 < channel->mNumKeys ? i + 1 : i];
    for (unsigned k = 0; k < a->mNumValuesAndWeights && k < b->mNumValuesAndWeights; ++k)
        if (a->mValues[k] < mesh->mNumAnimMeshes)
            mesh->mAnimMeshes[a->mValues[k]]->mWeight =
                (float)((1.0 - (double)t) * a->mWeights[k] + (double)t * b->mWeights[k]);
}

/* Targets are absolute meshes; the difference to the base is added. */
static void morph(struct aiMesh *mesh) {
    struct aiVector3D *const base = malloc(mesh->mNumVertices * sizeof *base);
    if (base == NULL)
        stream_fail_memory();
    memcpy(base, mesh->mVertices, mesh->mNumVertices * sizeof *base);
    for (unsigned k = 0; k < mesh->mNumAnimMeshes; ++k) {
        const struct aiAnimMesh *const target = mesh->mAnimMeshes[k];
        const float w = target->mWeight;
        for (unsigned i = 0; target->mVertices != NULL && target->mNumVertices == mesh->mNumVertices &&
                             w != 0.0f && i < mesh->mNumVertices;
             ++i) {
            mesh->mVertices[i].x += w * (target->mVertices[i].x - base[i].x);
            mesh->mVertices[i].y += w * (target->mVertices[i].y - base[i].y);
            mesh->mVertices[i].z += w * (target->mVertices[i].z - base[i].z);
        }
    }
    free(base);
}

/* --- skins */

static void multiply(const double a[16], const struct aiMatrix4x4 *b, double to[16]) {
    const float *const m = &b->a1;
    for (size_t i = 0; i < 16; ++i) {
        to[i] = 0.0;
        for (size_t k = 0; k < 4; ++k)
            to[i] += a[i / 4 * 4 + k] * (double)m[4 * k + i % 4];
    }
}

static void world_of(const struct aiNode *node, double to[16]) {
    double outer[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    if (node->mParent != NULL)
        world_of(node->mParent, outer);
    multiply(outer, &node->mTransformation, to);
}

/* Adds the position transformed by a bone, times its weight. */
static void add_moved(const double m[16], float weight, struct aiVector3D v, float w, struct aiVector3D *to) {
    const double x = (double)v.x, y = (double)v.y, z = (double)v.z, one = (double)w, share = (double)weight;
    to->x += (float)(share * (m[0] * x + m[1] * y + m[2] * z + m[3] * one));
    to->y += (float)(share * (m[4] * x + m[5] * y + m[6] * z + m[7] * one));
    to->z += (float)(share * (m[8] * x + m[9] * y + m[10] * z + m[11] * one));
}

/* Weights should sum to 1, but do not in some files; a vertex without weights does not move. */
static void normalize(unsigned count, const float *sums, const struct aiVector3D *from,
                      struct aiVector3D *to) {
    for (unsigned i = 0; i < count; ++i) {
        const float sum = sums[i];
        to[i] = sum > 0.0f ? (struct aiVector3D){to[i].x / sum, to[i].y / sum, to[i].z / sum} : from[i];
    }
}

/* Transforms a mesh to world space, where its bones are. */
static void skin(const struct aiScene *scene, struct aiMesh *mesh) {
    struct aiVector3D *const points = calloc(mesh->mNumVertices, sizeof *points);
    struct aiVector3D *const normals = calloc(mesh->mNumVertices, sizeof *normals);
    float *const sums = calloc(mesh->mNumVertices, sizeof *sums);
    if (points == NULL || normals == NULL || sums == NULL)
        stream_fail_memory();
    for (unsigned b = 0; b < mesh->mNumBones; ++b) {
        const struct aiBone *const bone = mesh->mBones[b];
        const struct aiNode *const node = find_node(scene->mRootNode, bone->mName.data);
        double world[16], moves[16];
        if (node == NULL)
            continue;
        world_of(node, world);
        multiply(world, &bone->mOffsetMatrix, moves);
        for (unsigned k = 0; k < bone->mNumWeights; ++k) {
            const unsigned i = bone->mWeights[k].mVertexId;
            const float weight = bone->mWeights[k].mWeight;
            if (i >= mesh->mNumVertices)
                continue;
            sums[i] += weight;
            add_moved(moves, weight, mesh->mVertices[i], 1.0f, &points[i]);
            if (mesh->mNormals != NULL)
                add_moved(moves, weight, mesh->mNormals[i], 0.0f, &normals[i]);
        }
    }
    normalize(mesh->mNumVertices, sums, mesh->mVertices, points);
    memcpy(mesh->mVertices, points, mesh->mNumVertices * sizeof *points);
    if (mesh->mNormals != NULL) {
        normalize(mesh->mNumVertices, sums, mesh->mNormals, normals);
        memcpy(mesh->mNormals, normals, mesh->mNumVertices * sizeof *normals);
    }
    free(points);
    free(normals);
    free(sums);
}

/* --- the whole model */

void writer_pose(writer *self, bool moving, double seconds) {
    const struct aiScene *const scene = self->scene;
    const struct aiAnimation *const animation =
        moving && scene->mNumAnimations > 0 ? scene->mAnimations[0] : NULL;
    const double ticks =
        animation != NULL && animation->mTicksPerSecond > 0.0 ? animation->mTicksPerSecond : 1.0;
    if (moving && animation == NULL)
        writer_note("it has no animation");
    for (unsigned i = 0; animation != NULL && i < animation->mNumChannels; ++i) {
        struct aiNode *const node = find_node(scene->mRootNode, animation->mChannels[i]->mNodeName.data);
        if (node != NULL)
            set_node(animation->mChannels[i], ticks * seconds, node);
    }
    for (unsigned i = 0; animation != NULL && i < animation->mNumMorphMeshChannels; ++i) {
        const struct aiMeshMorphAnim *const channel = animation->mMorphMeshChannels[i];
        const struct aiNode *const node = find_node(scene->mRootNode, channel->mName.data);
        for (unsigned k = 0; node != NULL && k < node->mNumMeshes; ++k)
            set_weights(channel, ticks * seconds, scene->mMeshes[node->mMeshes[k]]);
    }
    for (unsigned i = 0; i < scene->mNumMeshes && (self->is_gltf || moving); ++i) {
        if (scene->mMeshes[i]->mNumAnimMeshes > 0)
            morph(scene->mMeshes[i]);
        if (scene->mMeshes[i]->mNumBones > 0)
            skin(scene, scene->mMeshes[i]);
    }
    self->skinned = self->is_gltf || moving;
}
