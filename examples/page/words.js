// SPDX-License-Identifier: BSD-3-Clause
// What needs no page: the scenes, the problems, the sliders, and how numbers become words.
'use strict';

const version = 2; // of what the link holds

// name, label, unit, how many of it are an SI unit, least, most, logarithmic, steps of one
const knobs = {
  stiffness: ['Stiffness K', 'N/m', 1, 100, 50000, true],
  young: ['Young’s modulus', 'kPa', 1e-3, 5, 200, true],
  rate: ['News of the world', 'Hz', 1, 5, 100, true],
  latency: ['Latency of the news', 'ms', 1e3, 0, 100],
  loss: ['Lost packets', '%', 1e2, 0, 90],
  damping: ['Damping b', 'N·s/m', 1, 0.02, 2, true],
  mass: ['Mass', 'kg', 1, 0.03, 0.5, true],
  friction: ['Dry friction', 'N', 1, 0, 1],
  quantum: ['Encoder step', 'µm', 1e6, 0, 200],
  motors: ['Motor limit', 'N', 1, 1, 30, true],
  late: ['Lateness of the loop', 'ticks', 1, 0, 4, false, true],
  heave: ['Heave of the surface', 'mm', 1e3, 0, 8],
  tilt: ['Tilt of the surface', 'slope', 1, 0, 0.4],
  roughness: ['Roughness µ', '', 1, 0, 1.2],
  hand_stiffness: ['Stiffness of the hand', 'N/m', 1, 50, 500, true],
  hand_force: ['Strength of the hand', 'N', 1, 1, 12],
  mode: ['Resonance of the cable', 'Hz', 1, 30, 300, true],
};

/** A corner of two walls, whoever is in it. */
const inACorner = {
  dof: 2,
  view: [0.002, 0.002, 0.046],
  start: '{0.014, 0.014}',
  press: '{-0.012, -0.012}',
  walls: [
    '{.point = {0, UP}, .normal = {0, 1}, .stiffness = stiffness}',
    '{.point = {0, 0}, .normal = {1, 0}, .stiffness = stiffness}',
  ],
};

// view: the middle of the picture and its height [m]; start, press, walls: of the program to paste, as C++
const loop = ['damping', 'mass', 'friction', 'quantum', 'motors', 'late'],
  net = ['rate', 'latency', 'loss'],
  person = ['hand_stiffness', 'hand_force'];
const scenes = {
  wall: {
    title: 'Stiff wall',
    module: 'wall',
    stage: 0,
    dof: 1,
    view: [0, -0.004, 0.046],
    start: '0.012',
    press: '-0.016',
    walls: ['{.point = UP, .normal = 1, .stiffness = stiffness}'],
    says: 'A device on a rail, and a wall that stands still.',
    knobs: ['stiffness', ...loop, 'heave', ...net, ...person],
  },
  heave: {
    title: 'Heaving surface',
    module: 'surfaces',
    stage: 0,
    dof: 2,
    view: [0, -0.001, 0.046],
    start: '{0, 0.014}',
    press: '{0, -0.014}',
    before: 'const double slope = SLOPE, length = std::sqrt(1 + slope * slope);',
    walls: ['{.point = {0, UP}, .normal = {slope / length, 1 / length}, .stiffness = stiffness}'],
    says: 'A surface that heaves and tilts, and tells of it a few times a second.',
    knobs: ['stiffness', 'heave', 'tilt', ...net, ...loop, ...person],
  },
  ball: {
    title: 'Soft ball',
    module: 'bodies',
    stage: 0,
    dof: 3,
    view: [0, 0.03, 0.095],
    start: '{0.004, 0, 0.064}',
    press: '{0.004, 0, 0.030}',
    says: 'The ball of the thesis: 16 tetrahedra, solved in the page, felt through the plane under the device.',
    knobs: ['young', ...net, ...loop, ...person],
  },
  corner: {
    title: 'Box corner',
    module: 'surfaces',
    stage: 1,
    ...inACorner,
    says: 'Two walls that meet. However many walls: one device is one port.',
    knobs: ['stiffness', 'heave', ...net, ...loop, ...person],
  },
  scheme: {
    title: 'Scheming hand',
    module: 'surfaces',
    stage: 3,
    ...inACorner,
    says: 'A hand that no motor stops fills every account in free air, and draws what it has filled.',
    knobs: ['stiffness', 'damping', 'motors', 'late'],
  },
  cable: {
    title: 'Through a cable',
    module: 'surfaces',
    stage: 4,
    dof: 1,
    cable: true,
    view: [0, -0.004, 0.046],
    start: '0.012',
    press: '-0.016',
    walls: ['{.point = UP, .normal = 1, .stiffness = stiffness}'],
    says: 'A motor with a tenth of the mass, a cable, and the handle behind it.',
    knobs: ['stiffness', 'mode', ...loop, 'heave', ...net, ...person],
  },
  sheet: {
    title: 'Thin sheet',
    module: 'meshes',
    stage: 0,
    dof: 3,
    view: [0, -0.001, 0.046],
    start: '{0, 0, 0.016}',
    press: '{0, 0, -0.02}',
    sheet: true,
    walls: ['{.point = {0, 0, 0.003}, .normal = {0, 0, 1}, .stiffness = stiffness}'],
    says: 'A sheet of 2 mm, of 120 triangles, seen from the side.',
    knobs: ['rate', 'latency', 'loss', 'damping', 'mass', 'friction', 'motors', 'late', ...person],
  },
  rub: {
    title: 'Rubbing',
    module: 'surfaces',
    stage: 2,
    dof: 2,
    view: [0, -0.002, 0.046],
    start: '{-0.02, 0.010}',
    press: '{0.02, -0.014}',
    walls: ['{.point = {0, UP}, .normal = {0, 1}, .stiffness = stiffness}'],
    says: 'A rough surface: press, and pull along. It sticks, and slips.',
    knobs: ['stiffness', 'roughness', 'heave', ...net, ...loop, ...person],
  },
  organ: {
    title: 'Organ slice',
    module: 'bodies',
    stage: 1,
    dof: 3,
    view: [0, 0.009, 0.052],
    start: '{0.004, 0, 0.064}',
    press: '{0.004, 0, 0.030}',
    says: 'A slice of 504 tetrahedra that is pushed, gives way, and answers late.',
    knobs: ['young', ...net, ...loop, ...person],
  },
};

// The steps of the article, in the order in which they teach: what is on either side, the one slider, the words; and
// whether the left is louder than the right by 10 dB at least, above 25 Hz.
const problems = {
  'A motor that should be a wall': {
    heard: true,
    scene: 'wall',
    left: 'none',
    right: 'make_touch',
    set: {},
    knob: 'stiffness',
    wide: true,
    says:
      'A haptic device pushes back: a motor plays the wall. The easiest wall is a spring, K times how deep you are in, a thousand times a second. Press on it. ' +
      'Between two ticks the force stands still while the hand moves on, so on the way out the motor pushes longer than it should: the spring gives more than it got, and buzzes. ' +
      'Now switch the counting on. The same wall, the same hand, and nothing is made.',
  },
  'What is counted': {
    heard: true,
    scene: 'wall',
    left: 'none',
    right: 'strict FBA',
    set: {},
    knob: 'stiffness',
    says:
      'Energy is force times way. The tank beside each picture holds what the hand has put in and not got back. The bare spring overdraws it, and what is below the line came out of nothing. ' +
      'On the right no force may be so large that the worst motion of the next tick could overdraw the tank. That holds whatever the hand does, and the price is that it begins soft.',
  },
  'What damping pays': {
    scene: 'wall',
    left: 'strict FBA',
    right: 'make_touch',
    set: {stiffness: 2000, damping: 0.1},
    knob: 'damping',
    says:
      'Every device brakes a little, and that pays for stiffness: at most 2b/T at once, 200 N/m here. On the left nothing else pays, and the first touch sinks in. ' +
      'On the right the smallest mass and the strongest hand are stated, too. A mass cannot be turned round within a tick, so the wall is stiff from the first touch on.',
  },
  'News comes late': {
    heard: true,
    scene: 'organ',
    left: 'none',
    right: 'make_touch',
    set: {},
    knob: 'latency',
    says:
      'The motor wants a force a thousand times a second, and the tissue answers fifteen times, late. Each answer moves the surface under the finger, and the bare side jumps. ' +
      'On the right a local model keeps the newest piece of surface and moves it smoothly to where the news says it is.',
  },
  'The surface moves': {
    scene: 'heave',
    left: 'damped spring + reachable',
    right: 'make_touch',
    set: {heave: 4e-3},
    knob: 'rate',
    says:
      'Passive is not smooth. Both sides count, and neither makes energy; but on the left each piece of news is felt as a step, and on the right it is spread over the time to the next.',
  },
  'Encoders have steps': {
    scene: 'wall',
    left: 'damped spring + reachable',
    right: 'make_touch, encoders',
    set: {quantum: 55e-6, friction: 0.13, stiffness: 2000},
    knob: 'quantum',
    says:
      'A position comes in steps, here of 55 µm. Who takes them for exact keeps wrong books: the ledger believes in motion that was none. ' +
      'On the right the steps are in the books, and the dry friction of the device pays for them, as far as it is known.',
  },
  'Two walls meet': {
    heard: true,
    scene: 'corner',
    left: 'none',
    right: 'make_contacts',
    set: {},
    knob: 'stiffness',
    says:
      'In a corner two springs fight each other and the hand. One device is one account: on the right both walls ask one port for force, and it is calm in any corner.',
  },
  'A hand that schemes': {
    scene: 'scheme',
    left: 'a port each (wrong)',
    right: 'one port, strict',
    set: {},
    knob: 'damping',
    says:
      'On the left each wall has an account of its own, and both say strict. This hand is stronger than the motor. It shakes in free air, where each account books what the damping of the device takes. ' +
      'Then it draws that from both; but it was there once. On the right the device has one account, and there is nothing to draw twice.',
  },
  'A surface rubs': {
    scene: 'rub',
    left: 'make_contacts',
    right: 'make_contacts, rough',
    set: {},
    knob: 'roughness',
    says:
      'Press, and pull along. On the left the surface is ice; on the right it holds the device until the hand pulls harder than µ times the pressure. Friction only ever takes, if it does not creep.',
  },
  'A thin sheet': {
    scene: 'sheet',
    left: 'damped spring + reachable',
    right: 'make_mesh_touch',
    set: {},
    knob: 'hand_force',
    says:
      'Organs come as meshes, and a mesh can be thin. On the left the triangle that is nearest is told, and the finger is soon nearer to the far side, which pushes it out below. No energy is made, and the sheet is lost. ' +
      'On the right a ball is drawn to the finger that no triangle lets through, and the force is the way between the two.',
  },
  'A cable gives': {
    scene: 'cable',
    left: 'make_touch',
    right: 'make_touch, a cable',
    set: {},
    knob: 'mode',
    says:
      'Many motors pull the handle by a cable, and a cable gives. The motor is a tenth of the mass here, and turns round within a tick while the handle does not. ' +
      'On the left the two are taken for one mass: the promise is void, and the wall buzzes. On the right the mass of the motor and the pull of the cable were stated, and it rests.',
  },
  'The loop is late': {
    scene: 'wall',
    left: 'strict FBA',
    right: 'make_touch, 2 ticks late',
    set: {late: 2, stiffness: 300, damping: 0.5},
    knob: 'late',
    says:
      'Devices that talk in packets hold each force a tick or two after it was computed. A ledger that was not told books the wrong force with the wrong motion, and its promise is void: the ✗ says so. ' +
      'The one on the right was told. Set the lateness to something else, and it is wrong as well.',
  },
  'Your device': {
    heard: true,
    scene: 'wall',
    left: 'none',
    right: 'make_touch',
    set: {},
    knob: 'mass',
    device: true,
    says:
      'Take one from the list, or paste what identify wrote about your own. Its mass, friction, steps and motors go into both sides; the C++ below is a whole program for it.',
  },
};

const promises = [
  'promises nothing',
  'passive for the mass and hand that are stated',
  'passive, whatever happens',
];
const promiseShort = ['no promise', 'conditional', 'strict'];

/** Three figures, and never 1e-7 where a reader expects a number. */
function figures(x, most = 3) {
  if (!Number.isFinite(x)) return String(x);
  if (x === 0 || Math.abs(x) < 1e-12) return '0';
  const size = Math.abs(x);
  if (size >= 10 ** (most - 1)) return x.toFixed(0).replace('-', '−');
  return String(Number(x.toPrecision(most))).replace('-', '−');
}

/** Joules as a reader likes them. */
function joules(x) {
  const size = Math.abs(x);
  if (size >= 1) return `${figures(x)} J`;
  if (size >= 1e-3) return `${figures(x * 1e3)} mJ`;
  return `${figures(x * 1e6)} µJ`;
}

/** What ph_verdict hands out, in its order. */
const verdictNames = (
  'made buzz swing behind settled touching force event worst ' +
  'still quiet since rms speed step rms_bar speed_bar step_bar asked shown'
).split(' ');
const verdictOf = at => Object.fromEntries(verdictNames.map((name, i) => [name, at[i]]));

/** What ph::to_string says of each event, by its number. */
const events = (
  'nominal,debt,late tick,repeated sample,no target,rejected target,stale target,outside workspace,rejected sample,' +
  'rejected parameters,outside force,untold latency,wrong sign,started inside,forces off,wall lost,wall back'
).split(',');

/** The judge's verdict on the last 100 ms, and the bars where encoder steps have raised them. */
function quietness(v) {
  const of = (x, bar, usual, unit) => // a twentieth of a bar, or less, is none
    `${figures(x < 5e-4 ? 0 : x, 2)}${bar > 1.001 * usual ? ` of ${figures(bar, 2)}` : ''} ${unit}`;
  const felt =
    `${of(v.rms, v.rms_bar, 0.02, 'N rms above 10 Hz')}, ` +
    `${of(v.speed * 1e3, v.speed_bar * 1e3, 1, 'mm/s')}, ${of(v.step, v.step_bar, 0.02, 'N a tick')}`;
  const floor = v.step_bar > 0.0201 ? ' (encoder steps are the floor)' : '';
  if (v.still < 0.1) return [v.rms > 0 ? `moves: ${felt}` : 'moves', ''];
  if (v.quiet) return [`quiet after ${figures(v.since, 2)} s: ${felt}${floor}`, 'good'];
  return [`not quiet for ${figures(v.still, 2)} s: ${felt}${floor}`, v.still < 1 ? 'price' : 'bad'];
}

/** What the page says of a side: [text, 'bad' | 'price' | 'good' | ''] for each remark. */
function remarks(v) {
  const said = [];
  said.push(v.made > 1e-9 ? [`made ${joules(v.made)} out of nothing`, 'bad'] : ['made no energy', 'good']);
  said.push(quietness(v));
  if (v.shown > 0)
    said.push([
      `shows ${figures(v.shown)} of ${figures(v.asked)} N/m`,
      v.shown < 0.9 * v.asked || v.shown > 1.1 * v.asked ? 'price' : 'good',
    ]);
  if (v.buzz >= 25) said.push([`buzzes at ${figures(v.buzz)} Hz by ${figures(v.swing, 2)} N`, 'bad']);
  else if (v.buzz > 0)
    said.push([`jumps ${figures(v.buzz, 2)} times a second by ${figures(v.swing, 2)} N`, 'price']);
  if (v.worst > 0.02) said.push([`stepped by ${figures(v.worst, 2)} N at most`, '']);
  if (v.behind > 3e-4) said.push([`sinks ${figures(v.behind * 1e3, 2)} mm behind the surface`, 'price']);
  if (v.settled) said.push([`settled at ${figures(v.force, 2)} N`, 'good']);
  else if (v.touching && v.force > 0.02) {
    if (!v.buzz) said.push([`pushes with ${figures(v.force, 2)} N`, '']);
  } else if (!v.buzz) said.push(['in free air', '']);
  if (v.event > 0) said.push([`event: ${events[v.event]}`, 'price']);
  if (v.rubs > 0.1) said.push([`rubs with ${figures(v.rubs, 2)} N`, '']);
  return said;
}

/** Why the promise of a composition does not hold as the device is set, or nothing. */
function broken(promise, code, set) {
  if (!promise) return '';
  const told = Number(code.match(/late_loop_limits<(\d+)>/)?.[1] ?? 0);
  if (told !== set.late) return `you told ${told} ticks late, it is ${set.late}`;
  if (promise === 1 && set.mode > 0 && !/_transmission/.test(code))
    return 'motor and handle are taken for one mass, and there is a cable between them';
  const steps = set.quantum > 0 && !/encoder_device|dual_ledger|quantised_energy/.test(code);
  if (steps) return `positions are taken for exact, and come in steps of ${figures(set.quantum * 1e6)} µm`;
  return '';
}

/** What a slider can show of x, which is in its unit. */
const inRange = (name, x) => Math.min(knobs[name][4], Math.max(knobs[name][3], x));

/** Facts [SI units] as the sliders can show them, and a sentence for each that they cannot. */
function shown(facts) {
  const set = {},
    said = [];
  for (const [name, fact] of Object.entries(facts)) {
    const [label, unit, scale] = knobs[name],
      x = fact * scale,
      kept = inRange(name, x);
    if (kept !== x) said.push(`${label} ${figures(x)} ${unit} is shown as ${figures(kept)}.`);
    set[name] = kept / scale;
  }
  return {set, said};
}

/** What a file of identification/device_file.hpp says of a device, as settings; or the sentence that says why not. */
function readDevice(text) {
  let given;
  try {
    given = JSON.parse(text);
  } catch {
    return {refused: 'This is no JSON. Paste the whole file that “identify --json FILE” has written.'};
  }
  if (given === null || typeof given !== 'object' || given.passive_haptics_device !== 1)
    return {refused: 'A file of identify begins with "passive_haptics_device": 1, and this does not.'};
  if (given.rotary) return {refused: 'This device turns, and what is on this page goes straight.'};
  const names = {mass: 'mass', damping: 'damping', friction: 'friction', quantum: 'quantum', latency: 'late'};
  const facts = {quantum: 0, friction: 0};
  for (const [key, name] of Object.entries({...names, force_limit: 'motors', hand_force: 'hand_force'})) {
    if (given[key] === undefined) continue;
    if (typeof given[key] !== 'number' || !Number.isFinite(given[key]))
      return {refused: `"${key}" is no number: ${String(given[key]).slice(0, 40)}.`};
    facts[name] = given[key];
  }
  const {set, said} = shown(facts);
  return {set, said: said.join(' ')};
}

/** A number of a field, or the sentence that says why it is none. */
function readNumber(text, name) {
  const [label, unit, , least, most] = knobs[name];
  const trimmed = String(text).trim().replace(',', '.').replace('−', '-');
  const x = trimmed === '' ? NaN : Number(trimmed);
  if (!Number.isFinite(x)) {
    return {
      refused:
        `“${String(text).slice(0, 40)}” is no number, so ${label} stays as it was. ` +
        `Give one from ${least} to ${most} ${unit}.`,
    };
  }
  if (x < least || x > most) {
    const near = inRange(name, x);
    return {
      value: near,
      said: `${label} goes from ${least} to ${most} ${unit}: ${near} was taken for ${figures(x)}.`,
    };
  }
  return {value: x};
}

/** The settings in a link. What it cannot read it names, and leaves at its default. */
function readLink(hash) {
  const found = {scene: 'wall', step: null, left: null, right: null, set: {}, said: []};
  const given = new URLSearchParams(hash.replace(/^#/, ''));
  if ([...given].length === 0) return found;
  const other = given.get('v') !== String(version);
  const strange = [];
  for (const [key, text] of given) {
    if (key === 'v') continue;
    if (key === 'scene') {
      if (Object.hasOwn(scenes, text)) found.scene = text;
      else strange.push(`scene “${text.slice(0, 30)}”`);
    } else if (key === 'step') {
      if (Object.keys(problems)[Number(text) - 1]) found.step = Number(text) - 1;
      else strange.push(`step “${text.slice(0, 20)}”`);
    } else if (key === 'left' || key === 'right') {
      found[key] = text;
    } else if (Object.hasOwn(knobs, key)) {
      const read = readNumber(text, key);
      if (read.value !== undefined && !read.said) found.set[key] = read.value / knobs[key][2];
      else strange.push(`${key} = “${text.slice(0, 20)}”`);
    } else {
      strange.push(`“${key.slice(0, 30)}”`);
    }
  }
  if (other) found.said.push('This link was made by another version of the page; what it knows was taken.');
  if (strange.length) found.said.push(`Left alone in the link: ${strange.slice(0, 5).join(', ')}.`);
  return found;
}

function writeLink(scene, left, right, set, usual, step = null) {
  const link = new URLSearchParams({v: version, scene, left, right});
  if (step !== null) link.set('step', step + 1);
  for (const name of scenes[scene].knobs) {
    if (set[name] !== usual[name]) link.set(name, Number((set[name] * knobs[name][2]).toPrecision(6)));
  }
  return `#${link}`;
}

/** A composition as one would write it: a line for each part. */
function layOut(text) {
  let out = '',
    depth = 0;
  const open = Math.max(text.indexOf('{'), 0);
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if ('{(<'.includes(c) && !(c === '<' && text[i + 1] === ' ')) ++depth;
    if ('})>'.includes(c)) --depth;
    out += c;
    if (c === ',' && depth === 1 && i > open) {
      out += '\n    ';
      while (text[i + 1] === ' ') ++i;
    }
  }
  return out;
}

/** The C++ of a side, to be pasted: a whole program that runs. */
function program(scene, text, set) {
  const n = x => String(Number(x.toPrecision(9)));
  const about = scenes[scene],
    dof = about.dof;
  const byHand = !text.startsWith('ph::make_');
  const [device] = text.match(/ph::(exact|encoder)_device ?\{[^}]*\}/) ?? [''],
    [hand] = text.match(/ph::known_hand ?\{[^}]*\}/) ?? [''];
  const declared = (name, part) => (part ? `constexpr ${part.replace(/ ?\{ ?/, ` ${name}{`).replace(' }', '}')};\n` : '');
  const made = byHand ? text : text.replace(device, 'device').replace(hand, 'hand').replace('( ', '(');
  const pair = text.startsWith('std::pair'),
    guard = text.startsWith('ph::make_guard'),
    body = !about.walls;
  const constants = [
    ['mass', set.mass, 'of the device, the smallest there is [kg]'],
    ['damping', set.damping, 'of the device, a lower bound [N·s/m]'],
    ['friction', set.friction, 'dry, of the device, a lower bound [N]'],
    ['quantum', set.quantum, 'a step of the encoders [m]'],
    ['motors', set.motors, 'the most they hold [N]'],
    ['hand_force', set.hand_force, 'the most the hand pushes with [N]'],
    ['roughness', set.roughness, 'static coefficient of the surface'],
    ['mode', set.mode, 'resonance of motor and handle, the cable between them [Hz]'],
    ['tick', 1e-3, 'the longest of your loop [s]'],
    body ? ['young', set.young, 'of the tissue [Pa]'] : /make_mesh_touch/.test(text) ? ['young', 0, ''] : ['stiffness', set.stiffness, 'of the surface [N/m]'],
  ]
    .filter(([name]) => name !== 'roughness' || /\broughness\b/.test(text))
    .filter(([name]) => name !== 'mode' || about.cable)
    .filter(([name]) => name !== 'young' || body)
    .map(([name, value, what]) => `constexpr double ${name} = ${n(value)};  // ${what}`);

  const moves = !body && (set.heave > 0 || (set.tilt > 0 && about.knobs.includes('tilt')));
  const up = moves ? `${n(set.heave)} * std::sin(6.9 * t)` : '0';
  const slope = moves && about.knobs.includes('tilt') ? `${n(set.tilt)} * std::sin(5.0 * t)` : '0';
  const mesh = /make_mesh_touch/.test(text);
  const world = mesh
    ? `// A sheet of 2 mm: the nodes of its upper and its lower side; your mesh goes here.
static ph::mesh::surface sheet() {
  std::vector<ph::mesh::triple> nodes;
  std::vector<ph::mesh::triangle> triangles;
  for (int side = 0; side < 2; ++side) {
    const int first = 62 * side;
    for (int i = 0; i <= 30; ++i) {
      const double x = 0.004 * i - 0.06, z = 0.003 * std::cos(105 * x) - 0.002 * side;
      for (const double y : {-0.06, 0.06}) nodes.push_back({x, y, z});
    }
    for (int i = first; i < first + 60; i += 2) {
      triangles.push_back({i, i + 2, i + 3});
      triangles.push_back({i, i + 3, i + 1});
    }
  }
  return ph::mesh::surface(triangles, nodes);
}
`
    : body
    ? `// The tissue: a ball of 16 tetrahedra; environment/msh_input.hpp reads a mesh of yours.
static env::deformable_body tissue(env::ball(0.05), {.young = young, .poisson = 0.3},
                                   env::ball_fixed_nodes(), env::body_options{});
`
    : `// What the world says of its surfaces ${moves ? 'at t [s]' : 'at any time'}; yours goes here.
static std::array<plane, ${about.walls.length}> world(double${moves ? ' t' : ''}) {
${about.before ? `  ${about.before.replace('SLOPE', slope)}\n` : ''}  return {{${about.walls.map(w => w.replace('UP', up)).join(',\n           ')}}};
}
`;
  const tells = mesh
    ? '      // sheet.update(nodes), if they have moved'
    : body
    ? `      tissue.update(handle.position(), handle_force);
      if (const auto& c = tissue.contact(); c.triangle >= 0)
        ${/contact_set/.test(text) ? 'touch.source().update(0, plane' : 'touch.update('}{.point = c.point, .normal = c.normal, .stiffness = c.stiffness});`
    : `      const auto walls = world(${moves ? 'n * tick' : '0'});
${
  guard
    ? '      wall = walls[0];'
    : about.walls
        .map((_, i) =>
          pair
            ? `      touch.${i ? 'second' : 'first'}.update(walls[${i}]);`
            : /ph::contacts\{/.test(text)
              ? `      touch.source().template contact<${i}>().update(walls[${i}]);`
              : /contact_set|make_contacts/.test(text)
                ? `      touch.source().update(${i}, walls[${i}]);`
                : `      touch.update(walls[${i}]);`
        )
        .join('\n')
}`;
  const asks = pair
    ? 'touch.first.tick(sample.position, ph::seconds{tick}).force +\n                                touch.second.tick(sample.position, ph::seconds{tick}).force'
    : guard
      ? 'touch.tick(sample, depth > 0 ? wall.stiffness * depth : 0.0).force'
      : 'touch.tick(sample).force';
  const stored = `${mesh ? 'const auto surface = sheet();\n  ' : ''}auto touch = ${layOut(made).replaceAll('\n', '\n  ')};`;
  const ofOthers = /energy_bounding|sector_bound|_tank|series_|reference_energy|position_modulation|nonlinear_coupling|_increment|_augmentation/;
  const touched = mesh ? '  touch.source().touch(surface);\n' : '';
  const checked = pair ? 'touch.first.check()' : 'touch.check()';
  const why = pair
    ? '  // By hand, and wrong: each port spends the damping of the device, which is there once.\n'
    : byHand
      ? '  // By hand, to be compared with what make_touch() and make_contacts() give.\n'
      : '';
  return `// ${about.title}, pasted from the page of passive_haptics:
//     g++ -std=c++20 -O2 -I include -isystem /usr/include/eigen3 this.cpp && ./a.out
#include <passive_haptics/passive_haptics.hpp>
${ofOthers.test(stored) ? '#include <passive_haptics/published/published.hpp>\n' : ''}${
  body
    ? '#include <passive_haptics/environment/ball.hpp>\n#include <passive_haptics/environment/deformable_body.hpp>\n'
    : ''
}${about.cable ? '#include <passive_haptics/compliant/compositions.hpp>\n#include <passive_haptics/simulation/compliant_device.hpp>\n' : ''}${mesh ? '#include <passive_haptics/mesh.hpp>\n' : ''}#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/quiet.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <utility>
${mesh ? '#include <vector>\n' : ''}
namespace ph = passive_haptics;
namespace sim = ph::simulation;
${body ? 'namespace env = ph::environment;\n' : ''}using scene = ph::space<double, ${dof}>;
${mesh ? '' : 'using plane = ph::half_space<scene>;\n'}
${constants.join('\n')}

${byHand ? '' : '// Your device and your hand, as you may state them: docs/design/identification.md.\n'}${declared('device', device)}${declared('hand', hand)}
${world}
int main() {
${why}  ${stored}
  if (const auto fault = ${checked}) {
    std::printf("%s = %g: %s is asked for\\n", fault.parameter, fault.value, fault.remedy);
    return 1;
  }
${touched}  // A simulated device, and a hand that presses; your driver takes their place.
  sim::${about.cable ? 'compliant_' : ''}device<scene, sim::impedance_hand<scene>> handle(
      {.mass = mass, ${about.cable ? '.share = 0.1, .mode = mode, ' : ''}.damping = damping, .friction = friction, .force_limit = motors,
       .quantum = quantum, .start = ${about.start}, .latency = ${n(set.late)}},
      {.stiffness = ${n(set.hand_stiffness)}, .limit = hand_force, .target = ${about.press}});
  auto sample = handle.exchange(scene::zero());
${about.cable ? '  double before = handle.position();\n' : ''}  sim::quiet_judge<scene> judge${set.quantum > 0 && !body ? `(sim::quiet_bars{}.on_encoders(${set.friction > 0 ? '' : '4 * '}quantum, stiffness, mass))` : ''};
${body ? '  scene::vector handle_force = scene::zero();\n' : ''}${guard ? '  plane wall{};\n' : ''}  double least = 0, pressed = 0;
  for (int n = 0; n < 4000; ++n) {
    if (n % ${Math.max(1, Math.round(1000 / set.rate))} == 0) {  // ${n(set.rate)} times a second there are news
${tells}
    }
${guard ? '    const double depth = wall.point - sample.position;  // your renderer: here a bare spring\n' : ''}    const scene::vector force = ${asks};
    sample = handle.exchange(force);
${body ? '    handle_force = sample.held;\n' : ''}
    pressed = scene::norm(force);
    const scene::vector along = force * (pressed > 0 ? 1 / pressed : 0.0);
${about.cable ? '    const double speed = (handle.position() - std::exchange(before, handle.position())) / tick;\n' : ''}    judge.add(force, ${about.cable ? 'speed' : 'handle.velocity()'}, tick, std::span(&along, pressed > 0 ? 1 : 0));
    least = std::min(least, handle.${about.cable ? 'energy()' : 'meter().with_friction()'});
  }
  const auto& last = judge.figures();
  std::printf("presses with %.2f N, made %.3g mJ, %s: %.2g N rms above 10 Hz, %.2g mm/s, %.2g N a tick\\n",
              pressed, -1e3 * least + 0.0, judge.quiet() ? "quiet" : "not quiet", last.force,
              1e3 * last.speed, last.step);
  return 0;
}
`;
}

if (typeof module !== 'undefined') {
  module.exports = {
    knobs,
    scenes,
    problems,
    figures,
    joules,
    remarks,
    events,
    broken,
    readDevice,
    verdictNames,
    verdictOf,
    readNumber,
    readLink,
    writeLink,
    program,
  };
}
