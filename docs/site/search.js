// SPDX-License-Identifier: BSD-3-Clause
// The search of the documentation site. The index, which search.py writes, says how much each word counts for each
// section; here it is added up and shown. The index is read when the box is first used. It asks no network.
'use strict';

/** What is left of a word without its ending, for comparison only: "hums" and "humming" are "hum". */
function stem(word) {
  const ending = ['ing', 'es', 'ed', 's'].find(end => word.length > end.length + 2 && word.endsWith(end)) || '';
  return word.slice(0, word.length - ending.length).replace(/([a-z])\1$/, '$1');
}

/** True where one letter more, less, another, or two in a wrong order make `a` into `b`. */
function slip(a, b) {
  if (Math.abs(a.length - b.length) > 1) return false;
  let i = 0;
  while (i < a.length && a[i] === b[i]) ++i;
  const rest = (x, y) => a.slice(i + x) === b.slice(i + y);
  return rest(1, 1) || rest(1, 0) || rest(0, 1) ||
    (a[i] === b[i + 1] && a[i + 1] === b[i] && rest(2, 2));
}

/** Of each section that `word` leads to, how much it counts there. */
function hits(index, word, misspelt) {
  const found = new Map();
  const root = stem(word);
  const take = (known, share) => {
    const flat = index.words[known];
    for (let i = 0; i < flat.length; i += 2) {
      found.set(flat[i], Math.max(found.get(flat[i]) || 0, share * flat[i + 1]));
    }
  };
  for (const known in index.words) {
    if (known === word) take(known, 1);
    else if (misspelt) {
      if (word.length > 3 && slip(word, known)) take(known, 0.5);
    } else if (root.length > 2 && stem(known) === root) take(known, 0.9);
    else if (word.length > 1 && known.startsWith(word)) take(known, 0.25 + 0.5 * word.length / known.length);
    else if (root.length > 3 && known.startsWith(root)) take(known, 0.2 + 0.4 * root.length / known.length);
  }
  const named = index.names[word] || [];
  for (let i = 0; i < named.length; i += 2) found.set(named[i], named[i + 1] * (found.get(named[i]) || 0));
  return found;
}

// They stand in every text, and say nothing of what is looked for.
const filler = new Set(('a an and are as at be but by can do does for from has have how i if in is it its me my not of on ' +
  'one or that the there this to too use used using via what when which why with you your').split(' '));

/** The sections that `query` finds, best first: [[section, score], ...]. A section that lacks a word comes last. */
function rank(index, query) {
  const asked = query.toLowerCase().match(/[a-z0-9_#+µ]+/g) || [];
  let words = [...new Set(asked.filter(word => !filler.has(word)))];
  if (words.length === 0) words = asked;
  const total = new Map();
  for (const word of words) {
    let found = hits(index, word, false);
    if (found.size === 0) found = hits(index, word, true);
    for (const [section, weight] of found) {
      const before = total.get(section) || [0, 0];
      total.set(section, [before[0] + weight, before[1] + 1]);
    }
  }
  return [...total]
    .map(([section, [weight, matched]]) => [section, weight * (matched / words.length) ** 2])
    .sort((a, b) => b[1] - a[1] || a[0] - b[0]);
}

/** The box of a page. */
function search_box(form) {
  const box = form.querySelector('input');
  const list = form.querySelector('#found');
  const count = form.querySelector('#find-count');
  let chosen = 0;
  box.setAttribute('role', 'combobox');
  box.setAttribute('aria-controls', 'found');
  box.setAttribute('aria-expanded', 'false');
  box.title = 'Search ( / )';

  const load = () => {
    if (load.begun) return;
    load.begun = true;
    const script = document.createElement('script');
    script.src = 'search_index.js';
    script.onload = show;
    document.head.append(script);
  };
  const choose = to => {
    const all = list.children;
    if (all.length === 0) return;
    chosen = (to + all.length) % all.length;
    for (let i = 0; i < all.length; ++i) all[i].setAttribute('aria-selected', i === chosen);
    box.setAttribute('aria-activedescendant', all[chosen].id);
    all[chosen].scrollIntoView({block: 'nearest'});
  };
  const close = () => {
    list.hidden = true;
    box.setAttribute('aria-expanded', 'false');
    box.removeAttribute('aria-activedescendant');
  };
  const show = () => {
    const query = box.value.trim();
    list.replaceChildren();
    count.textContent = '';
    if (query === '' || typeof search_index === 'undefined') return close();
    const found = rank(search_index, query);
    for (const [section] of found.slice(0, 12)) {
      const [address, heading, where, text] = search_index.entries[section];
      const hit = document.createElement('a');
      hit.href = address;
      hit.id = `found-${list.children.length}`;
      hit.tabIndex = -1;
      hit.setAttribute('role', 'option');
      for (const [kind, said] of [['b', heading], ['small', where], ['span', text]]) {
        const part = document.createElement(kind);
        part.textContent = said;
        hit.append(part, ' ');
      }
      list.append(hit);
    }
    count.textContent = found.length === 0 ? `Nothing is found for "${query}".` : `${found.length} found`;
    count.className = found.length === 0 ? 'none' : '';
    list.hidden = found.length === 0;
    box.setAttribute('aria-expanded', !list.hidden);
    if (found.length > 0) choose(0);
  };
  box.addEventListener('focus', load);
  box.addEventListener('input', () => { load(); show(); });
  box.addEventListener('keydown', event => {
    if (event.key === 'ArrowDown') choose(chosen + 1);
    else if (event.key === 'ArrowUp') choose(chosen - 1);
    else if (event.key === 'Escape') close();
    else return;
    event.preventDefault();
  });
  form.addEventListener('submit', event => {
    event.preventDefault();
    if (!list.hidden && list.children[chosen]) list.children[chosen].click();
  });
  document.addEventListener('click', event => { if (!form.contains(event.target)) close(); });
  document.addEventListener('keydown', event => {
    const typing = /^(input|textarea|select)$/i.test(document.activeElement.tagName);
    if (event.key !== '/' || typing || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    box.focus();
  });
  const asked = new URLSearchParams(location.search).get('find');  // index.html?find=buzz
  if (asked) {
    box.value = asked;
    load();
  }
}

/** Code, signatures and tables that are wider than their page are scrolled, by keys too; others are no stop. */
function reach_wide() {
  const wide = [...document.querySelectorAll('.fragment, .memproto, .contents table, .contents tbody')]
    .map(part => [part, part.scrollWidth > part.clientWidth && /auto|scroll/.test(getComputedStyle(part).overflowX)]);
  for (const [part, scrolls] of wide) {
    if (scrolls) part.tabIndex = 0;
    else part.removeAttribute('tabindex');
  }
}

if (typeof document !== 'undefined') {
  search_box(document.getElementById('find'));
  addEventListener('load', reach_wide);
  addEventListener('resize', reach_wide);
}
