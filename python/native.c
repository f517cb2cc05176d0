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
/* Points first .. first+count-1 of a digital sequence in base 2 in Gray code's order (Antonov, Saleev 1979),
 * points[count][columns]. Numbers are binary digits after the point: numbers[bits][columns] those of each bit
 * of an index, state[columns] point `first`. */
static inline void aureole_gray_code(uint64_t first, size_t count, size_t columns, const uint64_t *numbers,
                                     uint64_t *state, double *points) {
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < columns; ++j)
            points[columns * i + j] = (double)(int64_t)(state[j] >> 11) * 0x1p-53;
        const uint64_t next = first + i + 1;
        for (size_t j = 0; i + 1 < count && j < columns; ++j)
            state[j] ^= numbers[columns * (size_t)__builtin_ctzll(next) + j];
    }
}
/* The first log(denominator) digits of coordinates through tables[groups][size], the parts that a group of
 * digits gives to the result, from the last group on: column[count], `stride` apart, in place. `size` is a
 * power of the base. */
static inline void aureole_digit_tables(size_t count, size_t stride, double denominator, size_t groups,
                                        uint64_t size, const double *tables, double *column) {
    for (size_t i = 0; i < count; ++i) {
        uint64_t digits = (uint64_t)(column[stride * i] * denominator + 0.5);
        double sum = 0.0;
        for (size_t group = 0; group < groups; ++group, digits /= size)
            sum += tables[size * group + digits % size];
        column[stride * i] = sum < 1.0 ? sum : 1.0 - 0x1p-53;
    }
}
