/* Photometric files of luminaires: every symmetry of both formats against the generating function, flux
 * against closed forms, and damaged files. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector.h"
#include "render/scene/lights/photometry.h"

enum { CAPACITY = 1 << 20 };

static aur_photometry must_parse(const char *text) {
    aur_photometry photometry;
    aur_error error = {0};
    if (aur_photometry_parse("lamp", strlen(text), text, &photometry, &error) != AUR_OK)
        fail_msg("line %zu: %s", error.line, error.message);
    return photometry;
}

/* Linear in both angles between the files' steps of 5 degrees; about 0 and 180, and about 90 and 270, as
 * asked. */
static double tent(double c, double middle) {
    const double away = fabs(fmod(c - middle + 540.0, 360.0) - 180.0);
    return away / 180.0;
}

static double measured(int symmetry, double c, double gamma) {
    double value = 100.0 + 0.5 * gamma;
    if (symmetry != 1)
        value += 40.0 * fabs(2.0 * tent(c, 0.0) - 1.0); /* four equal quarters */
    if (symmetry == 0 || symmetry == 2)
        value += 30.0 * tent(c, 0.0);
    if (symmetry == 0 || symmetry == 3)
        value += 20.0 * tent(c, 90.0);
    return value;
}

/* The planes that a file of a symmetry of EULUMDAT has. */
static void planes_of(int symmetry, bool ies, int *from, int *to) {
    static const int ends[5][2] = {{0, 360}, {0, 0}, {0, 180}, {90, 270}, {0, 90}};
    *from = ends[symmetry][0];
    *to = ends[symmetry][1];
    if (!ies && symmetry == 0)
        *to = 355;
    if (!ies && symmetry == 3) {
        *from = 270;
        *to = 450;
    }
}

static void put_table(char *text, size_t *used, int symmetry, bool ies, double factor) {
    int from, to;
    planes_of(symmetry, ies, &from, &to);
    for (int c = from; c <= to; c += 5)
        for (int gamma = 0; gamma <= 180; gamma += 5)
            *used += (size_t)sprintf(text + *used, "%.9g%s", factor * measured(symmetry, c % 360, gamma),
                                     !ies || gamma == 180 ? "\r\n" : " ");
}

static void write_ies(int symmetry, char *text) {
    int from, to;
    planes_of(symmetry, true, &from, &to);
    size_t used =
        (size_t)sprintf(text,
                        "IESNA:LM-63-2002\r\n[TEST] none\r\nTILT=NONE\r\n2 1500 2.0 37 %d 1 2 .3 1.2 0\r\n"
                        ".5 1 80\r\n",
                        (to - from) / 5 + 1);
    for (int gamma = 0; gamma <= 180; gamma += 5)
        used += (size_t)sprintf(text + used, "%d ", gamma);
    for (int c = from; c <= to; c += 5)
        used += (size_t)sprintf(text + used, "%s%d", c == from ? "\r\n" : " ", c);
    used += (size_t)sprintf(text + used, "\r\n");
    put_table(text, &used, symmetry, true, 1.0);
}

static void write_eulumdat(int symmetry, char *text) {
    size_t used = (size_t)sprintf(
        text,
        "Maker\r\n1\r\n%d\r\n72\r\n5\r\n37\r\n5\r\nr\r\nn\r\nx\r\nf\r\nd\r\n1250\r\n300\r\n50\r\n"
        "1200\r\n300\r\n0\r\n0\r\n0\r\n0\r\n100\r\n80,5\r\n1.0\r\n0\r\n1\r\n2\r\nT16\r\n2000\r\n"
        "840\r\n80\r\n64\r\n",
        symmetry);
    for (int i = 0; i < 10; ++i)
        used += (size_t)sprintf(text + used, "0.5\r\n");
    for (int c = 0; c < 360; c += 5)
        used += (size_t)sprintf(text + used, "%d\r\n", c);
    for (int gamma = 0; gamma <= 180; gamma += 5)
        used += (size_t)sprintf(text + used, "%d\r\n", gamma);
    put_table(text, &used, symmetry, false, 0.5); /* a thousandth of 2000 lm */
}

static void symmetries(void **state) {
    (void)state;
    char *const text = malloc(CAPACITY);
    for (int symmetry = 0; symmetry < 5; ++symmetry)
        for (int format = 0; format < 2; ++format) {
            (format == 0 ? write_ies : write_eulumdat)(symmetry, text);
            aur_photometry photometry = must_parse(text);
            double flux = 0.0;
            for (size_t i = 0; i < 2000; ++i) {
                const double c = 360.0 * (double)i / 2000.0, gamma = 180.0 * fmod(0.618034 * (double)i, 1.0);
                const double a = c * AUR_PI / 180.0, g = gamma * AUR_PI / 180.0;
                const double way[3] = {3.0 * cos(a) * sin(g), 3.0 * sin(a) * sin(g), -3.0 * cos(g)};
                assert_relative(aur_photometry_intensity(&photometry, way), measured(symmetry, c, gamma),
                                1e-5);
            }
            /* by midpoints, whose error is below a part in 10^5 */
            for (int c = 0; c < 720; ++c)
                for (int g = 0; g < 720; ++g)
                    flux += measured(symmetry, 0.5 * (c + 0.5), 0.25 * (g + 0.5)) *
                            sin(0.25 * (g + 0.5) * AUR_PI / 180.0) * (AUR_PI / 360.0) * (AUR_PI / 720.0);
            assert_relative(aur_photometry_flux(&photometry), flux, 1e-4);
            assert_near(photometry.length, 1.2, 1e-12);
            assert_near(photometry.width, 0.3, 1e-12);
            assert_near(photometry.lumens, format == 0 ? 3000.0 : 2000.0, 0.0);
            aur_photometry_release(&photometry);
        }
    free(text);
}

/* Even light of 7 cd: 28 pi lumens; a cosine of 10 cd by steps of a degree: 10 pi within a part in 10^4, and
 * types A and B of one candela over the half they cover: 2 pi. Old files name no edition. */
static void fluxes(void **state) {
    (void)state;
    char *const text = malloc(CAPACITY);
    aur_photometry photometry =
        must_parse("a lamp\nTILT=NONE\n1 1000 7 2 1 1 1 -1 0 0\n1 1 9\n0 180\n0\n1 1\n");
    assert_relative(aur_photometry_flux(&photometry), 28.0 * AUR_PI, 1e-6);
    assert_true(photometry.round);
    assert_near(photometry.length, 0.3048, 1e-12);
    aur_photometry_release(&photometry);
    size_t used = (size_t)sprintf(text, "TILT=INCLUDE\n1 3\n0 45 90\n1 1 1\n1 -1 10 91 1 1 2 0 0 0 1 1 9\n");
    for (int g = 0; g <= 90; ++g)
        used += (size_t)sprintf(text + used, "%d ", g);
    used += (size_t)sprintf(text + used, "\n0\n");
    for (int g = 0; g <= 90; ++g)
        used += (size_t)sprintf(text + used, "%.12g ", cos(g * AUR_PI / 180.0));
    photometry = must_parse(text);
    assert_relative(aur_photometry_flux(&photometry), 10.0 * AUR_PI, 1e-4);
    assert_near(photometry.lumens, 0.0, 0.0);
    assert_near(aur_photometry_intensity(&photometry, (const double[3]){0, 0, 1}), 0.0, 0.0);
    aur_photometry_release(&photometry);
    for (int type = 2; type <= 3; ++type)
        for (int half = 0; half < 2; ++half) {
            sprintf(text, "TILT=NONE\n1 9 1 2 2 %d 2 0 0 0 1 1 9\n%d 90\n%d 90\n1 1 1 1\n", type,
                    half == 0 ? -90 : 0, half == 0 ? -90 : 0);
            photometry = must_parse(text);
            assert_relative(aur_photometry_flux(&photometry), 2.0 * AUR_PI, 2e-3);
            aur_photometry_release(&photometry);
        }
    free(text);
}

static void damage(void **state) {
    (void)state;
#define HEAD "IESNA91\nTILT=NONE\n"
    static const struct {
        const char *text;
        size_t line;
        const char *message;
    } rows[] = {
        {"", 0, "the file ends in its head"},
        {"IESNA91\nTILT =NONE\n", 2, "the line 'TILT=...' expected"},
        {HEAD, 3, "lamps, lumens and a multiplier expected (the file ends)"},
        {HEAD "1 x 1", 3, "lamps, lumens and a multiplier expected (found 'x')"},
        {HEAD "1 1 1 0 1", 3, "the number of vertical angles: a whole number from 1"},
        {HEAD "1 1 1 2 1e9", 3, "the number of horizontal angles: a whole number from 1"},
        {HEAD "1 1 1 2 1 4", 3, "the photometric type must be 1"},
        {HEAD "1 1 1 2 1 1 3", 3, "the unit must be 1"},
        {HEAD "1 1 0 2 1 1 1 0 0 0 1 1 9 0 180 0 1 1", 3,
         "multiplier and the ballast factor must be above 0"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 0\n0\n1 1", 4, "vertical angles must ascend"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 200\n0\n1 1", 6, "vertical angles must be from 0 to 180"},
        {HEAD "1 1 1 2 2 1 1 0 0 0 1 1 9\n0 180\n0 50\n1 1 1 1", 6, "horizontal angles must go from 0"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 180\n0\n1", 6, "a luminous intensity expected (the file ends)"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 180\n0\n1 -1", 6, "must not be below 0"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 180\n0\n0 0", 6, "the luminaire emits no light"},
        {HEAD "1 1 1 2 1 1 1 0 0 0 1 1 9\n0 180\n0\n1 nan", 6, "a luminous intensity expected (found 'nan')"},
        {HEAD "1 1 1 90000 90000 1 1 0 0 0 1 1 9\n0", 3, "more than 4 million values"},
        {"TILT=INCLUDE\n1 2\n0 90\n1", 4, "a tilt angle or factor expected"},
        {"m\n1\nx\n", 3, "symmetry, numbers and steps of angles expected (found 'x')"},
        {"\x89PNG\r\n\x1a\n", 2, "the type expected"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        aur_photometry photometry;
        aur_error error = {0};
        if (aur_photometry_parse("lamp", strlen(rows[i].text), rows[i].text, &photometry, &error) == AUR_OK)
            fail_msg("row %zu is read", i);
        if (strstr(error.message, rows[i].message) == NULL || error.line != rows[i].line)
            fail_msg("row %zu: line %zu: %s", i, error.line, error.message);
    }
    /* EULUMDAT: each line of the head replaced by words, and the file cut after each line. */
    char *const text = malloc(CAPACITY), *const bad = malloc(CAPACITY);
    write_eulumdat(4, text);
    const char *line = text;
    for (size_t n = 1; n < 150; ++n) {
        const char *const next = strchr(line, '\n') + 1;
        const bool words = n == 1 || (n >= 8 && n <= 12) || n == 27 || n == 28 || n == 30 || n == 31 ||
                           n == 32 || (n >= 33 && n <= 42);
        for (int cut = 0; cut < 2; ++cut) {
            const size_t before = (size_t)(line - text);
            memcpy(bad, text, before);
            strcpy(bad + before, cut ? "" : "words\r\n");
            if (!cut)
                strcat(bad, next);
            aur_photometry photometry;
            aur_error error = {0};
            const aur_result result = aur_photometry_parse("lamp", strlen(bad), bad, &photometry, &error);
            if (result == AUR_OK)
                aur_photometry_release(&photometry);
            if ((result == AUR_OK) != (words && !cut))
                fail_msg("line %zu %s: %d %s", n, cut ? "cut" : "in words", (int)result, error.message);
        }
        line = next;
    }
    free(text);
    free(bad);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(symmetries),
        cmocka_unit_test(fluxes),
        cmocka_unit_test(damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
