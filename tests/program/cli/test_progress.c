/* The progress bar's arithmetic with a simulated clock: recorded reports of real commands, with processor
 * time of one thread, and series of known shape. */
#include "program/cli/progress.h"

#include <math.h>
#include <string.h>

#include "check.h"

typedef struct moment {
    double time; /* seconds */
    const char *what;
    double fraction;
} moment;

static const moment image[] = {
    {0, "rendering", 0},           {0.017, "rendering", 0.0277},  {0.04, "rendering", 0.0833},
    {0.0605, "rendering", 0.125},  {0.079, "rendering", 0.1805},  {0.0955, "rendering", 0.2222},
    {0.1158, "rendering", 0.2638}, {0.1315, "rendering", 0.3055}, {0.1528, "rendering", 0.3611},
    {0.1712, "rendering", 0.4166}, {0.1877, "rendering", 0.4722}, {0.2012, "rendering", 0.5138},
    {0.2267, "rendering", 0.5694}, {0.2479, "rendering", 0.6111}, {0.2668, "rendering", 0.6666},
    {0.2845, "rendering", 0.7083}, {0.3026, "rendering", 0.75},   {0.3203, "rendering", 0.7916},
    {0.3396, "rendering", 0.8472}, {0.3584, "rendering", 0.9027}, {0.3765, "rendering", 0.9444},
    {0.3874, "rendering", 1}};
static const moment photon_map[] = {
    {0, "photons", 0.05596},       {0.009, "photons", 0.1123},    {0.0181, "photons", 0.1679},
    {0.027, "photons", 0.2236},    {0.0359, "photons", 0.2796},   {0.0449, "photons", 0.3358},
    {0.0538, "photons", 0.3912},   {0.0627, "photons", 0.4464},   {0.0717, "photons", 0.5015},
    {0.0807, "photons", 0.5568},   {0.0897, "photons", 0.6124},   {0.0986, "photons", 0.6681},
    {0.1072, "photons", 0.7235},   {0.1158, "photons", 0.7793},   {0.1242, "photons", 0.8348},
    {0.1327, "photons", 0.8905},   {0.1414, "photons", 0.9462},   {0.15, "photons", 1},
    {0.1641, "rendering", 0},      {0.1692, "rendering", 0.0625}, {0.1757, "rendering", 0.1093},
    {0.1812, "rendering", 0.1562}, {0.1872, "rendering", 0.1875}, {0.1931, "rendering", 0.2187},
    {0.1988, "rendering", 0.2812}, {0.2042, "rendering", 0.3593}, {0.21, "rendering", 0.4062},
    {0.2151, "rendering", 0.4531}, {0.2212, "rendering", 0.5156}, {0.2266, "rendering", 0.5625},
    {0.2324, "rendering", 0.625},  {0.2387, "rendering", 0.6718}, {0.2444, "rendering", 0.7187},
    {0.2501, "rendering", 0.7812}, {0.2555, "rendering", 0.7968}, {0.2611, "rendering", 0.8593},
    {0.2667, "rendering", 0.9062}, {0.2731, "rendering", 0.9531}, {0.2775, "rendering", 1}};
static const moment view_factors[] = {{0, "tracing rays", 0.02703},
                                      {0.0159, "tracing rays", 0.08108},
                                      {0.0257, "tracing rays", 0.1081},
                                      {0.0444, "tracing rays", 0.1622},
                                      {0.0651, "tracing rays", 0.2162},
                                      {0.0865, "tracing rays", 0.2703},
                                      {0.096, "tracing rays", 0.2973},
                                      {0.1167, "tracing rays", 0.3514},
                                      {0.1367, "tracing rays", 0.4054},
                                      {0.1457, "tracing rays", 0.4324},
                                      {0.1675, "tracing rays", 0.4865},
                                      {0.1875, "tracing rays", 0.5405},
                                      {0.2071, "tracing rays", 0.5946},
                                      {0.2185, "tracing rays", 0.6216},
                                      {0.238, "tracing rays", 0.6757},
                                      {0.2584, "tracing rays", 0.7297},
                                      {0.27, "tracing rays", 0.7568},
                                      {0.2903, "tracing rays", 0.8108},
                                      {0.3101, "tracing rays", 0.8649},
                                      {0.3297, "tracing rays", 0.9189},
                                      {0.337, "tracing rays", 0.9459},
                                      {0.3508, "tracing rays", 1},
                                      {0.387, "measuring the sky", 0.02703},
                                      {0.4514, "measuring the sky", 0.08108},
                                      {0.49, "measuring the sky", 0.1081},
                                      {0.5647, "measuring the sky", 0.1622},
                                      {0.6403, "measuring the sky", 0.2162},
                                      {0.7227, "measuring the sky", 0.2703},
                                      {0.7608, "measuring the sky", 0.2973},
                                      {0.8407, "measuring the sky", 0.3514},
                                      {0.9219, "measuring the sky", 0.4054},
                                      {0.9591, "measuring the sky", 0.4324},
                                      {1.046, "measuring the sky", 0.4865},
                                      {1.133, "measuring the sky", 0.5405},
                                      {1.221, "measuring the sky", 0.5946},
                                      {1.268, "measuring the sky", 0.6216},
                                      {1.352, "measuring the sky", 0.6757},
                                      {1.433, "measuring the sky", 0.7297},
                                      {1.477, "measuring the sky", 0.7568},
                                      {1.56, "measuring the sky", 0.8108},
                                      {1.636, "measuring the sky", 0.8649},
                                      {1.719, "measuring the sky", 0.9189},
                                      {1.752, "measuring the sky", 0.9459},
                                      {1.808, "measuring the sky", 1},
                                      {1.811, "integrating along edges", 0.006803},
                                      {1.816, "integrating along edges", 0.03401},
                                      {1.827, "integrating along edges", 0.09524},
                                      {1.833, "integrating along edges", 0.1224},
                                      {1.844, "integrating along edges", 0.1905},
                                      {1.85, "integrating along edges", 0.2245},
                                      {1.861, "integrating along edges", 0.2789},
                                      {1.866, "integrating along edges", 0.3129},
                                      {1.872, "integrating along edges", 0.3401},
                                      {1.882, "integrating along edges", 0.4014},
                                      {1.888, "integrating along edges", 0.4354},
                                      {1.899, "integrating along edges", 0.4898},
                                      {1.905, "integrating along edges", 0.5238},
                                      {1.916, "integrating along edges", 0.5918},
                                      {1.923, "integrating along edges", 0.619},
                                      {1.928, "integrating along edges", 0.6531},
                                      {1.94, "integrating along edges", 0.7211},
                                      {1.946, "integrating along edges", 0.7551},
                                      {1.957, "integrating along edges", 0.8231},
                                      {1.962, "integrating along edges", 0.8571},
                                      {1.973, "integrating along edges", 0.9456},
                                      {1.976, "integrating along edges", 1},
                                      {1.983, "putting rows together", 0.01351},
                                      {1.988, "putting rows together", 0.3378},
                                      {1.993, "putting rows together", 0.6622},
                                      {1.997, "putting rows together", 1}};
static const moment few_half_planes[] = {{0, "tracing rays", 0.02703},
                                         {0.0544, "tracing rays", 0.08108},
                                         {0.0875, "tracing rays", 0.1081},
                                         {0.1487, "tracing rays", 0.1622},
                                         {0.2135, "tracing rays", 0.2162},
                                         {0.2808, "tracing rays", 0.2703},
                                         {0.3113, "tracing rays", 0.2973},
                                         {0.3788, "tracing rays", 0.3514},
                                         {0.4437, "tracing rays", 0.4054},
                                         {0.473, "tracing rays", 0.4324},
                                         {0.5431, "tracing rays", 0.4865},
                                         {0.6084, "tracing rays", 0.5405},
                                         {0.6723, "tracing rays", 0.5946},
                                         {0.7087, "tracing rays", 0.6216},
                                         {0.7713, "tracing rays", 0.6757},
                                         {0.8352, "tracing rays", 0.7297},
                                         {0.8703, "tracing rays", 0.7568},
                                         {0.9346, "tracing rays", 0.8108},
                                         {0.9984, "tracing rays", 0.8649},
                                         {1.061, "tracing rays", 0.9189},
                                         {1.085, "tracing rays", 0.9459},
                                         {1.131, "tracing rays", 1},
                                         {1.157, "measuring the sky", 0.02703},
                                         {1.202, "measuring the sky", 0.08108},
                                         {1.229, "measuring the sky", 0.1081},
                                         {1.279, "measuring the sky", 0.1622},
                                         {1.33, "measuring the sky", 0.2162},
                                         {1.386, "measuring the sky", 0.2703},
                                         {1.412, "measuring the sky", 0.2973},
                                         {1.466, "measuring the sky", 0.3514},
                                         {1.521, "measuring the sky", 0.4054},
                                         {1.546, "measuring the sky", 0.4324},
                                         {1.606, "measuring the sky", 0.4865},
                                         {1.664, "measuring the sky", 0.5405},
                                         {1.724, "measuring the sky", 0.5946},
                                         {1.755, "measuring the sky", 0.6216},
                                         {1.813, "measuring the sky", 0.6757},
                                         {1.868, "measuring the sky", 0.7297},
                                         {1.896, "measuring the sky", 0.7568},
                                         {1.95, "measuring the sky", 0.8108},
                                         {2.001, "measuring the sky", 0.8649},
                                         {2.053, "measuring the sky", 0.9189},
                                         {2.074, "measuring the sky", 0.9459},
                                         {2.113, "measuring the sky", 1},
                                         {2.115, "integrating along edges", 0.006803},
                                         {2.126, "integrating along edges", 0.04762},
                                         {2.138, "integrating along edges", 0.09524},
                                         {2.144, "integrating along edges", 0.1156},
                                         {2.154, "integrating along edges", 0.1633},
                                         {2.167, "integrating along edges", 0.2177},
                                         {2.178, "integrating along edges", 0.2585},
                                         {2.189, "integrating along edges", 0.3061},
                                         {2.195, "integrating along edges", 0.3265},
                                         {2.207, "integrating along edges", 0.381},
                                         {2.217, "integrating along edges", 0.4218},
                                         {2.228, "integrating along edges", 0.4694},
                                         {2.24, "integrating along edges", 0.517},
                                         {2.253, "integrating along edges", 0.5714},
                                         {2.259, "integrating along edges", 0.5986},
                                         {2.271, "integrating along edges", 0.6463},
                                         {2.283, "integrating along edges", 0.7007},
                                         {2.295, "integrating along edges", 0.7551},
                                         {2.305, "integrating along edges", 0.8095},
                                         {2.311, "integrating along edges", 0.8367},
                                         {2.322, "integrating along edges", 0.9048},
                                         {2.33, "integrating along edges", 1},
                                         {2.34, "putting rows together", 0.01351},
                                         {2.345, "putting rows together", 0.2568},
                                         {2.35, "putting rows together", 0.4865},
                                         {2.355, "putting rows together", 0.7297},
                                         {2.359, "putting rows together", 1}};
static const moment matrix_free[] = {
    {0, "tracing rays", 0.0004},      {0.048, "tracing rays", 0.0183},  {0.1013, "tracing rays", 0.0381},
    {0.1493, "tracing rays", 0.0559}, {0.2027, "tracing rays", 0.0757}, {0.2511, "tracing rays", 0.0936},
    {0.3054, "tracing rays", 0.1134}, {0.3537, "tracing rays", 0.1312}, {0.4067, "tracing rays", 0.1515},
    {0.4541, "tracing rays", 0.1698}, {0.5081, "tracing rays", 0.189},  {0.5543, "tracing rays", 0.2},
    {0.6063, "tracing rays", 0.2596}, {0.654, "tracing rays", 0.2779},  {0.7073, "tracing rays", 0.2971},
    {0.7533, "tracing rays", 0.3079}, {0.8052, "tracing rays", 0.3682}, {0.8539, "tracing rays", 0.387},
    {0.9065, "tracing rays", 0.4055}, {0.9525, "tracing rays", 0.4158}, {1.006, "tracing rays", 0.4773},
    {1.055, "tracing rays", 0.4961},  {1.108, "tracing rays", 0.5141},  {1.153, "tracing rays", 0.524},
    {1.207, "tracing rays", 0.5854},  {1.256, "tracing rays", 0.6042},  {1.309, "tracing rays", 0.6219},
    {1.355, "tracing rays", 0.6317},  {1.407, "tracing rays", 0.6944},  {1.457, "tracing rays", 0.7138},
    {1.509, "tracing rays", 0.7303},  {1.554, "tracing rays", 0.7396},  {1.607, "tracing rays", 0.8035},
    {1.654, "tracing rays", 0.8219},  {1.706, "tracing rays", 0.8378},  {1.752, "tracing rays", 0.8473},
    {1.805, "tracing rays", 0.9121},  {1.853, "tracing rays", 0.9302},  {1.905, "tracing rays", 0.946},
    {1.951, "tracing rays", 0.9552}};
static const moment matrix_free_dark[] = {
    {0, "tracing rays", 0.0011},      {0.0271, "tracing rays", 0.0247}, {0.0592, "tracing rays", 0.054},
    {0.0858, "tracing rays", 0.0765}, {0.1125, "tracing rays", 0.0969}, {0.144, "tracing rays", 0.1306},
    {0.1704, "tracing rays", 0.1531}, {0.1983, "tracing rays", 0.179},  {0.2309, "tracing rays", 0.2072},
    {0.257, "tracing rays", 0.2248},  {0.2829, "tracing rays", 0.2556}, {0.3144, "tracing rays", 0.2826},
    {0.3425, "tracing rays", 0.3085}, {0.3697, "tracing rays", 0.3322}, {0.4009, "tracing rays", 0.3521},
    {0.4276, "tracing rays", 0.3851}, {0.4538, "tracing rays", 0.4076}, {0.487, "tracing rays", 0.438},
    {0.5143, "tracing rays", 0.4617}, {0.5398, "tracing rays", 0.4771}, {0.5715, "tracing rays", 0.5146},
    {0.5979, "tracing rays", 0.5371}, {0.6257, "tracing rays", 0.563},  {0.6581, "tracing rays", 0.5903},
    {0.6836, "tracing rays", 0.6047}, {0.7104, "tracing rays", 0.6407}, {0.7424, "tracing rays", 0.67},
    {0.7687, "tracing rays", 0.6925}, {0.7953, "tracing rays", 0.7148}, {0.8259, "tracing rays", 0.7312},
    {0.8522, "tracing rays", 0.768},  {0.8786, "tracing rays", 0.7916}, {0.9102, "tracing rays", 0.8198},
    {0.9367, "tracing rays", 0.8417}, {0.962, "tracing rays", 0.8555},  {0.9937, "tracing rays", 0.8963},
    {1.022, "tracing rays", 0.9222},  {1.048, "tracing rays", 0.9448},  {1.079, "tracing rays", 0.9704},
    {1.105, "tracing rays", 0.9832}};
static const moment exact_search[] = {
    {0, "solving", 0},           {0.0001, "solving", 0},      {0.0001, "solving", 0},
    {0.0001, "solving", 0},      {0.0001, "solving", 0},      {0.0002, "solving", 0},
    {0.0004, "solving", 0},      {0.0008, "solving", 0},      {0.0012, "solving", 0},
    {0.0016, "solving", 0},      {0.0019, "solving", 0},      {0.0022, "solving", 0},
    {0.0025, "solving", 0},      {0.0029, "solving", 0},      {0.0032, "solving", 0},
    {0.0485, "solving", 0.0412}, {0.1089, "solving", 0.0985}, {0.1642, "solving", 0.1513},
    {0.2195, "solving", 0.2022}, {0.2748, "solving", 0.2546}, {0.3353, "solving", 0.3026},
    {0.3907, "solving", 0.3365}, {0.4461, "solving", 0.3672}, {0.5015, "solving", 0.4253},
    {0.5617, "solving", 0.4768}, {0.6172, "solving", 0.5194}, {0.6725, "solving", 0.5405},
    {0.7328, "solving", 0.5664}, {0.7881, "solving", 0.6103}, {0.8436, "solving", 0.6525},
    {0.899, "solving", 0.6772},  {0.9593, "solving", 0.69},   {1.015, "solving", 0.7014},
    {1.07, "solving", 0.7286},   {1.131, "solving", 0.768},   {1.186, "solving", 0.8029},
    {1.241, "solving", 0.8313},  {1.297, "solving", 0.8372},  {1.357, "solving", 0.8433},
    {1.412, "solving", 0.8482}};
static const moment sensors[] = {
    {0, "photons", 0.05596},     {0.0087, "photons", 0.1123}, {0.0174, "photons", 0.1679},
    {0.0259, "photons", 0.2236}, {0.0347, "photons", 0.2796}, {0.0433, "photons", 0.3358},
    {0.052, "photons", 0.3912},  {0.0605, "photons", 0.4464}, {0.069, "photons", 0.5015},
    {0.0774, "photons", 0.5568}, {0.0858, "photons", 0.6124}, {0.0944, "photons", 0.6681},
    {0.103, "photons", 0.7235},  {0.1115, "photons", 0.7793}, {0.1202, "photons", 0.8348},
    {0.129, "photons", 0.8905},  {0.1376, "photons", 0.9462}, {0.1463, "photons", 1},
    {0.2446, "sensors", 0.3333}, {0.3358, "sensors", 0.6667}, {0.3927, "sensors", 1}};

/* The total is unknown at first, or forever. */
static const moment error_by_paths[] = {
    {0.00172, "planning", NAN},      {0.01321, "planning", NAN},      {0.01463, "rendering", 0},
    {0.01938, "rendering", 0.00021}, {0.02531, "rendering", 0.00071}, {0.02885, "rendering", 0.00116},
    {0.0323, "rendering", 0.0016},   {0.03589, "rendering", 0.00206}, {0.05043, "rendering", 0.0074},
    {0.06121, "rendering", 0.01269}, {0.07786, "rendering", 0.02043}, {0.09572, "rendering", 0.02895},
    {0.1132, "rendering", 0.03747},  {0.1333, "rendering", 0.04657},  {0.1588, "rendering", 0.05852},
    {0.1904, "rendering", 0.07384},  {0.211, "rendering", 0.08454},   {0.2432, "rendering", 0.09992},
    {0.2636, "rendering", 0.11106},  {0.2934, "rendering", 0.12589},  {0.3318, "rendering", 0.14768},
    {0.3675, "rendering", 0.17017},  {0.3897, "rendering", 0.18678},  {0.4259, "rendering", 0.21052},
    {0.4619, "rendering", 0.23362},  {0.4872, "rendering", 0.25208},  {0.5268, "rendering", 0.27814},
    {0.5634, "rendering", 0.30307},  {0.5877, "rendering", 0.32013},  {0.6289, "rendering", 0.34737},
    {0.6614, "rendering", 0.37034},  {0.6842, "rendering", 0.38616},  {0.742, "rendering", 0.42394},
    {0.7993, "rendering", 0.46246},  {0.8424, "rendering", 0.49555},  {0.8822, "rendering", 0.52543},
    {0.9249, "rendering", 0.5579},   {0.9938, "rendering", 0.60342},  {1.037, "rendering", 0.63689},
    {1.07, "rendering", 0.66192},    {1.111, "rendering", 0.69278},   {1.185, "rendering", 0.74282},
    {1.231, "rendering", 0.77783},   {1.265, "rendering", 0.80354},   {1.303, "rendering", 0.833},
    {1.382, "rendering", 0.88684},   {1.431, "rendering", 0.9217},    {1.464, "rendering", 0.94554},
    {1.493, "rendering", 0.9778},    {1.494, "rendering", 0.9778}};
static const moment error_by_choice[] = {
    {0.00257, "planning", NAN}, {0.04072, "planning", NAN}, {0.08595, "planning", NAN},
    {0.1225, "planning", NAN},  {0.1595, "planning", NAN},  {0.196, "planning", NAN},
    {0.2347, "planning", NAN},  {0.2707, "planning", NAN},  {0.3068, "planning", NAN},
    {0.3433, "rendering", NAN}, {0.3796, "rendering", NAN}, {0.4163, "rendering", NAN},
    {0.4533, "rendering", NAN}, {0.4894, "rendering", NAN}, {0.5281, "rendering", NAN},
    {0.5645, "rendering", NAN}, {0.5772, "rendering", NAN}};
static const moment random_set[] = {
    {0.00093, "solving", NAN},     {0.03835, "solving", NAN},     {0.07577, "solving", NAN},
    {0.1132, "solving", NAN},      {0.1506, "solving", NAN},      {0.1881, "solving", NAN},
    {0.2256, "solving", NAN},      {0.263, "solving", NAN},       {0.3007, "solving", NAN},
    {0.3381, "solving", NAN},      {0.3756, "solving", NAN},      {0.4133, "solving", NAN},
    {0.4509, "solving", NAN},      {0.4883, "solving", NAN},      {0.5113, "solving", NAN},
    {0.5127, "solving", 0.012083}, {0.5148, "solving", 0.034666}, {0.5164, "solving", 0.057249},
    {0.5181, "solving", 0.079831}, {0.5197, "solving", 0.10241},  {0.5212, "solving", 0.125},
    {0.5229, "solving", 0.14758},  {0.5245, "solving", 0.17016},  {0.5262, "solving", 0.19274},
    {0.5277, "solving", 0.21533},  {0.5293, "solving", 0.23791},  {0.531, "solving", 0.26049},
    {0.5325, "solving", 0.28307},  {0.5343, "solving", 0.30566},  {0.5359, "solving", 0.32824},
    {0.5375, "solving", 0.35082},  {0.5391, "solving", 0.3734},   {0.5406, "solving", 0.39599},
    {0.5423, "solving", 0.418},    {0.5439, "solving", 0.43921},  {0.5456, "solving", 0.45965},
    {0.5472, "solving", 0.47935},  {0.5487, "solving", 0.49832},  {0.5509, "solving", 0.51661},
    {0.5549, "solving", 0.53659},  {0.5565, "solving", 0.55789},  {0.5581, "solving", 0.5792},
    {0.5598, "solving", 0.6005},   {0.5614, "solving", 0.62181},  {0.5629, "solving", 0.64312},
    {0.5646, "solving", 0.66442},  {0.5661, "solving", 0.68573},  {0.5678, "solving", 0.70704},
    {0.5693, "solving", 0.72834},  {0.5709, "solving", 0.74965},  {0.5728, "solving", 0.77096},
    {0.5744, "solving", 0.79226},  {0.5762, "solving", 0.81357},  {0.5777, "solving", 0.83488},
    {0.5793, "solving", 0.85618},  {0.581, "solving", 0.87749},   {0.5828, "solving", 0.89686},
    {0.5844, "solving", 0.91317},  {0.5861, "solving", 0.9269},   {0.5877, "solving", 0.93846},
    {0.5893, "solving", 0.9482},   {0.5909, "solving", 0.95639},  {0.5926, "solving", 0.96329},
    {0.5942, "solving", 0.96909},  {0.5964, "solving", 0.97398},  {0.5987, "solving", 0.97613}};
static const moment ggx_lobe[] = {
    {0.00051, "factoring", NAN}, {0.00063, "factoring", NAN},   {0.00074, "factoring", 0.024039},
    {0.3201, "factoring", NAN},  {0.6591, "factoring", NAN},    {1.088, "factoring", NAN},
    {1.371, "factoring", NAN},   {1.706, "factoring", NAN},     {2.103, "factoring", NAN},
    {2.562, "factoring", NAN},   {3.091, "factoring", 0.30855}, {3.708, "factoring", 0.6327},
    {4.408, "factoring", 0.6327}};
static const moment uneven_set[] = {
    {0.00051, "solving", NAN},     {0.07024, "solving", NAN},      {0.14, "solving", NAN},
    {0.2097, "solving", NAN},      {0.2793, "solving", NAN},       {0.3491, "solving", NAN},
    {0.4188, "solving", NAN},      {0.4884, "solving", NAN},       {0.5581, "solving", NAN},
    {0.6278, "solving", NAN},      {0.6975, "solving", NAN},       {0.7672, "solving", NAN},
    {0.8086, "solving", NAN},      {0.8087, "solving", 0.0026732}, {0.8151, "solving", 0.017809},
    {0.8208, "solving", 0.032945}, {0.8267, "solving", 0.04808},   {0.8325, "solving", 0.063216},
    {0.8383, "solving", 0.078352}, {0.8441, "solving", 0.093488},  {0.8499, "solving", 0.10862},
    {0.8557, "solving", 0.12376},  {0.8614, "solving", 0.13889},   {0.8672, "solving", 0.15403},
    {0.873, "solving", 0.16917},   {0.8787, "solving", 0.1843},    {0.8845, "solving", 0.19944},
    {0.8902, "solving", 0.21457},  {0.8959, "solving", 0.22971},   {0.9015, "solving", 0.24484},
    {0.9072, "solving", 0.25998},  {0.9129, "solving", 0.27494},   {0.9188, "solving", 0.28959},
    {0.9246, "solving", 0.30395},  {0.9304, "solving", 0.31802},   {0.9361, "solving", 0.3318},
    {0.9419, "solving", 0.34531},  {0.9476, "solving", 0.35854},   {0.9549, "solving", 0.37347},
    {0.9617, "solving", 0.40111},  {0.9679, "solving", 0.42875},   {0.9741, "solving", 0.45639},
    {0.9803, "solving", 0.48403},  {0.9865, "solving", 0.51168},   {0.9929, "solving", 0.53932},
    {0.9991, "solving", 0.56696},  {1.005, "solving", 0.5946},     {1.012, "solving", 0.62224},
    {1.018, "solving", 0.64988},   {1.025, "solving", 0.67752},    {1.031, "solving", 0.70516},
    {1.037, "solving", 0.7328},    {1.043, "solving", 0.76044},    {1.05, "solving", 0.78809},
    {1.056, "solving", 0.81573},   {1.062, "solving", 0.84337},    {1.069, "solving", 0.86837},
    {1.075, "solving", 0.88939},   {1.081, "solving", 0.90704},    {1.088, "solving", 0.92188},
    {1.094, "solving", 0.93435},   {1.1, "solving", 0.94483},      {1.107, "solving", 0.95364},
    {1.115, "solving", 0.9599}};

typedef struct series {
    const char *command;
    const moment *moments;
    size_t count;
    cli_phase phases[4]; /* as the command declares them */
    size_t phase_count;
} series;

#define MOMENTS(name) name, sizeof name / sizeof name[0]

static const series recorded[] = {
    {"render cornell-box.xml --width 96 --spp 64",
     MOMENTS(image),
     {{"photons", 5e5}, {"rendering", 1769472}},
     2},
    {"render cornell-box.xml --width 128 --spp 8 --integrator finalgather",
     MOMENTS(photon_map),
     {{"photons", 5e5}, {"rendering", 393216}},
     2},
    {"viewfactors city.obj",
     MOMENTS(view_factors),
     {{"tracing rays", 2048},
      {"measuring the sky", 9216},
      {"integrating along edges", 1024},
      {"putting rows together", 64}},
     4},
    {"viewfactors city.obj --rays 8192 --half-planes 2048",
     MOMENTS(few_half_planes),
     {{"tracing rays", 8192},
      {"measuring the sky", 6144},
      {"integrating along edges", 1024},
      {"putting rows together", 64}},
     4},
    {"viewfactors city.obj --radiosity .8 --sun 1,1,1 --matrix-free", MOMENTS(matrix_free), {{NULL, 0}}, 0},
    {"viewfactors city.obj --radiosity .5 --matrix-free", MOMENTS(matrix_free_dark), {{NULL, 0}}, 0},
    {"weights spherical-fibonacci -n 4000 --method exact", MOMENTS(exact_search), {{NULL, 0}}, 0},
    {"render cornell-box.xml --error .02 --integrator path --width 64",
     MOMENTS(error_by_paths),
     {{NULL, 0}},
     0},
    {"render cornell-box.xml --error .05 --width 96", MOMENTS(error_by_choice), {{NULL, 0}}, 0},
    {"weights --method exact of 6,000 random points", MOMENTS(random_set), {{NULL, 0}}, 0},
    {"weights --method exact of 5,000 points of half a spherical Fibonacci set",
     MOMENTS(uneven_set),
     {{NULL, 0}},
     0},
    {"weights --method exact, 1,200 points, GGX .4", MOMENTS(ggx_lobe), {{NULL, 0}}, 0},
    {"irradiance cornell-box.xml --reflected map, 42 sensors",
     MOMENTS(sensors),
     {{"photons", 5e5}, {"radiosity", 0}, {"sensors", 688128}},
     3},
};

/* After a tenth of the time the remaining time is known to a factor of two until a tenth is left, unless the
 * total is unknown; it is never negative, and the share never decreases. */
static void test_recorded(void **state) {
    (void)state;
    for (size_t s = 0; s < sizeof recorded / sizeof recorded[0]; ++s) {
        const series *const of = &recorded[s];
        const double end = of->moments[of->count - 1].time;
        cli_estimate e = cli_estimate_of(of->phase_count, of->phases);
        double share = 0.0, waited = -1.0;
        size_t checked = 0, unknown = 0;
        for (size_t i = 0; i < of->count; ++i) {
            const moment *const m = &of->moments[i];
            cli_estimate_report(&e, m->time, m->what, m->fraction);
            const double left = end - m->time;
            assert_true(e.share >= share && e.share < 1.0 && !(e.left < 0.0));
            share = e.share;
            if (isnan(m->fraction)) {
                assert_true(isnan(e.left));
                waited = m->time;
                ++unknown;
                continue;
            }
            /* The first report after those gives little information on the rate. */
            if (m->time < 0.1 * end || left < 0.1 * end || (waited >= 0.0 && isnan(e.left)))
                continue;
            if (!(e.left > 0.5 * left && e.left < 2.0 * left))
                fail_msg("%s: at %g s %g s are left, not %g", of->command, m->time, left, e.left);
            ++checked;
        }
        assert_true(checked > 3 || unknown > of->count / 2);
        assert_true(share > 0.8 || unknown > of->count / 2);
    }
}

/* Work at a constant rate, as one phase and as phases with correct shares: the share and the remaining time
 * are exact. */
static void test_exact(void **state) {
    (void)state;
    static const cli_phase phases[] = {{"a", 2.0}, {"left out", 0.0}, {"b", 5.0}, {NULL, 3.0}};
    for (size_t count = 1; count <= 4; count += 3) {
        cli_estimate e = cli_estimate_of(count == 1 ? 0 : count, phases);
        for (int i = 0; i <= 100; ++i) {
            const double time = 7.0 + 0.1 * i, done = i / 10.0;
            if (count == 1)
                cli_estimate_report(&e, time, "a", done / 10.0);
            else if (i == 70)
                cli_estimate_begin(&e, time, 3);
            else if (i < 70)
                cli_estimate_report(&e, time, i < 20 ? "a" : "b", i < 20 ? done / 2.0 : (done - 2.0) / 5.0);
            else
                cli_estimate_report(&e, time, "whatever", (done - 7.0) / 3.0);
            if (i < 3 || i == 70)
                continue;
            assert_true(fabs(e.left - (17.0 - time)) < 1e-9);
            assert_true(fabs(e.share - fmin(done / 10.0, 0.99)) < 1e-9);
        }
    }
}

/* A resumed render begins at its former share, and the remaining time follows its rate since then. */
static void test_resumed(void **state) {
    (void)state;
    cli_estimate e = cli_estimate_of(0, NULL);
    cli_estimate_report(&e, 0.0, "rendering", 0.9);
    assert_true(e.share == 0.9 && isnan(e.left));
    cli_estimate_report(&e, 10.0, "rendering", 0.95);
    assert_true(fabs(e.left - 10.0) < 1e-9 && fabs(e.share - 0.95) < 1e-9);
}

/* Unannounced phases, decreasing fractions, stopped clocks, an unknown total: the share never decreases, no
 * time is negative. */
static void test_disorder(void **state) {
    (void)state;
    static const cli_phase phases[] = {{"b", 1.0}};
    uint64_t random = 1;
    for (size_t count = 0; count < 2; ++count) {
        cli_estimate e = cli_estimate_of(count, phases);
        double share = 0.0, time = 0.0;
        for (int i = 0; i < 10000; ++i) {
            random = random * UINT64_C(6364136223846793005) + 1442695040888963407u;
            time += random >> 61 > 3 ? 0.01 : 0.0;
            const char *const what[] = {"a", "b", "c"};
            cli_estimate_report(&e, time, what[(random >> 40) % 3], (double)(random >> 32 & 15) / 15.0);
            assert_true(e.share >= share && e.share < 1.0 && !(e.left < 0.0));
            share = e.share;
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_recorded), cmocka_unit_test(test_exact),
                                       cmocka_unit_test(test_resumed), cmocka_unit_test(test_disorder)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
