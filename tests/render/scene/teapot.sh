#!/usr/bin/env bash
# The teapot of the bundled scenes is what its program makes, and that is the Utah teapot: its known bounds, and a surface
# whose only edges are the rim, the lid's edge and the ends of handle and spout.
set -u
teapot=$(dirname "$1")/teapot
mesh=$2/scenes/cornell-box/meshes/teapot.obj
"$teapot" made.obj || exit 1
cmp made.obj "$mesh" || { echo "make it again: cmake --build --preset release --target scene-meshes"; exit 1; }

cat >check.awk <<'AWK'
function root(f) { while (part[f] != f) f = part[f] = part[part[f]]; return f }
function fail(text) { print FILENAME ": " text; bad = 1 }
function near(what, value, expected, tolerance) {
    if (!(value - expected <= tolerance && expected - value <= tolerance)) fail(what " is " value ", not " expected)
}
$1 == "v" { ++vertices; for (k = 1; k <= 3; ++k) p[vertices, k] = $(k + 1) }
$1 == "vn" { ++normals; for (k = 1; k <= 3; ++k) n[normals, k] = $(k + 1) }
$1 == "f" {
    part[++faces] = faces
    for (i = 1; i <= 3; ++i) { split($(i + 1), corner, "/"); c[faces, i] = corner[1] }
    for (i = 1; i <= 3; ++i) {
        edge = c[faces, i] SUBSEP c[faces, i % 3 + 1]
        if (edge in owner) fail("edge " c[faces, i] " " c[faces, i % 3 + 1] " has two faces on one side")
        owner[edge] = faces
    }
}
END {
    for (k = 1; k <= 3; ++k) {
        low[k] = high[k] = p[1, k]
        for (v = 2; v <= vertices; ++v) {
            if (p[v, k] < low[k]) low[k] = p[v, k]
            if (p[v, k] > high[k]) high[k] = p[v, k]
        }
    }
    # The spout's lip, 3.4335 of the smooth surface, is not at a corner of a patch.
    near("least x", low[1], -3, 1e-6); near("greatest x", high[1], 3.4335, 1e-3)
    near("least y", low[2], -2, 1e-6); near("greatest y", high[2], 2, 1e-6)
    near("least z", low[3], 0, 1e-6); near("greatest z", high[3], 3.15, 1e-6)

    for (edge in owner) {
        split(edge, end, SUBSEP)
        other = end[2] SUBSEP end[1]
        if (other in owner) part[root(owner[edge])] = root(owner[other])
        else ++open_edges
    }
    # Two rings of 4 patches (rim, lid) and four of 2 (the ends of handle and spout), 8 edges a patch.
    near("number of open edges", open_edges, 8 * (2 * 4 + 4 * 2), 0)

    # Every face on the side of its normals; each piece (pot, lid, handle, spout) with a positive volume about its middle.
    for (f = 1; f <= faces; ++f) for (k = 1; k <= 3; ++k) {
        ++count[root(f), k]; middle[root(f), k] += p[c[f, 1], k]
    }
    for (f = 1; f <= faces; ++f) {
        r = root(f)
        for (i = 1; i <= 3; ++i) for (k = 1; k <= 3; ++k) q[i, k] = p[c[f, i], k] - middle[r, k] / count[r, k]
        for (k = 1; k <= 3; ++k) {
            a = k % 3 + 1; b = a % 3 + 1
            volume[r] += q[1, k] * (q[2, a] * q[3, b] - q[2, b] * q[3, a]) / 6
            g[k] = (q[2, a] - q[1, a]) * (q[3, b] - q[1, b]) - (q[2, b] - q[1, b]) * (q[3, a] - q[1, a])
        }
        for (i = 1; i <= 3; ++i) {
            v = c[f, i]
            if (!(g[1] * n[v, 1] + g[2] * n[v, 2] + g[3] * n[v, 3] > 0)) fail("face " f " lies against its normals")
        }
    }
    for (r in volume) { ++pieces; if (!(volume[r] > 0)) fail("a piece is inside out") }
    near("number of pieces", pieces, 4, 0)
    exit bad
}
AWK
awk -f check.awk made.obj || exit 1

# It writes whole files or none, and refuses what it cannot do.
"$teapot" missing-folder/teapot.obj 2>message && { echo "wrote into a folder that does not exist"; exit 1; }
grep -q missing-folder message || { echo "the message does not name the file"; exit 1; }
"$teapot" none.obj 0 2>/dev/null && { echo "accepted no subdivision"; exit 1; }
[ ! -e none.obj ]
