#!/usr/bin/env bash
# scripts/site.sh makes the site with every link right, and says which is not; no page is wider than a phone of 390 pixels,
# and the search finds a section by its words.
set -u
tree=$2
/usr/bin/python3 -c 'import markdown_it' 2>/dev/null || { echo "skipped: there is no python3-markdown-it"; exit 77; }
status=0
fail() { echo "FAILED: $*"; status=1; }

BUILD=$(dirname "$1") DOXYGEN='' "$tree/scripts/site.sh" "$PWD/site" >log.txt 2>&1 || fail "$(cat log.txt)"
for page in index.html docs/keys.html docs/gallery.html docs/papers/marques-2013.html include/aureole/core.h.html docs/gallery/room.jpg docs/report/index.html; do
  [ -s "site/$page" ] || fail "there is no $page"
done
grep -q 'https\?://[^"]*\.\(js\|css\)' site/index.html && fail "a page asks the network for a script or a style"

# A small tree, one link of which leads nowhere, and another to a heading that is none.
mkdir -p small/docs small/scripts
cp -r "$tree/scripts/site" "$tree/scripts/site.sh" small/scripts
printf '# One\n\n[index](docs/README.md#two)\n' >small/README.md
printf '# Two\n\n[back](../README.md)\n' >small/docs/README.md
DOXYGEN='' small/scripts/site.sh "$PWD/right" >log.txt 2>&1 || fail "a small tree: $(cat log.txt)"
printf '# Two\n\n[back](../REDME.md) [head](../README.md#tow)\n' >small/docs/README.md
DOXYGEN='' small/scripts/site.sh "$PWD/wrong" >log.txt 2>&1
[ $? = 1 ] || fail "links that lead nowhere are not refused"
for text in "docs/README.html: nothing is at '../REDME.md'" "'../index.html#tow': the page has no such heading"; do
  grep -qF -- "$text" log.txt || fail "no \"$text\" in $(cat log.txt)"
done

if command -v chromium >/dev/null; then
  {
    echo '<body><script>'
    echo "const pages = [$(cd site && find . -name '*.html' -not -path './docs/report/*' -printf '"%P",')];"
    cat <<'JS'
const show = text => { const line = document.createElement('p'); line.textContent = text; document.body.append(line); };
const open = page => new Promise(done => {
  const frame = document.createElement('iframe');
  Object.assign(frame, {width: 390, height: 800, src: 'site/' + page, onload: () => done(frame)});
  document.body.append(frame);
});
async function look() {
  for (const page of pages) {
    const frame = await open(page), width = frame.contentDocument.documentElement.scrollWidth;
    if (width > 390) show(`${page} is ${width} pixels wide`);
    frame.remove();
  }
  const frame = await open('docs/glossary.html'), inner = frame.contentDocument, box = inner.getElementById('search');
  box.value = 'which integrator renders';
  box.dispatchEvent(new Event('input'));
  for (let i = 0; i < 200 && !inner.querySelector('#found a'); ++i) await new Promise(then => setTimeout(then, 20));
  show('found ' + inner.querySelector('#found a')?.getAttribute('href'));
  document.title = 'looked';
}
look();
</script>
JS
  } >look.html
  timeout 100 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$PWD/chromium" --allow-file-access-from-files \
    --virtual-time-budget=60000 --dump-dom "file://$PWD/look.html" >dom.html 2>chromium.txt
  grep -q '<title>looked' dom.html || fail "chromium did not end: $(tail -2 chromium.txt)"
  ! grep -o '<p>[^<]*pixels wide' dom.html || fail "pages are wider than a phone"
  grep -q '<p>found \.\./docs/target-error.html#which-integrator-renders' dom.html || fail "the search says $(grep -o '<p>found[^<]*' dom.html)"
  rm -rf chromium
fi
exit $status
