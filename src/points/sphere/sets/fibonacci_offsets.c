/* Cosines and sines of k/Phi turns, rounded to the nearest double, for the points of a block; the first ones
 * are repeated after the last, so that a vector may begin anywhere. */
#include "points/sphere/sets/fibonacci.h"

/* clang-format off */
const double aur_golden_cosines[AUR_FIBONACCI_BLOCK + AUR_FIBONACCI_WRAPPED] = {
    1.0, -0x1.798869e0de834p-1, 0x1.66188447d0aa7p-4, 0x1.37854c630a165p-1,
    -0x1.f82c5daeb84a5p-1, 0x1.b000b1aa1798bp-1, -0x1.09d5b5fdcf94dp-2, -0x1.d7f802d68ff4ep-2,
    0x1.e0eeb8904bfc4p-1, -0x1.d943d21ba12ecp-1, 0x1.b204af3d15dfcp-2, 0x1.327778280b7b5p-2,
    -0x1.bafcf6b40ba06p-1, 0x1.f40ed8d50e99fp-1, -0x1.26775d523ea28p-1, -0x1.07309ccefc01ep-3,
    0x1.878012b8ce4efp-1, -0x1.ff901253c7077p-1, 0x1.6aebb061c0866p-1, -0x1.7a667bb5671a5p-5,
    -0x1.480b076fbbfe1p-1, 0x1.fb6d7337827bcp-1, -0x1.a4478b3fd5bb4p-1, 0x1.c17f72b7f4cc6p-3,
    0x1.fd1cfbb8b0b68p-2, -0x1.e7c7590263f00p-1, 0x1.d0c9ffdcafff3p-1, -0x1.8b5398a94e566p-2,
    -0x1.5a933bfe674f6p-2, 0x1.c5378cc8d2a73p-1, -0x1.ef16b14938889p-1, 0x1.14e8af1d6165bp-1,
    0x1.5ae1e50d01882p-3, -0x1.94cc8f8fad776p-1, 0x1.fe407a3f141f7p-1, -0x1.5bb049c0cebe0p-1,
    0x1.3fb3e8e0bd01ap-8, 0x1.580155254e26ep-1, -0x1.fdd0ad31a57b3p-1, 0x1.97d6a39f39accp-1,
    -0x1.6e8ef1e029ce4p-3, -0x1.10b1ae2fab49ep-1, 0x1.edcab5292ff63p-1, -0x1.c784f6841d18ap-1,
    0x1.63f5a9cffcea9p-2, 0x1.8217783a493d0p-2, -0x1.ceabfb023b15ep-1, 0x1.e9461341702a0p-1,
    -0x1.02e0eeeee2580p-1, -0x1.adfb834c38658p-3, 0x1.a1680fe298e54p-1, -0x1.fc11ca7c69d1ap-1,
    0x1.4bdcdee3c642dp-1, 0x1.2a8afa778b5bfp-5, -0x1.67613ae64bdbdp-1, 0x1.ff55005f85f3ep-1,
    -0x1.8ab36b499720ep-1, 0x1.1afe2cbc8f13bp-3, 0x1.225da44c853a6p-1, -0x1.f2f62bfa9353fp-1,
    0x1.bd78c39c1bfc2p-1, -0x1.3bfc18f823d51p-2, -0x1.a8f2e5d591e62p-2, 0x1.d7561f1d53a86p-1,
    1.0, -0x1.798869e0de834p-1, 0x1.66188447d0aa7p-4, 0x1.37854c630a165p-1,
    -0x1.f82c5daeb84a5p-1, 0x1.b000b1aa1798bp-1, -0x1.09d5b5fdcf94dp-2,
};

const double aur_golden_sines[AUR_FIBONACCI_BLOCK + AUR_FIBONACCI_WRAPPED] = {
    0.0, -0x1.59d9dd253cc11p-1, 0x1.fe0a21737932bp-1, -0x1.9652d671c1faep-1,
    0x1.64b981a3760d6p-3, 0x1.12ce04f1c06b7p-1, -0x1.ee7234cb6576ep-1, 0x1.c65fa3f8fd68bp-1,
    -0x1.5f4584d379bf0p-2, -0x1.86b6b91fea8d2p-2, 0x1.cfbc670efc442p-1, -0x1.e88833177a625p-1,
    0x1.00b87e96b831ap-1, 0x1.b7bed1ec6244ap-3, -0x1.a2d9142fc3172p-1, 0x1.fbc12accea63dp-1,
    -0x1.49f4f476fbdbcp-1, -0x1.5279c3084e108p-5, 0x1.69278f453d6d8p-1, -0x1.ff74182f05a82p-1,
    0x1.891af18cbaef8p-1, -0x1.111839bb9aeb9p-3, -0x1.246b64d709abdp-1, 0x1.f38407ee0eb59p-1,
    -0x1.bc3c3792ad69ap-1, 0x1.373abb42c465dp-2, 0x1.ad7d1974136a3p-2, -0x1.d84e68eae66e9p-1,
    0x1.e1c898c6a8988p-1, -0x1.dc6573ca94ab7p-2, -0x1.0501ef1a6549dp-2, 0x1.aea830f144bdcp-1,
    -0x1.f89a33fd61539p-1, 0x1.397fc83cfb0aep-1, 0x1.522fc4834e6b1p-4, -0x1.77d759f1887dap-1,
    0x1.fffe70bd87846p-1, -0x1.7b372d0290a9ep-1, 0x1.79ff158f21e34p-4, 0x1.3588eaaf7418bp-1,
    -0x1.f7bb751000854p-1, 0x1.b15690a1aa0cbp-1, -0x1.0ea7de481d03cp-2, -0x1.d387b1cc72c0fp-2,
    0x1.e011ea48fdd36p-1, -0x1.da365930c53d4p-1, 0x1.b689a02019bc0p-2, 0x1.2db257158b417p-2,
    -0x1.b9bb02f21fa07p-1, 0x1.f4969dd7135dep-1, -0x1.28818a8cf3c9cp-1, -0x1.fa8ecad284968p-4,
    0x1.85e2d14e9d3a7p-1, -0x1.ffa8eea227eedp-1, 0x1.6cad9b7ab025ap-1, -0x1.a250e63a84d1bp-5,
    -0x1.461f1aca1e4dap-1, 0x1.fb16a43ec2f82p-1, -0x1.a5b372d746187p-1, 0x1.cb3d56792d1f0p-3,
    0x1.f8c5e03f93a08p-2, -0x1.e703862ef2cd0p-1, 0x1.d1d4c3c6df1e2p-1, -0x1.8fee0fa4c1944p-2,
    0.0, -0x1.59d9dd253cc11p-1, 0x1.fe0a21737932bp-1, -0x1.9652d671c1faep-1,
    0x1.64b981a3760d6p-3, 0x1.12ce04f1c06b7p-1, -0x1.ee7234cb6576ep-1,
};
/* clang-format on */
