/* A solution as a coloured mesh. Vertices far from the origin are written in doubles. */
#include "points/base/file.h"
#include "render/image/format.h"
#include "render/radiosity/solution.h"

aur_result aur_radiosity_write_ply(const aur_radiosity *radiosity, const char *path, double exposure,
                                   aur_error *error) {
    if (radiosity->scene.triangle_count > INT32_MAX / 3)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "radiosity: a PLY file numbers at most %d triangles, and the scene has %zu",
                        INT32_MAX / 3, radiosity->scene.triangle_count);
    aur_file_writer file;
    const aur_result result = aur_file_open(path, &file, error);
    if (result != AUR_OK)
        return result;
    const aur_radiosity_scene *const scene = &radiosity->scene;
    const size_t count = scene->triangle_count;
    const double *const origin = aur_scene_origin(scene->scene);
    const bool wide = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
    const char *const type = wide ? "double" : "float";
    fprintf(file.stream,
            "ply\nformat %s 1.0\ncomment radiosity of %llu paths\nelement vertex %zu\nproperty %s x\n"
            "property %s y\nproperty %s z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
            "property float radiance_r\nproperty float radiance_g\nproperty float radiance_b\n"
            "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? "binary_little_endian" : "binary_big_endian",
            (unsigned long long)radiosity->paths, 3 * count, type, type, type, count);
    const double scale = exp2(exposure);
    for (size_t i = 0; i < count; ++i) {
        const aur_radiosity_triangle *const t = &scene->triangles[i];
        aur_radiosity_triangle_result solved;
        aur_radiosity_result(radiosity, i, &solved);
        float radiance[3];
        unsigned char color[3];
        for (size_t c = 0; c < 3; ++c) {
            radiance[c] = (float)solved.radiance[c];
            color[c] = (unsigned char)(255.0 * aur_srgb_encode(scale * (double)radiance[c]) + 0.5);
        }
        const aur_vector corner[3] = {t->corner, aur_vector_add(t->corner, t->edge[0]),
                                      aur_vector_add(t->corner, t->edge[1])};
        for (size_t k = 0; k < 3; ++k) {
            const float narrow[3] = {corner[k].x, corner[k].y, corner[k].z};
            double position[3];
            for (size_t d = 0; d < 3; ++d)
                position[d] = (double)narrow[d] + origin[d];
            fwrite(wide ? (const void *)position : narrow, wide ? sizeof position : sizeof narrow, 1,
                   file.stream);
            fwrite(color, sizeof color, 1, file.stream);
            fwrite(radiance, sizeof radiance, 1, file.stream);
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const unsigned char three = 3;
        const int32_t index[3] = {(int32_t)(3 * i), (int32_t)(3 * i + 1), (int32_t)(3 * i + 2)};
        fwrite(&three, 1, 1, file.stream);
        fwrite(index, sizeof index, 1, file.stream);
    }
    return aur_file_commit(&file, error);
}
