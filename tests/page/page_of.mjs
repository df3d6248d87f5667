// SPDX-License-Identifier: BSD-3-Clause
// What the tests take out of the page: its words, its modules.
import fs from 'node:fs';
import vm from 'node:vm';
import zlib from 'node:zlib';

export function wordsOf(source) {
  const module = {};
  const context = vm.createContext({module, URLSearchParams});
  vm.runInContext(fs.readFileSync(`${source}/examples/page/words.js`, 'utf8'), context);
  return module.exports;
}

export function modulesOf(html) {
  const page = fs.readFileSync(html, 'utf8');
  return JSON.parse(page.match(/id="modules">(.*?)<\/script>/s)[1]);
}

export async function instanceOf(module) {
  const compiled = await WebAssembly.compile(zlib.gunzipSync(Buffer.from(module.wasm, 'base64')));
  const imports = {};
  for (const i of WebAssembly.Module.imports(compiled)) {
    (imports[i.module] ??= {})[i.name] = () => {
      if (i.name === 'proc_exit') throw new Error('the module has ended');
      return 8; // no such descriptor, as on the page
    };
  }
  const e = (await WebAssembly.instantiate(compiled, imports)).exports;
  e._initialize();
  const text = at => {
    const bytes = new Uint8Array(e.memory.buffer);
    return new TextDecoder().decode(bytes.slice(at, bytes.indexOf(0, at)));
  };
  const numbers = (at, n) => new Float64Array(e.memory.buffer, at, n);
  return {e, text, numbers, imports: WebAssembly.Module.imports(compiled).length};
}

let failed = 0;
export function expect(held, what) {
  if (!held) {
    console.log(`FAILED: ${what}`);
    ++failed;
  }
}
export const failures = () => failed;
