// Tables: a click on a column's name sorts by it; the link below saves the data as CSV.
'use strict';
// Numbers have five digits; the title holds all digits.
function exact(cell) {
  return cell.title || cell.textContent;
}
function csvOf(table) {
  const quoted = text => /[",\n]/.test(text) ? '"' + text.replaceAll('"', '""') + '"' : text;
  return [...table.rows].map(row => [...row.cells].map(cell => quoted(exact(cell))).join(',') + '\n').join('');
}
function sortTable(table, column, down) {
  const value = row => {
    const cell = row.cells[column];
    return cell.className === 'number' ? Number(exact(cell)) : cell.textContent;
  };
  const order = (a, b) => {
    const x = value(a), y = value(b);
    if (typeof x === typeof y)
      return x < y ? -1 : x > y ? 1 : 0;
    return typeof x === 'number' ? -1 : 1;
  };
  const rows = [...table.tBodies[0].rows].sort((a, b) => down ? order(b, a) : order(a, b));
  table.tBodies[0].append(...rows);
  [...table.tHead.rows[0].cells].forEach((head, i) => {
    if (i === column)
      head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    else
      head.removeAttribute('aria-sort');
  });
}
for (const table of document.querySelectorAll('table'))
  [...table.tHead.rows[0].cells].forEach((head, i) => head.querySelector('button').addEventListener('click', () =>
    sortTable(table, i, head.getAttribute('aria-sort') === 'ascending')));
for (const link of document.querySelectorAll('a.csv')) {
  const csv = csvOf(link.parentElement.previousElementSibling.querySelector('table'));
  link.download = link.dataset.name;
  link.textContent = link.dataset.name;
  link.href = URL.createObjectURL(new Blob([csv], {type: 'text/csv'}));
}
for (const button of document.querySelectorAll('button.theme'))
  button.addEventListener('click', () => {
    const style = document.documentElement.style, dark = matchMedia('(prefers-color-scheme: dark)').matches;
    style.colorScheme = style.colorScheme === '' ? (dark ? 'light' : 'dark') : style.colorScheme === 'dark' ? 'light' : 'dark';
  });
// The fragment of the URL: theme=dark, sort=TABLE,COLUMN, and the viewer's state (viewer.js).
const wanted = new URLSearchParams(location.hash.slice(1));
if (wanted.has('theme'))
  document.documentElement.style.colorScheme = wanted.get('theme');
if (wanted.has('sort')) {
  const [table, column] = wanted.get('sort').split(',').map(Number);
  sortTable(document.querySelectorAll('table')[table], column, wanted.has('down'));
}
