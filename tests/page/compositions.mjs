// SPDX-License-Identifier: BSD-3-Clause
// Compiles every composition that the page offers to be pasted, syntax and types.
//     node compositions.mjs SOURCE index.html FOLDER COMPILER EIGEN
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import {instanceOf, modulesOf, wordsOf} from './page_of.mjs';

const [, , source, html, folder, compiler, ...eigen] = process.argv;
const words = wordsOf(source),
  modules = modulesOf(html);
let all = `#include <passive_haptics/passive_haptics.hpp>
#include <utility>
template <class T> bool good(const T& t) {
  if constexpr (requires { t.first; }) return !t.first.check() && !t.second.check();
  else return !t.check();
}
`,
  count = 0;
for (const [key, scene] of Object.entries(words.scenes)) {
  if (!modules[scene.module]) continue;
  const {e, text} = await instanceOf(modules[scene.module]);
  const set = Object.fromEntries(
    Array.from({length: e.ph_parameters()}, (_, i) => [text(e.ph_parameter(i)), e.ph_get(scene.stage, i)])
  );
  for (let i = 0; i < e.ph_controllers(scene.stage); ++i) {
    const code = words.composition(key, text(e.ph_text(scene.stage, i)), set);
    all += `namespace composition_${count++} {\n${code.replace(/#include.*\n/g, '')}
inline bool good() { return ::good(touch); }
}
`;
  }
}
all += `int main() {\n  int bad = 0;\n${Array.from(
  {length: count},
  (_, i) => `  bad += !composition_${i}::good();\n`
).join('')}  return bad;\n}\n`;
fs.writeFileSync(`${folder}/compositions.cpp`, all);
execFileSync(
  compiler,
  [
    '-std=c++20',
    '-O0',
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
execFileSync(`${folder}/compositions`, {stdio: 'inherit'}); // how many refuse their own parameters
console.log(`${count} compositions: all compile, and take their parameters`);
