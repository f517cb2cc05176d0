/* Meshes at any position, with any rotation. */
#pragma once

#include "mesh_text.h"

/* Turns, then moves. */
typedef struct mesh_pose {
    double turn[3][3], offset[3];
} mesh_pose;

static inline mesh_pose move_to(double x, double y, double z) {
    return (mesh_pose){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {x, y, z}};
}

/* About the axis (2, 3, 6) / 7 by an angle (Rodrigues). */
static inline mesh_pose turned_pose(double angle, double x, double y, double z) {
    const double axis[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}, c = cos(angle), s = sin(angle);
    mesh_pose pose = move_to(x, y, z);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            pose.turn[i][k] = (1.0 - c) * axis[i] * axis[k] + (i == k ? c : 0.0);
    pose.turn[0][1] -= s * axis[2];
    pose.turn[0][2] += s * axis[1];
    pose.turn[1][0] += s * axis[2];
    pose.turn[1][2] -= s * axis[0];
    pose.turn[2][0] -= s * axis[1];
    pose.turn[2][1] += s * axis[0];
    return pose;
}

/* The rounding of a coordinate there, for a mesh a few units wide. */
static inline double pose_rounding(const mesh_pose *pose) {
    return 0x1p-53 * (8.0 + fabs(pose->offset[0]) + fabs(pose->offset[1]) + fabs(pose->offset[2]));
}

static inline void moved_polygon(mesh_file *file, const mesh_pose *pose, size_t count,
                                 const double (*corners)[3]) {
    double moved[8][3];
    for (size_t i = 0; i < count; ++i)
        for (int d = 0; d < 3; ++d)
            moved[i][d] = pose->turn[d][0] * corners[i][0] + pose->turn[d][1] * corners[i][1] +
                          pose->turn[d][2] * corners[i][2] + pose->offset[d];
    mesh_polygon(file, count, (const double(*)[3])moved);
}

/* As mesh_box, with each side in a separate group. */
static inline void moved_box(mesh_file *file, const mesh_pose *pose, const char *name, const double low[3],
                             const double high[3], bool inside) {
    static const int faces[6][4] = {{0, 4, 6, 2}, {0, 1, 5, 4}, {0, 2, 3, 1},
                                    {1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}};
    for (size_t f = 0; f < 6; ++f) {
        double corners[4][3];
        for (size_t k = 0; k < 4; ++k)
            for (int d = 0; d < 3; ++d)
                corners[inside ? 3 - k : k][d] = (faces[f][k] >> d & 1) != 0 ? high[d] : low[d];
        fprintf(file->stream, "g %s%zu\n", name, f);
        moved_polygon(file, pose, 4, (const double(*)[3])corners);
    }
}
