// SPDX-License-Identifier: BSD-3-Clause
// Asks the built site's search for each line of search_words.txt, with the very function that its pages call: the
// page that the line names has to come first.
//
//   node search_check.js HTML WORDS            a line for each that misses, and 1, if there is one
//   node search_check.js HTML WORDS --try      each word with the page of another, and an index without its task
//                                              pages: both have to fail
//   node search_check.js HTML --ask WORDS...   what is found, best first
'use strict';
const fs = require('fs');
const path = require('path');

const [site, list, ...rest] = process.argv.slice(2);
if (list === undefined) {
  console.error('usage: node search_check.js HTML WORDS [--try] | HTML --ask WORDS...');
  process.exit(2);
}
const read = name => fs.readFileSync(path.join(site, name), 'utf8');
const index = new Function(read('search_index.js') + 'return search_index;')();
const rank = new Function(read('search.js') + 'return rank;')();
const first = (within, query) => {
  const found = rank(within, query);
  return found.length === 0 ? 'nothing' : within.entries[found[0][0]][0].split('#')[0];
};

if (list === '--ask') {
  for (const [section, score] of rank(index, rest.join(' ')).slice(0, 8)) {
    const [address, heading, where] = index.entries[section];
    console.log(`${score.toFixed(0).padStart(7)}  ${address}  ${heading} (${where})`);
  }
  process.exit(0);
}

const lines = fs.readFileSync(list, 'utf8').split('\n').filter(line => line && !line.startsWith('#'))
  .map(line => line.split(' -> ').map(part => part.trim()));
const misses = (within, wanted) => wanted.filter(([query, page]) => {
  const got = first(within, query);
  const bad = got !== page;
  if (bad && rest[0] !== '--try') console.log(`${query}: ${got} comes first, not ${page}`);
  return bad;
}).length;

if (rest[0] === '--try') {
  const pages = [...new Set(lines.map(line => line[1]))];
  const other = page => pages[(pages.indexOf(page) + 1) % pages.length];
  const wrong = misses(index, lines.map(([query, page]) => [query, other(page)]));
  const without = {entries: index.entries.map(entry => entry[0].startsWith('task_') ? ['gone', '', '', ''] : entry),
    words: index.words, names: index.names};
  const lost = misses(without, lines);
  const tasks = lines.filter(line => line[1].startsWith('task_')).length;
  console.log(`told other pages ${wrong} of ${lines.length} miss; without the tasks ${lost} of ${lines.length}`);
  process.exit(wrong === lines.length && lost === tasks && tasks > 0 ? 0 : 1);
}
const missed = misses(index, lines);
console.log(`${lines.length - missed} of ${lines.length} words find their page first`);
process.exit(missed > 0 || lines.length < 30 ? 1 : 0);
