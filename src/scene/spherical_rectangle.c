#include "scene/spherical_rectangle.h"

static const float LEAST_SOLID_ANGLE = 0.01f;

static float clamp(float x, float least, float most) {
    return fminf(fmaxf(x, least), most);
}

static float arc(float cosine) {
    return acosf(clamp(cosine, -1.0f, 1.0f));
}

bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference,
                                    aur_spherical_rectangle *seen) {
    const aur_vector way = aur_vector_subtract(rectangle->corner, reference);
    const float x0 = aur_vector_dot(way, rectangle->x), y0 = aur_vector_dot(way, rectangle->y);
    const float x1 = x0 + rectangle->width, y1 = y0 + rectangle->height;
    /* The rectangle's plane lies below the point in the frame of the derivation. */
    const float z0 = -fabsf(aur_vector_dot(way, aur_vector_cross(rectangle->x, rectangle->y)));
    const float middle_x = 0.5f * (x0 + x1), middle_y = 0.5f * (y0 + y1);
    const float squared = middle_x * middle_x + middle_y * middle_y + z0 * z0;
    const float roughly = -z0 * rectangle->width * rectangle->height;
    if (!(roughly > LEAST_SOLID_ANGLE * squared * sqrtf(squared)))
        return false;
    /* z components of the normals of the four planes through the point and an edge. */
    const float n0 = -y0 / sqrtf(z0 * z0 + y0 * y0), n1 = x1 / sqrtf(z0 * z0 + x1 * x1);
    const float n2 = y1 / sqrtf(z0 * z0 + y1 * y1), n3 = -x0 / sqrtf(z0 * z0 + x0 * x0);
    const float k = 2.0f * AUR_PI_F - arc(-n2 * n3) - arc(-n3 * n0);
    const float solid_angle = arc(-n0 * n1) + arc(-n1 * n2) - k;
    *seen = (aur_spherical_rectangle){x0, x1, y0, y1, z0, n0, n2, k, solid_angle};
    return solid_angle > 0.25f * LEAST_SOLID_ANGLE;
}

void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t) {
    const float angle = u * seen->solid_angle + seen->k;
    const float f = (cosf(angle) * seen->b0 - seen->b1) / sinf(angle);
    const float cosine =
        clamp(copysignf(1.0f, f) / sqrtf(f * f + seen->b0 * seen->b0), -0.9999999f, 0.9999999f);
    const float x = clamp(-cosine * seen->z0 / sqrtf(1.0f - cosine * cosine), seen->x0, seen->x1);
    const float d_squared = x * x + seen->z0 * seen->z0;
    const float h0 = seen->y0 / sqrtf(d_squared + seen->y0 * seen->y0);
    const float h1 = seen->y1 / sqrtf(d_squared + seen->y1 * seen->y1);
    const float h = h0 + v * (h1 - h0);
    const float rest = 1.0f - h * h;
    const float y = rest > 1e-6f ? clamp(h * sqrtf(d_squared / rest), seen->y0, seen->y1) : seen->y1;
    *s = (x - seen->x0) / (seen->x1 - seen->x0);
    *t = (y - seen->y0) / (seen->y1 - seen->y0);
}
