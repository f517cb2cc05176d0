'use strict';
// Searches the sections of all pages: those that have every word, words of headings first. The index is loaded when it is first needed.
const box = document.getElementById('search'), list = document.getElementById('found'), menu = document.getElementById('menu');
const up = document.body.dataset.up, shown = 30;
if (matchMedia('(min-width: 64rem)').matches) menu.open = true;

function whenLoaded(then) {
  if (typeof sections !== 'undefined') return then();
  const script = document.createElement('script');
  script.src = up + 'search-index.js';
  script.onload = then;
  document.head.append(script);
}

// How well a section fits, 0 where a word is missing.
function score([page, anchor, title, heading, text], words) {
  const name = (title + ' ' + heading).toLowerCase(), body = text.toLowerCase();
  let sum = 0;
  for (const word of words) {
    const inName = name.includes(word), count = body.split(word, 6).length - 1;
    if (!inName && count === 0) return 0;
    sum += (inName ? 10 : 0) + count;
  }
  return sum;
}

function search() {
  const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
  list.replaceChildren();
  list.hidden = words.length === 0;
  if (list.hidden) return;
  const found = sections.map(section => [score(section, words), section]).filter(([fit]) => fit > 0);
  found.sort(([a], [b]) => b - a);
  for (const [, [page, anchor, title, heading, text]] of found.slice(0, shown)) {
    const item = document.createElement('li'), link = document.createElement('a'), around = document.createElement('small');
    link.href = up + page + (anchor && '#' + anchor);
    link.textContent = heading === title ? title : title + ': ' + heading;
    const at = Math.max(0, text.toLowerCase().indexOf(words[0]) - 40);
    around.textContent = text.slice(at, at + 140);
    link.append(around);
    item.append(link);
    list.append(item);
  }
  if (found.length === 0) list.textContent = 'No section has all these words.';
}

box.addEventListener('input', () => whenLoaded(search));
document.addEventListener('keydown', event => {
  if (event.key === '/' && document.activeElement !== box) { box.focus(); event.preventDefault(); }
  if (event.key === 'Escape') { box.value = ''; list.hidden = true; }
});
list.addEventListener('click', () => { list.hidden = true; });
