// SPDX-License-Identifier: BSD-3-Clause
// Bits, sizes, words, links and fields of the live page, without a browser.
//     node words.mjs SOURCE index.html wall_alone.html
import fs from 'node:fs';
import zlib from 'node:zlib';
import {expect, failures, instanceOf, modulesOf, wordsOf} from './page_of.mjs';

const [, , source, html, wallAlone] = process.argv;
const words = wordsOf(source),
  modules = modulesOf(html);

// The same bits as the native run; and a fingerprint that can differ does.
let runs = 0,
  ticks = 0;
const costs = [];
for (const [name, module] of Object.entries(modules)) {
  const {e, text, numbers} = await instanceOf(module);
  expect(e.ph_stages() === module.native.length, `${name}: as many stages as natively`);
  for (const [stage, native] of module.native.entries()) {
    expect(native.ticks * native.prints.length > 199000, `${name} ${stage}: 200 000 ticks`);
    for (const [i, print] of native.prints.entries()) {
      const at = e.ph_fingerprint(stage, i, native.ticks);
      const here = [...numbers(at, 2)].map(h => h.toString(16).padStart(8, '0')).join('');
      expect(here === print, `${name} ${stage}, controller ${i}: ${here} natively ${print}`);
      ++runs;
      ticks += native.ticks;
    }
    // Whoever promises keeps it on this round; and who does not makes energy somewhere, or nothing was tried.
    let made = 0;
    const set = Object.fromEntries(Array.from({length: e.ph_parameters()}, (_, k) => [text(e.ph_parameter(k)), e.ph_get(stage, k)]));
    for (let i = 0; i < e.ph_controllers(stage); ++i) {
      const least = numbers(e.ph_fingerprint(stage, i, 5000), 3)[2],
        promise = e.ph_promise(stage, i);
      if (promise > 0 && !words.broken(promise, `${text(e.ph_name(stage, i))} ${text(e.ph_text(stage, i))}`, set))
        expect(least >= -1e-9, `${name} ${stage}, controller ${i} promises, and made ${-least} J`);
      made = Math.max(made, -least);
    }
    if (name === 'wall') expect(made > 10e-3, `the wall's worst made ${made} J`);
    const before = process.cpuUsage();
    e.ph_run(stage, 2000);
    const used = process.cpuUsage(before),
      cost = (((used.user + used.system) / 1e3 / 2000) * 1000) / 60;
    expect(cost < 4, `${name} ${stage}: ${cost.toFixed(2)} ms of physics a frame`);
    costs.push(cost.toFixed(2));
    e.ph_set(stage, 5, e.ph_get(stage, 5) * (1 + 2e-16 * 4)); // the damping, in its last bits
    const [high, low] = numbers(e.ph_fingerprint(stage, 0, native.ticks), 2);
    expect(
      [high, low].map(h => h.toString(16).padStart(8, '0')).join('') !== native.prints[0],
      `${name} ${stage}: another damping has another fingerprint`
    );
  }
}

console.log(`physics of two sides, ms of CPU a frame at 60 Hz: ${costs.join(' ')}`);

// What a problem shows on the right keeps its promise there, too, where the loop is as stated.
for (const [problem, p] of Object.entries(words.problems)) {
  const about = words.scenes[p.scene],
    {e, text: said, numbers} = await instanceOf(modules[about.module]);
  const names = Array.from({length: e.ph_controllers(about.stage)}, (_, i) =>
    said(e.ph_name(about.stage, i))
  );
  const parameters = Array.from({length: e.ph_parameters()}, (_, i) => said(e.ph_parameter(i)));
  for (const [name, value] of Object.entries(p.set)) e.ph_set(about.stage, parameters.indexOf(name), value);
  const made = [p.left, p.right].map(
    name => -numbers(e.ph_fingerprint(about.stage, names.indexOf(name), 10000), 3)[2]
  );
  expect(made[1] <= 1e-9, `${problem}: the right made ${made[1]} J`);
  const least = {none: 10e-3, 'a port each (wrong)': 10e-3}[p.left] ?? (p.scene === 'cable' ? 0.5e-3 : 0);
  expect(made[0] >= least, `${problem}: the left made ${made[0]} J, ${least} J is what it does`);
}

// The largest step since the start is that of the trace; on the organ the right steps less than the bare side.
{
  const {stage, module} = words.scenes.organ,
    {e, text: said, numbers} = await instanceOf(modules[module]);
  const names = Array.from({length: e.ph_controllers(stage)}, (_, i) => said(e.ph_name(stage, i)));
  const {left, right} = Object.values(words.problems).find(p => p.scene === 'organ');
  [left, right].forEach((name, w) => e.ph_choose(stage, w, names.indexOf(name)));
  e.ph_by_itself(stage, 1);
  e.ph_restart(stage);
  e.ph_run(stage, 5000);
  const worst = [0, 1].map(w => {
    const width = e.ph_row_width(),
      rows = numbers(e.ph_rows(stage, w), 5000 * width);
    const force = i => [rows[i * width + 5], rows[i * width + 6]];
    let most = 0;
    for (let i = 1; i < 5000; ++i)
      most = Math.max(most, Math.hypot(force(i)[0] - force(i - 1)[0], force(i)[1] - force(i - 1)[1]));
    const {worst} = words.verdictOf(numbers(e.ph_verdict(stage, w), words.verdictNames.length));
    expect(Math.abs(worst - most) < 1e-9, `the organ steps by ${worst} N at most, in the trace by ${most} N`);
    return worst;
  });
  expect(worst[1] < worst[0] / 3, `the organ steps by ${worst[1]} N, its bare side by ${worst[0]} N`);
}

// Contrast AA, light and dark: 4.5 to 1 for every colour of text on both grounds.
const css = fs.readFileSync(`${source}/examples/page/page.css`, 'utf8');
const themes = [...css.matchAll(/:root \{([^}]*)\}/g)].map(([, body]) =>
  Object.fromEntries([...body.matchAll(/--(\w+): (#\w{6})/g)].map(([, name, colour]) => [name, colour]))
);
expect(themes.length === 2, 'two themes');
const light = colour =>
  [1, 3, 5]
    .map(i => parseInt(colour.slice(i, i + 2), 16) / 255)
    .map(c => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
expect(contrast('#000000', '#ffffff') === 21, 'black on white');
for (const theme of themes) {
  for (const colour of ['ink', 'soft', 'left', 'right', 'good', 'bad', 'price']) {
    for (const ground of ['bg', 'card']) {
      expect(
        contrast(theme[colour], theme[ground]) >= 4.5,
        `${colour} on ${ground}: ${contrast(theme[colour], theme[ground])}`
      );
    }
  }
}

// Sizes.
const packedSize = file => zlib.gzipSync(fs.readFileSync(file), {level: 9}).length;
// 400 kB before balls rested in hollows, and news of sets were told from a hand that gives way to them.
expect(packedSize(html) <= 404e3, `the page is ${packedSize(html)} bytes, 404 kB gzip at most`);
// 60 kB before it had a judge of quiet, the door's four compositions and whole programs to paste; 79 before it had an
// article, the catalogue of devices, a tank and a glass; 85 before a surface could say how it moves.
expect(packedSize(wallAlone) <= 88e3, `the wall alone is ${packedSize(wallAlone)} bytes, 88 kB gzip at most`);
const text = fs.readFileSync(html, 'utf8');
expect(
  !/(src|href)="(?!data:|#)/.test(text) &&
    !/url\(/.test(text) &&
    !/\bfetch\(|XMLHttpRequest|import\(/.test(text),
  'nothing is loaded from anywhere'
);

// The menu of the wall is the bench's catalogue.
const wall = await instanceOf(modules.wall);
const menu = new Set(
  Array.from({length: wall.e.ph_controllers(0)}, (_, i) => wall.text(wall.e.ph_name(0, i)))
);
const listed = new Set();
for (const file of fs.readdirSync(`${source}/bench/controllers`).filter(f => /^catalogue_.*\.cpp$/.test(f))) {
  const code = fs.readFileSync(`${source}/bench/controllers/${file}`, 'utf8');
  const entry =
    /(?:entry<\d>|over_ledger(?:<[\d, ]+>)?|entry_of<[^>]*>|growing|thesis_safe)\(\s*\{?\s*(?:\.name = )?"([^"]+)"/g;
  for (const found of code.matchAll(entry)) listed.add(found[1]);
}
expect(listed.size >= 30, `the catalogue was read: ${listed.size} controllers`);
for (const name of listed) expect(menu.has(name), `the wall's menu has “${name}” of the catalogue`);
for (const name of menu)
  expect(name.startsWith('make_') || listed.has(name), `“${name}” of the wall's menu is in the catalogue`);

// The judge of quiet is the library's: what it says agrees with the trace, for a wall that rests, one that buzzes, and
// one on encoders, where the floor is K q of what is shown.
{
  const {e, text: said, numbers} = wall;
  const names = Array.from({length: e.ph_controllers(0)}, (_, i) => said(e.ph_name(0, i)));
  const parameters = Array.from({length: e.ph_parameters()}, (_, i) => said(e.ph_parameter(i)));
  const put = (name, value) => e.ph_set(0, parameters.indexOf(name), value);
  const hold = controllers => {
    controllers.forEach((name, w) => e.ph_choose(0, w, names.indexOf(name)));
    e.ph_by_itself(0, 0);
    e.ph_restart(0);
    e.ph_aim(0, 0, -0.016);
    do e.ph_run(0, 1);
    while (words.verdictOf(numbers(e.ph_verdict(0, 0), words.verdictNames.length)).still < 2.999);
    return [0, 1].map(w => ({
      ...words.verdictOf(numbers(e.ph_verdict(0, w), words.verdictNames.length)),
      step_of_trace: [...Array(99).keys()]
        .map(i => {
          const kept = e.ph_rows_kept(),
            width = e.ph_row_width(),
            rows = numbers(e.ph_rows(0, w), kept * width);
          const force = n => rows[((e.ph_count(0, w) - 1 - n) % kept) * width + 6];
          return Math.abs(force(i) - force(i + 1));
        })
        .reduce((a, b) => Math.max(a, b)),
    }));
  };
  put('motors', 1e3); // so that what is held is what is commanded
  const [buzzes, rests] = hold(['none', 'make_touch']);
  put('motors', 9);
  expect(rests.quiet === 1 && rests.since < 1, `make_touch rests after ${rests.since} s`);
  expect(Math.abs(rests.shown / 9999 - 1) < 0.06, `make_touch shows ${rests.shown} of ${rests.asked} N/m`);
  expect(buzzes.quiet === 0 && !(buzzes.since >= 0), `the bare spring: quiet after ${buzzes.since} s`);
  expect(buzzes.rms > 0.2 && buzzes.speed > 0.01, `the bare spring: ${buzzes.rms} N, ${buzzes.speed} m/s`);
  for (const v of [rests, buzzes]) {
    expect(
      Math.abs(v.step - v.step_of_trace) <= 1e-9 + 0.02 * v.step,
      `a tick steps by ${v.step} N, in the trace by ${v.step_of_trace} N`
    );
    expect(v.step_bar === 0.02 && v.rms_bar === 0.02 && v.speed_bar === 1e-3, 'the bars without encoders');
  }
  const [swapped] = hold(['make_touch', 'none']);
  expect(swapped.quiet === 1, 'the verdict is of the controller, not of the side');
  put('quantum', 55e-6), put('friction', 0.13), put('stiffness', 2000);
  const [, steps] = hold(['none', 'make_touch, encoders']);
  expect(
    steps.shown > 100 && Math.abs(steps.step_bar - Math.max(0.02, steps.shown * 55e-6)) < 1e-9,
    `on steps of 55 µm ${steps.shown} N/m are shown, the bar is ${steps.step_bar} N`
  );
  expect(steps.quiet === 1, `on steps: ${steps.rms} N, ${steps.speed} m/s, ${steps.step} N a tick`);
  put('friction', 0);
  const [, bare] = hold(['none', 'make_touch, encoders']);
  expect(bare.shown === 0 || bare.step_bar >= 4 * 55e-6 * bare.shown - 1e-9, 'without friction four steps');
  put('quantum', 0), put('stiffness', 10000);
  console.log(
    `quiet: make_touch after ${rests.since.toFixed(1)} s, ${rests.step.toExponential(1)} N a tick, ` +
      `${rests.shown.toFixed(0)} of ${rests.asked} N/m; none ${buzzes.rms.toFixed(1)} N rms, ` +
      `${buzzes.step.toFixed(1)} N a tick; on encoders ${steps.shown.toFixed(0)} N/m, bar ${steps.step_bar.toFixed(3)} N`
  );
}

// Each slider and each problem speaks of what is there.
for (const [key, scene] of Object.entries(words.scenes)) {
  if (!modules[scene.module]) continue;
  const {e, text: said} = await instanceOf(modules[scene.module]);
  const parameters = Array.from({length: e.ph_parameters()}, (_, i) => said(e.ph_parameter(i)));
  for (const knob of scene.knobs)
    expect(parameters.includes(knob) && words.knobs[knob], `${key}: slider ${knob}`);
  const names = Array.from({length: e.ph_controllers(scene.stage)}, (_, i) =>
    said(e.ph_name(scene.stage, i))
  );
  expect(names.length >= 6, `${key}: six controllers at least`);
  for (const [problem, p] of Object.entries(words.problems).filter(([, p]) => p.scene === key)) {
    expect(names.includes(p.left) && names.includes(p.right), `${problem}: its controllers are in the menu`);
    for (const name of Object.keys(p.set))
      expect(scene.knobs.includes(name), `${problem}: ${name} has a slider`);
  }
}

// How long it takes to read, at 200 words a minute, is said.
const steps = Object.entries(words.problems),
  minutes = steps.flatMap(([title, p]) => `${title} ${p.says}`.split(/\s+/)).length / 200;
expect(
  steps.length === 13 && Math.round(minutes) === 4 && /Thirteen steps, four minutes to read/.test(text),
  `${steps.length} steps, ${minutes.toFixed(1)} minutes`
);

// A promise whose assumption is not kept says so; a file of identify is read, or refused by a sentence.
const told = {late: 0, quantum: 0};
expect(words.broken(2, 'ph::strict_bound{}', told) === '', 'a promise that is kept');
expect(/told 0 ticks late, it is 2/.test(words.broken(2, 'ph::strict_bound{}', {late: 2, quantum: 0})), 'late, untold');
expect(words.broken(2, 'ph::late_loop_limits<2>{}', {late: 2, quantum: 0}) === '', 'late, told');
expect(/steps of 55/.test(words.broken(1, 'ph::exact_device{}', {late: 0, quantum: 55e-6})), 'steps, untold');
expect(words.broken(1, 'ph::encoder_device{}', {late: 0, quantum: 55e-6}) === '', 'steps, told');
expect(/a cable/.test(words.broken(1, 'ph::exact_device{}', {...told, mode: 60})), 'a cable, untold');
expect(words.broken(1, 'ph::observed_transmission{}', {...told, mode: 60}) === '', 'a cable, told');
expect(words.broken(2, 'ph::strict_bound{}', {...told, mode: 60}) === '', 'who is strict needs no mass');
expect(words.broken(0, '', {late: 2, quantum: 55e-6}) === '', 'who promises nothing breaks nothing');
const device = words.readDevice('{"passive_haptics_device": 1, "mass": 0.2, "latency": 1, "force_limit": 5}');
expect(device.set?.mass === 0.2 && device.set.late === 1 && device.set.motors === 5 && device.set.quantum === 0, 'a device');
for (const bad of ['', '3', 'null', '{"passive_haptics_device": 2}', '{"passive_haptics_device": 1, "rotary": true}'])
  expect(words.readDevice(bad).refused?.length > 20, `“${bad}” is refused by a sentence`);
expect(words.readLink('#v=2&step=9').step === 8 && words.readLink('#v=2&step=99').said.length === 1, 'steps in a link');

// Numbers that are none, and numbers out of range, get a sentence.
for (const bad of ['NaN', '', 'Infinity', '1e999', 'ten', '0x', '--1']) {
  expect(words.readNumber(bad, 'mass').refused?.includes('no number'), `“${bad}” is refused with a sentence`);
}
expect(
  words.readNumber('1e6', 'mass').value === 0.5 && words.readNumber('1e6', 'mass').said,
  'too much is cut, and said'
);
expect(words.readNumber('0,2', 'mass').value === 0.2, 'a decimal comma is read');
const beginning = wall.e.ph_get(0, 0);
wall.e.ph_set(0, 0, NaN);
wall.e.ph_set(0, 0, Infinity);
expect(wall.e.ph_get(0, 0) === beginning, 'the module itself takes no NaN and no infinity');

// Links: what is written is read, what is strange is named.
const usual = Object.fromEntries(Object.keys(words.knobs).map(name => [name, 1]));
const link = words.writeLink(
  'wall',
  'none',
  'strict FBA, 2 ticks late',
  {...usual, stiffness: 1234, loss: 0.25},
  usual
);
const read = words.readLink(link);
expect(
  read.left === 'none' &&
    read.right === 'strict FBA, 2 ticks late' &&
    read.set.stiffness === 1234 &&
    read.set.loss === 0.25 &&
    read.said.length === 0,
  `a link is read as it was written: ${link}`
);
expect(
  words.readLink('#v=7&scene=wall&left=none').said[0]?.includes('another version'),
  'a link of another version'
);
for (const strange of [
  '#v=2&scene=moon',
  '#v=2&stiffness=NaN',
  '#v=2&flavour=3',
  '#v=2&stiffness=1e99',
  '#%E0%A4%A',
]) {
  const found = words.readLink(strange);
  expect(found.scene === 'wall' && found.said.length > 0, `strange: ${strange}`);
}
expect(words.readLink('').said.length === 0, 'no link, no sentence');

// Verdicts.
const quiet = {
  ...{made: 0, buzz: 0, swing: 0, behind: 0, settled: 1, touching: 1, force: 2},
  ...{still: 2, quiet: 1, since: 0.3, rms: 0.001, speed: 1e-4, step: 0.002, asked: 2000, shown: 2000},
  ...{rms_bar: 0.02, speed_bar: 1e-3, step_bar: 0.02},
};
const felt = '0.001 N rms above 10 Hz, 0.1 mm/s, 0.002 N a tick';
const speak = v =>
  words
    .remarks({...quiet, ...v})
    .map(([said]) => said)
    .join('; ');
expect(
  speak({}) === `made no energy; quiet after 0.3 s: ${felt}; shows 2000 of 2000 N/m; settled at 2 N`,
  speak({})
);
expect(speak({still: 0.05}).includes(`moves: ${felt}`), speak({still: 0.05}));
expect(
  speak({step_bar: 0.11, rms_bar: 0.055, shown: 500}).includes(
    '0.002 of 0.11 N a tick (encoder steps are the floor); shows 500 of 2000 N/m'
  ),
  speak({step_bar: 0.11, rms_bar: 0.055, shown: 500})
);
expect(
  speak({made: 0.082, settled: 0, buzz: 210, swing: 4, quiet: 0, since: NaN, step: 3}) ===
    'made 82 mJ out of nothing; not quiet for 2 s: 0.001 N rms above 10 Hz, 0.1 mm/s, 3 N a tick; ' +
      'shows 2000 of 2000 N/m; buzzes at 210 Hz by 4 N',
  speak({made: 0.082, settled: 0, buzz: 210, swing: 4})
);
expect(speak({worst: 0.87}).includes('stepped by 0.87 N at most'), speak({worst: 0.87}));
expect(speak({behind: 3e-3}).includes('sinks 3 mm behind the surface'), speak({behind: 3e-3}));
expect(
  speak({settled: 0, buzz: 15, swing: 2}).includes('jumps 15 times a second by 2 N'),
  'what comes with the news jumps'
);
const named = fs.readFileSync(`${source}/include/passive_haptics/base/event.hpp`, 'utf8').match(/names\[\] = \{([^}]*)\}/)[1];
expect(
  words.events.join() === [...named.matchAll(/"([^"]*)"/g)].map(([, name]) => name).join() && words.events.length > 16,
  `the events are those of base/event.hpp: ${words.events}`
);
expect(speak({event: 2}).endsWith('event: late tick') && !/event/.test(speak({event: 0})), speak({event: 2}));
expect(speak({rms: 1e-7, speed: 2e-11, step: 3e-8}).includes(': 0 N rms above 10 Hz, 0 mm/s, 0 N a tick'), 'no 1e-7');
expect(speak({made: 5e-10}).includes('made no energy'), 'rounding is no energy');

console.log(
  `${runs} runs, ${ticks} ticks; page ${packedSize(html)} bytes gzip, the wall alone ${packedSize(wallAlone)}`
);
console.log(failures() ? `${failures()} failed` : 'all is well');
process.exit(failures() ? 1 : 0);
