/* Loops that NumPy's arrays ask for: what the library does for one point, for `count` of them. Shapes are
 * those of the library's functions of the same name, one row a point. */
static inline void aureole_map_weights(aur_map map, size_t count, const double *square, double *weights) {
    for (size_t i = 0; i < count; ++i)
        weights[i] = aur_map_weight(map, square + 2 * i);
}
static inline void aureole_lobe_pdf(const aur_lobe *lobe, size_t count, const double *xyz, double *density) {
    for (size_t i = 0; i < count; ++i)
        density[i] = aur_lobe_pdf(lobe, xyz + 3 * i);
}
static inline void aureole_rotation_matrices(size_t count, const double *wxyz, aur_rotation *matrices) {
    for (size_t i = 0; i < count; ++i)
        aur_rotation_from_quaternion(wxyz + 4 * i, matrices + i);
}
static inline void aureole_rotation_quaternions(size_t count, const aur_rotation *matrices, double *wxyz) {
    for (size_t i = 0; i < count; ++i)
        aur_rotation_to_quaternion(matrices + i, wxyz + 4 * i);
}
