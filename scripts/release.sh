#!/usr/bin/env bash
# Makes the files of a release of HEAD in FOLDER (build/release-VERSION): builds, runs every test, and writes the source archive, packages,
# the wheel, the changelog's section and the checksums of all. It uploads nothing and makes no tag: it says the command for that.
#   scripts/release.sh [FOLDER]
#   scripts/release.sh --notes      prints the changelog's section of the version alone
#   TESTS=REGEX                     only tests whose name matches, which the last lines say; a release has all
#   SIGN_KEY=KEY                    the key of gpg that signs the checksums; without one nothing is signed, and that is said
# Exit status 1 where a test or a package fails, 2 where the tree is not that of a release.
set -euo pipefail
cd "$(dirname "$0")/.."

version=$(sed -n 's/^#define AUREOLE_VERSION_\(MAJOR\|MINOR\|PATCH\) *//p' include/aureole/version.h | paste -sd.)
refuse() {
  echo "release.sh: $*" >&2
  exit 2
}
# What changed in this version, from the changelog.
notes() {
  awk -v heading="## [$version]" 'index($0, heading) == 1 { on = 1; next } /^## / { on = 0 } on' CHANGELOG.md | sed '/./,$!d'
}
[ -n "$(notes)" ] || refuse "CHANGELOG.md has no section [$version], which include/aureole/version.h names"
if [ "${1:-}" = --notes ]; then
  notes
  exit
fi
[ -z "$(git status --porcelain)" ] || refuse "there are changes that are not committed, which no archive of HEAD has"
grep -q "^version: $version\$" CITATION.cff || refuse "CITATION.cff is not of version $version"
unreleased=$(awk '/^## \[Unreleased\]/ { on = 1; next } /^## / { on = 0 } on && NF' CHANGELOG.md)
[ -z "$unreleased" ] || refuse "CHANGELOG.md still has lines under [Unreleased]: move them to [$version], or give a new version"

folder=${1:-build/release-$version}
[ -z "$(ls -A "$folder" 2>/dev/null)" ] || refuse "$folder is not empty"
mkdir -p "$folder"
folder=$(realpath "$folder")
said=() # what the last lines say

echo "== build"
cmake --preset release --log-level=WARNING -DCMAKE_INSTALL_PREFIX=/usr # where Debian's packages put things
cmake --build --preset release -j "$(nproc)"
echo "== tests"
ctest --preset release -j "$(nproc)" ${TESTS:+-R "$TESTS"} </dev/null
[ -z "${TESTS:-}" ] || said+=("only the tests '$TESTS' were run: this is no release")

outdated=$(python3 scripts/lab_stamps.py --stale)
[ -z "$outdated" ] || said+=("sources have changed since these tables of the lab were kept (aureole lab check): ${outdated//$'\n'/ }")

echo "== source"
# The same bytes wherever it is made: git sorts the files and gives them the commit's time, and gzip keeps no name and no time.
git archive --prefix="aureole-$version/" HEAD | gzip -n -9 >"$folder/aureole-$version.tar.gz"

echo "== packages"
if [ -e build/release/CPackConfig.cmake ]; then
  (cd build/release && cpack -B "$folder/packages" >"$folder/cpack.log") || { tail -20 "$folder/cpack.log"; exit 1; }
  find "$folder/packages" -maxdepth 1 -type f -exec mv {} "$folder" \;
  rm -rf "$folder/packages" "$folder/cpack.log"
else
  tree=aureole-$version-$(uname -s | tr '[:upper:]' '[:lower:]')-$(uname -m)
  cmake --install build/release --strip --prefix "$folder/$tree" >/dev/null
  tar -C "$folder" --sort=name --mtime="@$(git log -1 --format=%ct)" --owner=0 --group=0 --numeric-owner -cf - "$tree" | gzip -n -9 >"$folder/$tree.tar.gz"
  rm -rf "${folder:?}/$tree"
fi
if "${PYTHON:-python3}" -c 'import venv, ensurepip' 2>/dev/null && scripts/wheel.sh "$folder" >"$folder/wheel.log" 2>&1; then
  cat "$folder/wheel.log"
else
  tail -5 "$folder/wheel.log" 2>/dev/null || true
  said+=("no wheel: scripts/wheel.sh needs Python's venv and PyPI")
fi
rm -f "$folder/wheel.log"
notes >"$folder/NOTES.md"

echo "== checksums"
(cd "$folder" && sha256sum -- * >../SHA256SUMS.new && mv ../SHA256SUMS.new SHA256SUMS && sha256sum --quiet -c SHA256SUMS && cat SHA256SUMS)
key=${SIGN_KEY:-$(git config user.signingkey || true)}
if [ -n "$key" ] && command -v gpg >/dev/null && gpg --list-secret-keys "$key" >/dev/null 2>&1; then
  gpg --batch --yes --local-user "$key" --armor --detach-sign "$folder/SHA256SUMS"
else
  said+=("not signed: there is no secret key (SIGN_KEY, or git's user.signingkey) for gpg")
fi
for file in SECURITY.md CODE_OF_CONDUCT.md; do
  ! grep -q '^Contact: none is set' "$file" || said+=("$file has no contact: whoever publishes it writes one into its line 'Contact:'")
done
printf 'release.sh: %s\n' "${said[@]}" "the files are in $folder" "tag the commit: git tag -a v$version -m 'Aureole $version' $(git rev-parse --short HEAD)"
