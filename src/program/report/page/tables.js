// Tables: a press on a column's name sorts by it, and the link below gives the data as CSV.
'use strict';
function sortTable(table, column, down) {
  const value = row => {
    const cell = row.cells[column];
    return cell.className === 'number' ? Number(cell.title) : cell.textContent;
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
for (const data of document.querySelectorAll('script.csv')) {
  const link = document.createElement('a');
  link.download = data.dataset.name;
  link.textContent = data.dataset.name;
  link.href = URL.createObjectURL(new Blob([JSON.parse(data.textContent)], {type: 'text/csv'}));
  data.after(link);
}
for (const button of document.querySelectorAll('button.theme'))
  button.addEventListener('click', () => {
    const style = document.documentElement.style, dark = matchMedia('(prefers-color-scheme: dark)').matches;
    style.colorScheme = style.colorScheme === '' ? (dark ? 'light' : 'dark') : style.colorScheme === 'dark' ? 'light' : 'dark';
  });
// The part of the address behind #: theme=dark, sort=TABLE,COLUMN, and what viewer.js reads.
const wanted = new URLSearchParams(location.hash.slice(1));
if (wanted.has('theme'))
  document.documentElement.style.colorScheme = wanted.get('theme');
if (wanted.has('sort')) {
  const [table, column] = wanted.get('sort').split(',').map(Number);
  sortTable(document.querySelectorAll('table')[table], column, wanted.has('down'));
}
