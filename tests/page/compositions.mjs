// SPDX-License-Identifier: BSD-3-Clause
// Compiles every program that the page offers to be pasted, one for each scene and controller and one for each side of
// a problem, strictly, and runs them: each prints what it made and whether it is quiet.
//     node compositions.mjs SOURCE index.html FOLDER COMPILER EIGEN
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {expect, failures, instanceOf, modulesOf, wordsOf} from './page_of.mjs';

const [, , source, html, folder, compiler, ...eigen] = process.argv;
const words = wordsOf(source),
  modules = modulesOf(html);
const programs = [],
  includes = new Set();
function add(what, code, of) {
  for (const line of code.match(/#include.*/g)) includes.add(line);
  expect(/^int main\(\) \{$/m.test(code), `${what}: a whole program`);
  programs.push({...of, what, code: code.replace(/#include.*\n/g, '').replace('int main()', 'static int run()')});
}
for (const [key, scene] of Object.entries(words.scenes)) {
  if (!modules[scene.module]) continue;
  const {e, text} = await instanceOf(modules[scene.module]);
  const usual = Object.fromEntries(
    Array.from({length: e.ph_parameters()}, (_, i) => [text(e.ph_parameter(i)), e.ph_get(scene.stage, i)])
  );
  const menu = Array.from({length: e.ph_controllers(scene.stage)}, (_, i) => ({
    name: text(e.ph_name(scene.stage, i)),
    promise: e.ph_promise(scene.stage, i),
    code: text(e.ph_text(scene.stage, i)),
  }));
  for (const c of menu) add(`${key}, ${c.name}`, words.program(key, c.code, usual), {...c, set: usual});
  for (const [problem, p] of Object.entries(words.problems).filter(([, p]) => p.scene === key)) {
    const set = {...usual, ...p.set};
    for (const side of ['left', 'right']) {
      const c = menu.find(c => c.name === p[side]);
      add(`${problem}, ${side}`, words.program(key, c.code, set), {...c, set, problem, side});
    }
  }
}
// One compiler run for all: a namespace each.
const all = [
  ...includes,
  ...programs.map(({code}, i) => `namespace program_${i} {\n${code}}`),
  'int main() {\n  int bad = 0;',
  ...programs.map((_, i) => `  bad += program_${i}::run();`),
  '  return bad;\n}\n',
].join('\n');
fs.writeFileSync(`${folder}/compositions.cpp`, all);
execFileSync(
  compiler,
  [
    '-std=c++20',
    '-O1',
    '-Wall',
    '-Wextra',
    '-Werror',
    '-I',
    `${source}/include`,
    ...eigen.flatMap(path => ['-isystem', path]),
    `${folder}/compositions.cpp`,
    '-o',
    `${folder}/compositions`,
  ],
  {stdio: 'inherit'}
);
const printed = execFileSync(`${folder}/compositions`, {encoding: 'utf8'}).trim().split('\n');
expect(printed.length === programs.length, `${printed.length} lines of ${programs.length} programs`);
let door = 0,
  worst = 0;
programs.forEach(({what, name, set, promise, side, problem, code}, i) => {
  const said = printed[i]?.match(/^presses with (\S+) N, made (\S+) mJ, (quiet|not quiet): (\S+) N rms/);
  expect(said, `${what}: prints ${printed[i]}`);
  if (!said) return;
  const [, pressed, made, quiet] = said;
  // A loop as late as it was said to be, and a cable that was spoken of.
  const told = !(name.includes('2 ticks late') ^ (set.late > 0)) && !/a cable/.test(words.broken(promise, code, set));
  if (promise > 0 && told) expect(Number(made) <= 1e-6, `${what} promises, and made ${made} mJ`);
  if (name === 'none') worst = Math.max(worst, Number(made));
  if (!name.startsWith('make_')) {
    expect(/By hand/.test(code), `${what}: says that it is by hand`);
    return;
  }
  ++door;
  expect(/ph::(exact|encoder)_device device\{/.test(code) && /ph::known_hand hand\{/.test(code), `${what}: its facts`);
  if (told && !(set.heave > 0) && !/rough/.test(name))
    expect(quiet === 'quiet' && Number(pressed) > 0.1, `${what}: ${printed[i]}`);
});
expect(worst > 10, `the worst bare spring made ${worst} mJ`);
const bare = printed[programs.findIndex(({what}) => what === 'wall, none')];
expect(/not quiet/.test(bare), `the control buzzes: ${bare}`);
console.log(`wall, none: ${bare}`);
console.log(`${door} programs by the door, ${programs.length} in all${failures() ? '' : ': all compile, and run'}`);
process.exit(failures() ? 1 : 0);
