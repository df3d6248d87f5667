// SPDX-License-Identifier: BSD-3-Clause
// The page itself: it runs the stage, draws it, and hears the reader. Words and numbers are in words.js.
(() => {
  'use strict';

  const $ = id => document.getElementById(id);
  const all = selector => [...document.querySelectorAll(selector)];
  const sides = [0, 1];
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  const plotted = 2000; // ticks

  // ------------------------------------------------------------------------------------------ sentences
  let noticeUntil = 0;
  function notice(text, seconds = 12) {
    $('notice').textContent = text;
    $('notice').hidden = !text;
    noticeUntil = performance.now() + seconds * 1000;
  }
  function fatal(text) {
    notice(text, 1e9);
    $('notice').classList.add('fatal');
    for (const e of all('main, nav, footer .row')) e.hidden = true;
    document.documentElement.dataset.state = 'refused';
  }

  // -------------------------------------------------------------------------------------------- modules
  const packed = JSON.parse($('modules').textContent);
  const bytesOf = {};
  async function unpack(name) {
    if (bytesOf[name]) return bytesOf[name];
    const raw = Uint8Array.from(atob(packed[name].wasm), c => c.charCodeAt(0));
    const plain = new Blob([raw]).stream().pipeThrough(new DecompressionStream('gzip'));
    bytesOf[name] = await WebAssembly.compile(await new Response(plain).arrayBuffer());
    return bytesOf[name];
  }
  /** An instance of its own. What a module asks of a system, and never uses, is answered with 0. */
  async function instance(name) {
    const compiled = await unpack(name);
    // What a module may ask of a system is not there: 8, no such descriptor; to end is an error that shows.
    const absent = name => () => {
      if (name === 'proc_exit') throw new Error('the module has ended');
      return 8;
    };
    const imports = {};
    for (const i of WebAssembly.Module.imports(compiled)) (imports[i.module] ??= {})[i.name] = absent(i.name);
    const e = (await WebAssembly.instantiate(compiled, imports)).exports;
    e._initialize();
    return e;
  }
  const decoder = new TextDecoder();
  function text(e, at) {
    const bytes = new Uint8Array(e.memory.buffer);
    let end = at;
    while (bytes[end]) ++end;
    return decoder.decode(bytes.slice(at, end));
  }
  const numbers = (e, at, n) => new Float64Array(e.memory.buffer, at, n);

  // ---------------------------------------------------------------------------------------------- state
  const loaded = {}; // by module: its exports, and the index of each setting
  const state = {scene: 'wall', step: null, chosen: [0, 0], usual: {}, set: {}, menu: []};
  let e = null; // exports of the module of this scene
  let s = 0; // stage in it
  let hand = [0, 0];
  let lastTime = null,
    owed = 0,
    lag = 1,
    frameCost = 0,
    speed = 1;

  async function show(scene, left, right, set, itself) {
    const about = scenes[scene];
    if (!loaded[about.module]) {
      const m = await instance(about.module);
      const index = {};
      for (let i = 0; i < m.ph_parameters(); ++i) index[text(m, m.ph_parameter(i))] = i;
      const usual = [];
      for (let k = 0; k < m.ph_stages(); ++k) {
        usual.push(Object.fromEntries(Object.entries(index).map(([name, i]) => [name, m.ph_get(k, i)])));
      }
      loaded[about.module] = {e: m, index, usual};
    }
    const module = loaded[about.module];
    e = module.e;
    s = about.stage;
    state.scene = scene;
    state.usual = module.usual[s];
    state.set = {...state.usual};
    state.menu = [];
    for (let i = 0; i < e.ph_controllers(s); ++i) {
      state.menu.push({
        name: text(e, e.ph_name(s, i)),
        says: text(e, e.ph_says(s, i)),
        promise: e.ph_promise(s, i),
        code: text(e, e.ph_text(s, i)),
      });
    }
    for (const name of Object.keys(state.set)) put(name, set[name] ?? state.usual[name]);
    const found = [left, right].map(name => state.menu.findIndex(c => c.name === name));
    const missing = [left, right].filter((name, i) => name && found[i] < 0);
    if (missing.length)
      notice(`There is no controller “${missing[0].slice(0, 60)}” in this scene; another was taken.`);
    state.chosen = [
      found[0] < 0 ? 0 : found[0],
      found[1] < 0 ? Math.min(1, state.menu.length - 1) : found[1],
    ];
    fillMenus();
    fillKnobs();
    byItself(itself ?? !calm.matches);
    restart();
    pressed('scenes', scene);
  }
  function put(name, value) {
    state.set[name] = value;
    e.ph_set(s, loaded[scenes[state.scene].module].index[name], value);
  }

  // ------------------------------------------------------------------------------------------- the article
  const titles = Object.keys(problems);
  const wide = () => state.step !== null && problems[titles[state.step]].wide === true;
  function tell(step, sentence) {
    state.step = step;
    const p = step === null ? null : problems[titles[step]];
    $('heading').textContent = p ? `${step + 1}. ${titles[step]}` : scenes[state.scene].title;
    $('says').textContent =
      (sentence ?? p.says) + (p?.heard && sentence === undefined ? ' Listen: the left ear hears the left side, and the right ear hardly anything.' : '');
    $('device').hidden = !p?.device;
    $('back').disabled = step === 0;
    $('next').disabled = step === titles.length - 1;
    $('counted').hidden = !wide();
    document.body.classList.toggle('wide', wide());
    // One picture is looked at first, two are told of first. What is focused stays where it is, and keeps the focus.
    const steer = $('steer'),
      pictures = document.querySelector('main');
    steer[wide() ? 'before' : 'after'](pictures);
    steer[wide() ? 'after' : 'before']($('step'));
    count(false);
    pressed('problems', p ? titles[step] : '');
    $('slider').replaceChildren(...(p ? [knob(p.knob)] : []));
    $('slider').hidden = $('lab').getAttribute('aria-expanded') === 'true' || !p;
  }
  function count(yes) {
    $('counted').setAttribute('aria-checked', String(yes));
    all('.side').forEach((side, w) => side.classList.toggle('shown', Boolean(w) === yes));
  }
  async function go(step, set = null, left = null, right = null) {
    const p = problems[titles[step]];
    state.step = step;
    await show(p.scene, left ?? p.left, right ?? p.right, set ?? p.set);
    tell(step);
    remember();
  }
  function openLab(yes) {
    $('lab').setAttribute('aria-expanded', String(yes));
    document.body.classList.toggle('open', yes);
    $('slider').hidden = yes || state.step === null;
  }
  function takeDevice(set, said) {
    for (const [name, x] of Object.entries(set)) put(name, x);
    fillKnobs();
    $('slider').replaceChildren(knob(problems[titles[state.step]].knob));
    const right = state.menu.findIndex(c => c.name === (state.set.quantum > 0 ? 'make_touch, encoders' : 'make_touch'));
    if (right >= 0) state.chosen[1] = right;
    fillMenus();
    restart();
    if (said) notice(said);
  }
  function fillDevices() {
    const none = new Option('choose one', '');
    $('devices').replaceChildren(none);
    for (let i = 0; i < e.ph_devices(); ++i) {
      if (numbers(e, e.ph_facts(i), 4).some(Number.isFinite)) $('devices').append(new Option(text(e, e.ph_device(i)), i));
    }
    $('devices').onchange = () => {
      if ($('devices').value === '') return;
      const facts = [...numbers(e, e.ph_facts(Number($('devices').value)), 4)],
        names = ['mass', 'friction', 'quantum', 'motors'];
      const known = names.filter((_, i) => Number.isFinite(facts[i])),
        unknown = ['Damping b', ...names.filter(name => !known.includes(name)).map(name => knobs[name][0])],
        {set, said} = shown(Object.fromEntries(known.map(name => [name, facts[names.indexOf(name)]])));
      said.push(`Nobody has published of this device: ${unknown.join(', ')}. They stay as they were; identify measures them.`);
      takeDevice(set, said.join(' '));
    };
    $('take').onclick = () => {
      const read = readDevice($('identified').value);
      if (read.refused) notice(read.refused);
      else takeDevice(read.set, read.said);
    };
  }
  function restart() {
    hand = [...numbers(e, e.ph_home(s), 2)];
    e.ph_aim(s, ...hand);
    for (const w of sides) {
      e.ph_choose(s, w, state.chosen[w]);
      tellOf(w);
    }
    e.ph_restart(s);
    ranges.force = ranges.energy = null;
    owed = 0;
    remember();
    drawBudget();
    if (!$('codes').hidden) showCode();
  }
  function remember() {
    const link = writeLink(
      state.scene,
      ...state.chosen.map(i => state.menu[i].name),
      state.set,
      state.usual,
      state.step
    );
    try {
      history.replaceState(null, '', link);
    } catch {
      location.hash = link;
    }
  }

  // ----------------------------------------------------------------------------------------------- menus
  function button(label, click) {
    const b = document.createElement('button');
    b.textContent = label;
    b.setAttribute('aria-pressed', 'false');
    b.onclick = click;
    return b;
  }
  function pressed(id, label) {
    const row = $(id);
    for (const b of row.children) {
      b.setAttribute('aria-pressed', String(b.dataset.key === label));
      if (b.dataset.key === label) row.scrollLeft = b.offsetLeft - (row.clientWidth - b.offsetWidth) / 2 - row.offsetLeft;
    }
  }
  function fillMenus() {
    all('.side').forEach((side, w) => {
      const menu = side.querySelector('select');
      menu.replaceChildren();
      [2, 1, 0].forEach(kind => {
        const group = document.createElement('optgroup');
        group.label = promises[kind];
        state.menu.forEach((c, i) => {
          if (c.promise === kind) group.append(new Option(c.name, i));
        });
        if (group.children.length) menu.append(group);
      });
      menu.value = state.chosen[w];
      menu.onchange = () => {
        state.chosen[w] = Number(menu.value);
        tellOf(w);
        restart();
      };
      tellOf(w);
    });
  }
  function tellOf(w) {
    const c = state.menu[state.chosen[w]],
      side = all('.side')[w];
    const why = broken(c.promise, `${c.name} ${c.code}`, state.set),
      promise = side.querySelector('.promise');
    side.querySelector('.who').textContent = c.name === 'none' ? 'bare spring' : c.name;
    promise.textContent = why ? `✗ ${promiseShort[c.promise]}: ${why}` : promiseShort[c.promise];
    promise.classList.toggle('broken', Boolean(why));
    promise.title = promises[c.promise];
    side.querySelector('.about').textContent = `${c.says} Its type: ${promises[c.promise]}.`;
  }
  const rebuilds = [
    'damping',
    'mass',
    'friction',
    'quantum',
    'motors',
    'late',
    'roughness',
    'hand_stiffness',
    'hand_force',
    'latency',
    'loss',
    'young',
    'mode',
  ];
  function fillKnobs() {
    $('knobs').replaceChildren(...scenes[state.scene].knobs.map(name => knob(name, 'field_')));
  }
  /** A slider and a field; the one of the article and the one of the lab follow each other. */
  function knob(name, prefix = 'step_') {
    const [label, unit, scale, least, most, logarithmic, whole] = knobs[name];
    const box = document.createElement('div'),
      range = document.createElement('input'),
      field = document.createElement('input');
    const tag = document.createElement('label'),
      of = document.createElement('span');
    box.className = 'knob';
    tag.textContent = label;
    tag.htmlFor = field.id = `${prefix}${name}`;
    box.dataset.name = name;
    of.className = 'unit';
    of.textContent = unit;
    field.type = 'text';
    field.inputMode = 'decimal';
    field.autocomplete = 'off';
    range.type = 'range';
    range.setAttribute('aria-label', label);
    range.min = 0;
    range.max = whole ? most - least : 500;
    const toValue = at => {
      const share = at / range.max;
      const x = logarithmic ? least * (most / least) ** share : least + (most - least) * share;
      return whole ? Math.round(x) : Number(x.toPrecision(3));
    };
    const toAt = x =>
      range.max *
      (logarithmic ? Math.log(x / least) / Math.log(most / least) : (x - least) / (most - least));
    const display = () => {
      const x = state.set[name] * scale;
      range.value = toAt(inRange(name, x));
      range.setAttribute('aria-valuetext', `${figures(x)} ${unit}`);
      field.value = figures(x);
    };
    const take = x => {
      put(name, x / scale);
      for (const other of all(`.knob[data-name="${name}"]`)) other.display();
      if (rebuilds.includes(name)) restart();
      else {
        remember();
        drawBudget();
      }
    };
    range.oninput = () => take(toValue(Number(range.value)));
    field.onchange = () => {
      const read = readNumber(field.value, name);
      if (read.refused) {
        notice(read.refused);
        display();
        return;
      }
      if (read.said) notice(read.said);
      take(whole ? Math.round(read.value) : read.value);
    };
    box.display = display;
    display();
    box.append(tag, field, of, range);
    return box;
  }

  // --------------------------------------------------------------------------------------------- the hand
  function byItself(yes) {
    e.ph_by_itself(s, yes ? 1 : 0);
    $('itself').setAttribute('aria-pressed', String(yes));
  }
  function aim(x, y) {
    if ($('itself').getAttribute('aria-pressed') === 'true') byItself(false);
    const [cx, cy, height] = scenes[state.scene].view;
    hand = [
      Math.min(cx + 2 * height, Math.max(cx - 2 * height, x)),
      Math.min(cy + height, Math.max(cy - height, y)),
    ];
    e.ph_aim(s, ...hand);
  }
  function listenTo(view) {
    const at = event => {
      const box = view.getBoundingClientRect(),
        [cx, cy, height] = scenes[state.scene].view,
        scale = height / box.height;
      let y = cy - (event.clientY - box.top - box.height / 2) * scale;
      if (event.pointerType === 'pen' && event.pressure > 0) y -= 0.02 * event.pressure; // who presses, presses
      aim(cx + (event.clientX - box.left - box.width / 2) * scale, y);
    };
    view.onpointermove = event => {
      if (event.pointerType !== 'mouse' || event.buttons) at(event); // who only passes by takes nothing away
    };
    view.onpointerdown = event => {
      try {
        view.setPointerCapture(event.pointerId);
      } catch {
        /* a pointer that is gone already */
      }
      at(event);
    };
    view.onkeydown = event => {
      const step = event.shiftKey ? 5e-3 : 1e-3;
      const way = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]}[
        event.key
      ];
      if (way) aim(hand[0] + way[0], hand[1] + way[1]);
      else if (event.key === 'Home') aim(...numbers(e, e.ph_home(s), 2));
      else return;
      event.preventDefault();
    };
  }

  // ---------------------------------------------------------------------------------------------- drawing
  let colours = {};
  function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ['bg', 'ink', 'soft', 'line', 'rule', 'left', 'right', 'wall', 'edge']) {
      colours[name] = style.getPropertyValue(`--${name}`).trim();
    }
  }
  const letter = () => parseFloat(getComputedStyle(document.documentElement).fontSize);
  /** A context in CSS pixels, larger ones where the letters are larger than 21; null where there is none to be had. */
  function context(canvas) {
    const larger = Math.max(1, letter() / 21),
      d = (devicePixelRatio || 1) * larger,
      w = Math.max(1, canvas.clientWidth / larger),
      h = Math.max(1, canvas.clientHeight / larger);
    if (canvas.width !== Math.round(w * d) || canvas.height !== Math.round(h * d)) {
      canvas.width = Math.round(w * d);
      canvas.height = Math.round(h * d);
    }
    const g = canvas.getContext('2d');
    if (!g) return null;
    g.setTransform(d, 0, 0, d, 0, 0);
    g.clearRect(0, 0, w, h);
    return {g, w, h};
  }
  function line(g, points, colour, width, dash = []) {
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.setLineDash(dash);
    g.beginPath();
    points.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
    g.stroke();
    g.setLineDash([]);
  }
  function arrow(g, x, y, dx, dy, colour, width) {
    const length = Math.hypot(dx, dy);
    if (length < 3) return;
    const ux = dx / length,
      uy = dy / length,
      head = 3 + 1.5 * width;
    line(
      g,
      [
        [x, y],
        [x + dx, y + dy],
      ],
      colour,
      width
    );
    g.fillStyle = colour;
    g.beginPath();
    g.moveTo(x + dx + ux * head, y + dy + uy * head);
    g.lineTo(x + dx - uy * head * 0.7, y + dy + ux * head * 0.7);
    g.lineTo(x + dx + uy * head * 0.7, y + dy - ux * head * 0.7);
    g.fill();
  }
  const planesOf = (w, local) => {
    const at = e.ph_planes(s, w, local),
      n = numbers(e, at, 1)[0];
    return Array.from({length: n}, (_, i) => [...numbers(e, at + 8 + 32 * i, 4)]);
  };
  function drawView(w) {
    const c = context(all('.view')[w]);
    if (!c) return;
    const {g, w: width, h: height} = c,
      [cx, cy, span] = scenes[state.scene].view,
      scale = height / span;
    const X = x => width / 2 + (x - cx) * scale,
      Y = y => height / 2 - (y - cy) * scale;
    const colour = w ? colours.right : colours.left,
      count = e.ph_count(s, w);
    const far = (2 * (width + height)) / scale;

    const at = e.ph_outline(s, w),
      corners = numbers(e, at, 1)[0],
      body = [...numbers(e, at + 8, 2 * corners)];
    if (corners) {
      g.fillStyle = colours.wall;
      g.strokeStyle = colours.edge;
      g.lineWidth = 0.6;
      for (let i = 0; i < 2 * corners; i += 6) {
        g.beginPath();
        g.moveTo(X(body[i]), Y(body[i + 1]));
        g.lineTo(X(body[i + 2]), Y(body[i + 3]));
        g.lineTo(X(body[i + 4]), Y(body[i + 5]));
        g.closePath();
        g.fill();
        g.stroke();
      }
    } else {
      for (const [px, py, nx, ny] of planesOf(w, 0)) {
        g.fillStyle = colours.wall;
        g.beginPath();
        g.moveTo(X(px - far * ny), Y(py + far * nx));
        g.lineTo(X(px + far * ny), Y(py - far * nx));
        g.lineTo(X(px + far * (ny - nx)), Y(py - far * (nx + ny)));
        g.lineTo(X(px - far * (ny + nx)), Y(py + far * (nx - ny)));
        g.fill();
        line(
          g,
          [
            [X(px - far * ny), Y(py + far * nx)],
            [X(px + far * ny), Y(py - far * nx)],
          ],
          colours.edge,
          1.5
        );
      }
    }
    if (!count) return;
    const kept = e.ph_rows_kept(),
      rowWidth = e.ph_row_width(),
      rows = numbers(e, e.ph_rows(s, w), kept * rowWidth);
    const now = ((count - 1) % kept) * rowWidth,
      x = X(rows[now + 1]),
      y = Y(rows[now + 2]),
      hx = X(rows[now + 3]),
      hy = Y(rows[now + 4]);
    if (scenes[state.scene].dof === 1)
      line(
        g,
        [
          [x, 0],
          [x, height],
        ],
        colours.line,
        5
      );
    for (const [px, py, nx, ny] of planesOf(w, 1)) {
      // the local model, near the device
      if (!Number.isFinite(nx) || Math.hypot(nx, ny) < 0.5) continue;
      const along = (rows[now + 1] - px) * ny - (rows[now + 2] - py) * nx,
        fx = px + along * ny,
        fy = py - along * nx;
      const reach = (0.3 * width) / scale;
      line(
        g,
        [
          [X(fx - reach * ny), Y(fy + reach * nx)],
          [X(fx + reach * ny), Y(fy - reach * nx)],
        ],
        colour,
        1.6,
        [6, 5]
      );
      const ox = X(fx + 0.8 * reach * ny),
        oy = Y(fy - 0.8 * reach * nx);
      arrow(g, ox, oy, 20 * nx, -20 * ny, colour, 1.4);
    }
    g.globalAlpha = 0.45;
    const trail = [];
    for (let i = Math.max(0, count - 250); i < count; i += 2) {
      const r = (i % kept) * rowWidth;
      trail.push([X(rows[r + 1]), Y(rows[r + 2])]);
    }
    line(g, trail, colour, 1.5);
    g.globalAlpha = 1;
    line(
      g,
      [
        [x, y],
        [hx, hy],
      ],
      colours.soft,
      1.4,
      [2, 3]
    );
    g.lineWidth = 2;
    g.strokeStyle = colours.ink;
    g.beginPath();
    g.arc(hx, hy, 7, 0, 7);
    g.stroke();
    const force = Math.hypot(rows[now + 5], rows[now + 6]),
      length = Math.min(0.34 * height, 9 * force);
    const from = scenes[state.scene].dof === 1 ? 10 : 0; // the top of the slide
    if (force > 0.05)
      arrow(g, x, y - from, (rows[now + 5] / force) * length, (-rows[now + 6] / force) * length, colour, 4);
    g.fillStyle = colour;
    g.beginPath();
    if (scenes[state.scene].dof === 1) g.roundRect(x - 15, y - 10, 30, 10, 3);
    else g.arc(x, y, 7, 0, 7);
    g.fill();
    if (y < 0 || y > height || x < 0 || x > width) {
      const away = Math.max(-y, y - height, -x, x - width) / scale;
      g.font = '13px system-ui, sans-serif';
      g.textAlign = 'center';
      g.textBaseline = 'middle';
      g.fillText(
        `the device is ${figures(away * 1e3, 2)} mm out of the picture`,
        width / 2,
        Math.min(height - 14, Math.max(14, y))
      );
    }
    drawTank(g, width, height, rows[now + 7]);
    if (!corners) drawGlass(w, c, rows, rowWidth, kept, count, colour);
  }
  /** What the hand has put in and not got back [J], on the scale of the plot below; red is overdrawn. */
  function drawTank(g, width, height, energy) {
    const r = ranges.energy;
    if (!r) return;
    const wide = Math.max(8, Math.min(22, width / 28)),
      left = width - wide - 8,
      top = 0.08 * height,
      bottom = 0.92 * height;
    const Y = v => bottom - ((v - r.low) / (r.high - r.low)) * (bottom - top);
    g.fillStyle = energy < 0 ? colours.left : colours.right;
    g.fillRect(left, Math.min(Y(0), Y(energy)), wide, Math.abs(Y(energy) - Y(0)));
    g.strokeStyle = colours.edge;
    g.lineWidth = 1.2;
    g.strokeRect(left, top, wide, bottom - top);
    line(
      g,
      [
        [left - 5, Y(0)],
        [left + wide + 3, Y(0)],
      ],
      colours.ink,
      1.6
    );
  }
  /** The contact, fifty times as large: the surface, the local model, the way of the last quarter of a second. */
  function drawGlass(w, {g, w: width, h}, rows, rowWidth, kept, count, colour) {
    // It follows the mean of the way, so that a device that buzzes moves in it, and not the surface.
    const first = Math.max(0, count - 250),
      mean = column => {
        let sum = 0;
        for (let i = first; i < count; ++i) sum += rows[(i % kept) * rowWidth + column];
        return sum / (count - first);
      };
    const radius = Math.max(26, Math.min(0.3 * h, 0.21 * width, 90)), // beside the device, not over it
      scale = (50 * h) / scenes[state.scene].view[2],
      x0 = mean(1),
      y0 = mean(2),
      ox = radius + 8,
      oy = radius + 8;
    const near = planesOf(w, 0).some(([px, py, nx, ny]) => Math.abs((x0 - px) * nx + (y0 - py) * ny) * scale < 3 * radius);
    if (!near) return;
    const X = x => ox + (x - x0) * scale,
      Y = y => oy - (y - y0) * scale,
      far = 3 * radius;
    g.save();
    g.beginPath();
    g.arc(ox, oy, radius, 0, 7);
    g.fillStyle = colours.bg;
    g.fill();
    g.clip();
    for (const [px, py, nx, ny] of planesOf(w, 0)) {
      const d = (x0 - px) * nx + (y0 - py) * ny,
        fx = ox - d * nx * scale,
        fy = oy + d * ny * scale;
      g.fillStyle = colours.wall;
      g.beginPath();
      g.moveTo(fx - far * ny, fy - far * nx);
      g.lineTo(fx + far * ny, fy + far * nx);
      g.lineTo(fx + far * (ny - 2 * nx), fy + far * (nx + 2 * ny));
      g.lineTo(fx - far * (ny + 2 * nx), fy - far * (nx - 2 * ny));
      g.fill();
    }
    const trail = [];
    for (let i = first; i < count; ++i) {
      const r = (i % kept) * rowWidth;
      trail.push([scenes[state.scene].dof === 1 ? ox - radius + (2 * radius * (i - count + 250)) / 250 : X(rows[r + 1]), Y(rows[r + 2])]);
    }
    line(g, trail, colour, 1.3);
    g.restore();
    g.strokeStyle = colours.ink;
    g.lineWidth = 1.2;
    g.beginPath();
    g.arc(ox, oy, radius, 0, 7);
    g.stroke();
    g.fillStyle = colours.soft;
    g.font = '11px system-ui, sans-serif';
    g.textAlign = 'center';
    g.textBaseline = 'top';
    g.fillText('× 50', ox, oy + radius + 2);
  }

  // Both sides share a scale; it grows at once and shrinks when nothing has needed it for a while.
  const ranges = {force: null, energy: null};
  function nice(x) {
    const power = 10 ** Math.floor(Math.log10(x));
    return [1, 2, 5, 10].find(k => k * power >= x * 0.9999) * power;
  }
  function column(w, c, f) {
    const kept = e.ph_rows_kept(),
      rowWidth = e.ph_row_width(),
      rows = numbers(e, e.ph_rows(s, w), kept * rowWidth);
    const count = e.ph_count(s, w),
      n = Math.min(count, plotted);
    for (let i = 0; i < n; ++i) f(plotted - n + i, rows[((count - n + i) % kept) * rowWidth + c]);
  }
  function rangeOf(kind, columns, least) {
    let low = 0,
      high = least;
    for (const w of sides)
      for (const c of columns)
        column(w, c, (_, v) => {
          if (v < low) low = v;
          if (v > high) high = v;
        });
    const want = [low < -0.02 * high ? -nice(-low) : 0, nice(high)],
      r = ranges[kind];
    if (!r || want[0] < r.low || want[1] > r.high || performance.now() > r.until) {
      ranges[kind] = {
        low: Math.min(want[0], r && performance.now() <= r.until ? r.low : 0),
        high: Math.max(want[1], r && performance.now() <= r.until ? r.high : 0),
        until: performance.now() + 2500,
      };
    }
    return ranges[kind];
  }
  function drawPlot(w, kind, lines, [title, short], say) {
    const c = context(all(`.plot.${kind}`)[w]);
    if (!c) return;
    const {g, w: width, h: height} = c,
      r = ranges[kind];
    const size = Math.max(10, Math.min(15, 0.72 * letter()));
    g.font = `${size}px system-ui, sans-serif`;
    const left = width < 240 ? 2 : 3.6 * size,
      top = size + 7,
      bottom = height - 5,
      span = r.high - r.low;
    const Y = v => bottom - ((v - r.low) / span) * (bottom - top),
      X = i => left + (i / plotted) * (width - left);
    g.fillStyle = colours.soft;
    g.textBaseline = 'top';
    g.textAlign = 'left';
    g.fillText(width < 240 ? `${short}, ${say(r.low)} to ${say(r.high)}` : title, left, 1);
    if (kind === 'energy' && r.low < 0) {
      // what was made out of nothing
      g.fillStyle = colours.left;
      g.globalAlpha = 0.1;
      g.fillRect(left, Y(0), width - left, bottom - Y(0));
      g.globalAlpha = 1;
      g.fillStyle = colours.soft;
    }
    line(
      g,
      [
        [left, Y(0)],
        [width, Y(0)],
      ],
      colours.rule,
      1
    );
    if (width >= 240) {
      g.textAlign = 'right';
      g.textBaseline = 'middle';
      if (Y(0) - top > 1.1 * size) g.fillText(say(r.high), left - 5, top + 2);
      if (bottom - Y(0) > 1.2 * size) g.fillText(say(r.low), left - 5, bottom - size / 3);
      g.fillText('0', left - 5, Math.min(Y(0), height - size / 2));
      g.textBaseline = 'top';
      g.fillText('last 2 s', width - 2, 1);
    }
    for (const [c, colour, dash] of lines) {
      // least and most of each pixel column
      const low = new Float64Array(Math.ceil(width) + 1).fill(Infinity),
        high = new Float64Array(low.length).fill(-Infinity);
      column(w, c, (i, v) => {
        const p = Math.floor(X(i));
        if (v < low[p]) low[p] = v;
        if (v > high[p]) high[p] = v;
      });
      const points = [];
      for (let p = 0; p < low.length; ++p) {
        if (low[p] > high[p]) continue;
        points.push([p, Y(low[p])]);
        if (high[p] > low[p]) points.push([p, Y(high[p])]);
      }
      line(g, points, colour, dash ? 1.2 : 1.6, dash ? [5, 4] : []);
    }
  }
  let nextWords = 0;
  const verdicts = [null, null];
  function judge(w) {
    const v = verdictOf(numbers(e, e.ph_verdict(s, w), verdictNames.length)),
      count = e.ph_count(s, w);
    if (state.scene === 'rub' && count) {
      v.rubs = Math.abs(
        numbers(e, e.ph_rows(s, w) + 8 * (((count - 1) % e.ph_rows_kept()) * e.ph_row_width() + 5), 1)[0]
      );
    }
    return v;
  }
  function draw(now) {
    for (const w of sides) drawView(w);
    if (now < nextWords && calm.matches) return;
    rangeOf('force', [6], 1);
    rangeOf('energy', [7, 8], 1e-3);
    const unit = Math.max(ranges.energy.high, -ranges.energy.low) >= 1 ? ['J', 1] : ['mJ', 1e3];
    for (const w of sides) {
      const colour = w ? colours.right : colours.left;
      drawPlot(w, 'force', [[6, colour]], ['Force up, N', 'Force, N'], v => figures(v));
      drawPlot(
        w,
        'energy',
        [
          [8, colours.soft, true],
          [7, colour],
        ],
        [`Energy at the port, ${unit[0]} (ledger dashed)`, `Energy, ${unit[0]}`],
        v => figures(v * unit[1])
      );
    }
    if (now < nextWords) return;
    nextWords = now + 250;
    if (noticeUntil && performance.now() > noticeUntil) {
      notice('');
      noticeUntil = 0;
    }
    for (const w of sides) {
      verdicts[w] = judge(w);
      const said = remarks(verdicts[w]),
        list = all('.remarks')[w];
      const key = said.join('|');
      if (list.dataset.key === key) continue;
      list.dataset.key = key;
      list.replaceChildren(
        ...said.map(([words, kind]) => {
          const item = document.createElement('li');
          item.textContent = words;
          item.className = kind;
          return item;
        })
      );
    }
    $('clock').textContent =
      lag > 0.95
        ? `${(e.ph_count(s, 0) / 1000).toFixed(1)} s of virtual time; a picture takes ${frameCost.toFixed(1)} ms.`
        : `This computer is slow: the clock runs at ${figures(100 * lag, 2)} % of real time. The physics is the same.`;
  }
  function drawBudget() {
    const b = [...numbers(e, e.ph_budget(s), 6)],
      names = ['sampled mass', 'kneading slowly', 'kneading fast', 'holding still'];
    const K = state.set.stiffness,
      deformable = !scenes[state.scene].knobs.includes('stiffness');
    const most = Math.max(K, ...b.slice(2).filter(Number.isFinite)),
      least = 10;
    const share = x =>
      `${Math.max(1, Math.min(100, (100 * Math.log(Math.max(x, least) / least)) / Math.log(most / least)))}%`;
    const bars = names.map((name, i) => [name, b[2 + i], i === b[1] ? 'binds' : '']);
    if (!deformable) bars.push(['this surface', K, K > b[0] ? 'over' : '']);
    $('bars').replaceChildren(
      ...bars.map(([name, x, kind]) => {
        const bar = document.createElement('div'),
          fill = document.createElement('i'),
          value = document.createElement('b'),
          label = document.createElement('span');
        bar.className = `bar ${kind}`;
        label.textContent = kind === 'binds' ? `${name} binds` : name;
        fill.style.width = Number.isFinite(x) ? share(x) : '100%';
        value.textContent = Number.isFinite(x) ? `${figures(x)} N/m` : 'no limit';
        bar.append(label, fill, value);
        return bar;
      })
    );
    $('because').textContent =
      text(e, e.ph_because(s)) +
      (deformable || K <= b[0]
        ? ''
        : ' This surface is stiffer: who spends no more than the ledger holds sinks in when it runs dry.');
  }

  // ----------------------------------------------------------------------------------------- sound, rumble
  let audio = null,
    volume = null,
    playedTo = 0;
  function chooseSound(which) {
    if (which === '') {
      audio?.suspend();
      return;
    }
    const Context = window.AudioContext || window.webkitAudioContext;
    if (!Context) {
      notice('This browser has no WebAudio, so the force cannot be heard; everything else works.');
      $('sound').value = '';
      return;
    }
    try {
      if (!audio) {
        audio = new Context();
        volume = audio.createGain();
        volume.gain.value = 0.15; // and never louder: the limiter is behind it
        const high = audio.createBiquadFilter(),
          limiter = audio.createDynamicsCompressor();
        high.type = 'highpass';
        high.frequency.value = 25;
        limiter.threshold.value = -18;
        limiter.ratio.value = 20;
        volume.connect(high).connect(limiter).connect(audio.destination);
      }
      audio.resume();
      playedTo = 0;
    } catch (problem) {
      notice(`The sound cannot be switched on: ${problem.message}`);
      $('sound').value = '';
    }
  }
  function play(n) {
    const which = $('sound').value;
    if (!audio || which === '' || n < 2 || speed !== 1) return;
    const heard = which === '2' ? sides : [Number(which)],
      kept = e.ph_rows_kept(),
      rowWidth = e.ph_row_width(),
      times = 8;
    if (e.ph_count(s, heard[0]) < n + 2) return;
    const buffer = audio.createBuffer(heard.length, n * times, 8000);
    heard.forEach((w, channel) => {
      const count = e.ph_count(s, w),
        rows = numbers(e, e.ph_rows(s, w), kept * rowWidth),
        wave = buffer.getChannelData(channel);
      // Across and along: what is normal to the surface, and what rubs.
      const force = i => rows[(i % kept) * rowWidth + 6] + rows[(i % kept) * rowWidth + 5];
      for (let i = 0; i < n; ++i) {
        const from = force(count - n + i - 1),
          to = force(count - n + i);
        for (let k = 0; k < times; ++k)
          wave[i * times + k] = Math.max(-1, Math.min(1, 0.2 * (from + ((to - from) * k) / times)));
      }
    });
    const source = audio.createBufferSource();
    source.buffer = buffer;
    source.connect(volume);
    playedTo = Math.max(playedTo, audio.currentTime + 0.04);
    source.start(playedTo);
    playedTo += n * 1e-3;
  }
  let nextRumble = 0;
  function rumble(now) {
    const which = $('rumble').value;
    if (which === '' || now < nextRumble || !verdicts[Number(which)]) return;
    nextRumble = now + 80;
    const pad = [...(navigator.getGamepads?.() ?? [])].find(p => p?.vibrationActuator);
    const strength = Math.min(1, verdicts[Number(which)].swing / 6);
    if (!pad && strength > 0.05) navigator.vibrate?.(Math.round(60 * strength));
    pad?.vibrationActuator
      .playEffect('dual-rumble', {duration: 100, strongMagnitude: strength, weakMagnitude: strength})
      .catch(() => {});
  }

  // ------------------------------------------------------------------------------------------- the clock
  function frame(now) {
    requestAnimationFrame(frame);
    if (!e) return;
    const began = performance.now();
    if (lastTime !== null) {
      const passed = now - lastTime;
      if (passed > 2000)
        notice(
          `The page was out of sight for ${
            passed < 1e5 ? `${figures(passed / 1000)} s` : `${figures(passed / 6e4)} minutes`
          }; its clock stood still, and nothing has changed.`
        );
      const wanted = Math.min(passed, 100) * speed;
      owed += wanted;
      let ran = 0;
      while (owed >= 1 && performance.now() - began < 5) {
        const n = Math.min(8, Math.floor(owed));
        e.ph_run(s, n);
        owed -= n;
        ran += n;
      }
      if (owed >= 1) {
        // this frame has no more time: what is owed is dropped, and said
        lag += 0.1 * (ran / Math.max(1, wanted) - lag);
        owed = 0;
      } else {
        lag += 0.1 * (1 - lag);
      }
      play(ran);
    }
    lastTime = now;
    draw(now);
    rumble(now);
    frameCost += 0.05 * (performance.now() - began - frameCost);
  }

  // ----------------------------------------------------------------------------------------------- footer
  async function copy(words, button) {
    const label = (button.dataset.label ??= button.textContent);
    try {
      await navigator.clipboard.writeText(words);
      button.textContent = 'Copied';
    } catch {
      notice(`This browser does not let a page copy. Here it is: ${words.slice(0, 400)}`, 60);
    }
    setTimeout(() => {
      button.textContent = label;
    }, 1500);
  }
  function save() {
    const columns = [
      'x m',
      'y m',
      'hand x m',
      'hand y m',
      'force x N',
      'force y N',
      'port energy J',
      'ledger J',
      'behind m',
    ];
    const heading = ['time s', ...sides.flatMap(w => columns.map(c => `${w ? 'right' : 'left'} ${c}`))].join(
      ','
    );
    const kept = e.ph_rows_kept(),
      rowWidth = e.ph_row_width(),
      count = e.ph_count(s, 0),
      n = Math.min(count, kept);
    const rows = sides.map(w => numbers(e, e.ph_rows(s, w), kept * rowWidth)),
      lines = [heading];
    for (let i = count - n; i < count; ++i) {
      const at = (i % kept) * rowWidth;
      lines.push(
        [rows[0][at], ...sides.flatMap(w => [...rows[w].slice(at + 1, at + 1 + columns.length)])].join(',')
      );
    }
    const a = document.createElement('a');
    a.href = URL.createObjectURL(new Blob([lines.join('\n') + '\n'], {type: 'text/csv'}));
    a.download = `passive_haptics_${state.scene}.csv`;
    a.click();
    setTimeout(() => URL.revokeObjectURL(a.href), 10000);
  }
  function showCode() {
    all('#codes pre').forEach((pre, w) => {
      pre.textContent = program(state.scene, state.menu[state.chosen[w]].code, state.set);
    });
  }
  /** Every scene of every module that is here, each controller from the start, against the native run. */
  async function compareBits() {
    const said = $('bitsSaid');
    let ticks = 0,
      equal = 0,
      tried = 0;
    for (const name of Object.keys(packed)) {
      const m = await instance(name); // one of its own: what the reader plays with is left alone
      for (const [stage, native] of packed[name].native.entries()) {
        for (const [i, print] of native.prints.entries()) {
          const half = numbers(m, m.ph_fingerprint(stage, i, native.ticks), 2);
          const here = [...half].map(h => h.toString(16).padStart(8, '0')).join('');
          ++tried;
          ticks += native.ticks;
          equal += here === print;
          if (i % 4 === 0) {
            said.textContent = `Comparing: ${ticks} ticks so far, ${equal} of ${tried} runs equal.`;
            await new Promise(done => setTimeout(done));
          }
        }
      }
    }
    const compiler = packed[Object.keys(packed)[0]].compiler;
    said.textContent =
      equal === tried
        ? `The same bits: ${tried} runs, ${ticks} ticks in all, each position, force and energy as ${compiler} computes them natively.`
        : `Not the same bits: ${tried - equal} of ${tried} runs differ from ${compiler}. The physics holds, the digits do not.`;
    document.documentElement.dataset.bits = `${equal}/${tried}/${ticks}`;
  }

  // ----------------------------------------------------------------------------------------------- begin
  async function begin() {
    if (typeof WebAssembly !== 'object' || typeof WebAssembly.instantiate !== 'function') {
      return fatal(
        'This browser has no WebAssembly, or forbids it, and the physics of this page is compiled to it. ' +
          'Any browser since 2017 has it; the README says how to run the same scenes in a terminal.'
      );
    }
    if (typeof DecompressionStream !== 'function') {
      return fatal(
        'This browser is older than 2023 and cannot unpack the physics of this page. ' +
          'A newer one can; the README says how to run the same scenes in a terminal.'
      );
    }
    readColours();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', readColours);
    const wanted = readLink(location.hash);
    if (!packed[scenes[wanted.scene].module]) wanted.scene = 'wall';
    for (const [key, about] of Object.entries(scenes)) {
      if (!packed[about.module]) continue;
      const b = button(about.title, () => {
        const first = Object.values(problems).find(p => p.scene === key);
        state.step = null;
        show(key, first?.left, first?.right, {})
          .then(() => tell(null, about.says))
          .catch(refused);
      });
      b.dataset.key = key;
      $('scenes').append(b);
    }
    for (const [step, [name, p]] of Object.entries(problems).entries()) {
      if (!packed[scenes[p.scene].module]) continue;
      const b = button(`${step + 1} ${name}`, () => go(step).catch(refused));
      b.dataset.key = name;
      $('problems').append(b);
    }
    all('.view').forEach(listenTo);
    const has = step => titles[step] && packed[scenes[problems[titles[step]].scene].module];
    const beside = (from, by) => {
      let step = (from ?? -by) + by;
      while (titles[step] && !has(step)) step += by;
      if (titles[step]) go(step).catch(refused);
    };
    $('back').onclick = () => beside(state.step, -1);
    $('next').onclick = () => beside(state.step, 1);
    $('counted').onclick = () => count($('counted').getAttribute('aria-checked') !== 'true');
    $('lab').onclick = () => openLab($('lab').getAttribute('aria-expanded') !== 'true');
    $('listen').onclick = () => {
      $('sound').value = $('sound').value === '' ? '2' : '';
      $('sound').onchange();
    };
    $('again').onclick = restart;
    $('itself').onclick = () => byItself($('itself').getAttribute('aria-pressed') !== 'true');
    $('speed').onchange = () => {
      speed = Number($('speed').value);
      owed = 0;
    };
    $('link').onclick = () => copy(location.href, $('link'));
    $('csv').onclick = save;
    $('code').onclick = () => {
      $('codes').hidden = !$('codes').hidden;
      $('code').setAttribute('aria-expanded', String(!$('codes').hidden));
      if (!$('codes').hidden) showCode();
    };
    all('#codes button').forEach((b, w) => {
      b.onclick = () => copy(all('#codes pre')[w].textContent, b);
    });
    $('sound').onchange = () => {
      chooseSound($('sound').value);
      $('listen').setAttribute('aria-pressed', String($('sound').value !== ''));
    };
    $('rumble').onchange = () => {
      if (
        $('rumble').value !== '' &&
        !navigator.vibrate &&
        ![...(navigator.getGamepads?.() ?? [])].some(p => p?.vibrationActuator)
      ) {
        notice('No gamepad that can rumble has been seen. Press one of its buttons, and it will be used.');
      }
    };
    $('bits').onclick = () => compareBits().catch(refused);
    window.addEventListener('hashchange', () => open(readLink(location.hash)));
    await open(wanted);
    const plain = all('canvas')[0].getContext('2d');
    if (!plain)
      notice('This browser has no canvas, so there are no pictures; the words beside them are right.', 1e6);
    window.page = {verdict: w => judge(w), cost: () => frameCost, ticks: () => e.ph_count(s, 0), compareBits};
    document.documentElement.dataset.state = 'ready';
    requestAnimationFrame(frame);
  }
  async function open(wanted) {
    const first = titles.findIndex(k => problems[k].scene === wanted.scene);
    const bare = wanted.left === null && wanted.right === null && Object.keys(wanted.set).length === 0;
    const step = wanted.step ?? (bare && first >= 0 ? first : null);
    if (step !== null && (bare || problems[titles[step]].scene === wanted.scene)) {
      await go(step, bare ? null : wanted.set, wanted.left, wanted.right);
    } else {
      state.step = null;
      await show(wanted.scene, wanted.left ?? problems[titles[first]]?.left, wanted.right ?? problems[titles[first]]?.right, wanted.set);
      tell(null, scenes[wanted.scene].says);
    }
    fillDevices();
    openLab(state.step === null);
    if (wanted.said.length) notice(wanted.said.join(' '), 30);
  }
  function refused(problem) {
    fatal(
      `The page cannot go on: ${problem && problem.message ? problem.message : problem}. Loading it again may help.`
    );
  }
  begin().catch(refused);
})();
