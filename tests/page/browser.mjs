// SPDX-License-Identifier: BSD-3-Clause
// The page in a real browser: mouse, touch, keys, links, sizes, schemes, sound; not one request, not one error, and
// nothing that axe-core finds against WCAG.
//     node browser.mjs NODE_MODULES_FOLDER CHROMIUM index.html SCREENSHOTS
import fs from 'node:fs';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';
import {expect, failures} from './page_of.mjs';

const [, , modules, executablePath, html, screenshots] = process.argv;
const require = createRequire(`${modules}/`);
const {chromium} = require('playwright-core'),
  axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
let browser;
try {
  browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--disable-gpu']});
} catch (problem) {
  console.log(`page: skipped, the browser does not start: ${problem.message.split('\n')[0]}`);
  process.exit(0);
}
fs.mkdirSync(screenshots, {recursive: true});
// What a busy machine keeps waiting for ever ends here, with its name.
let doing = 'the start';
setTimeout(() => {
  console.log(`FAILED: no answer for too long, in what follows ${doing}`);
  process.exit(1);
}, 400e3).unref();
const url = pathToFileURL(html).href;

/** A page that is watched: errors and requests besides the file itself. */
async function open(hash = '', options = {}, script = null) {
  const context = await browser.newContext({viewport: {width: 1280, height: 860}, ...options});
  context.setDefaultTimeout(30e3);
  const page = await context.newPage();
  page.wrong = [];
  page.on('pageerror', e => page.wrong.push(String(e)));
  page.on('console', m => m.type() === 'error' && page.wrong.push(m.text()));
  page.on('request', r => {
    if (
      !/^(file|data|blob):/.test(r.url()) ||
      (r.url().startsWith('file:') && r.url().split('#')[0] !== url)
    ) {
      page.wrong.push(`request: ${r.url()}`);
    }
  });
  if (script) await page.addInitScript(script);
  await page.goto(url + hash);
  await page.waitForSelector('html[data-state]', {timeout: 30000});
  return page;
}
async function close(page, what) {
  expect(page.wrong.length === 0, `${what}: ${page.wrong.join('; ')}`);
  doing = what;
  // A browser that is slow to let go of a page is no fault of the page's.
  const slow = new Promise(gone => setTimeout(gone, 10e3, 'slow').unref());
  if ((await Promise.race([page.context().close(), slow])) === 'slow') {
    console.log(`${what}: the browser did not close the page within 10 s`);
  }
}
/** Opens the lab, in which every scene, controller and slider is. */
async function lab(page) {
  await page.locator('#lab').click();
  return page;
}
/** What axe-core has against the page as it stands: a rule and where it is broken, each. */
async function violations(page) {
  await page.evaluate(axe);
  return page.evaluate(async () =>
    (await window.axe.run()).violations.map(v => `${v.id} at ${v.nodes.map(n => n.target.join(' ')).join(', ')}`)
  );
}
const verdicts = page => page.evaluate(() => [window.page.verdict(0), window.page.verdict(1)]);
const notice = page => page.locator('#notice').textContent();

// The mouse, into the wall: the left makes energy, the right does not; and the words say so.
{
  const page = await lab(await open());
  await page.locator('#again').click();
  const box = await page.locator('.view').first().boundingBox();
  const at = mm => [box.x + box.width / 2, box.y + box.height / 2 - ((mm + 4) / 46) * box.height];
  // Who only passes by takes nothing away from the demonstration.
  await page.mouse.move(...at(12));
  await page.mouse.move(...at(-12));
  expect((await page.locator('#itself').getAttribute('aria-pressed')) === 'true', 'hovering takes no hand over');
  await page.mouse.move(...at(12));
  await page.mouse.down();
  await page.waitForTimeout(300);
  for (let i = 0; i <= 30; ++i) await page.mouse.move(...at(12 - (28 * i) / 30));
  await page.waitForTimeout(2500);
  const [left, right] = await verdicts(page);
  expect(left.made > 10e-3, `left made ${left.made} J, more than 10 mJ is what it does`);
  expect(right.made <= 1e-9, `right made ${right.made} J`);
  expect(right.touching === 1, 'the right one was touched');
  const words = await page.locator('.remarks').allTextContents();
  expect(/made .* out of nothing/.test(words[0]) && /buzzes at/.test(words[0]), `left: ${words[0]}`);
  expect(/made no energy/.test(words[1]), `right: ${words[1]}`);
  // The judge of quiet, in figures and in words: the left buzzes, the right rests, shown as stiff as it can be.
  expect(
    left.quiet === 0 && left.step > 0.2 && /not quiet for .* N rms above 10 Hz, .* mm\/s, .* N a tick/.test(words[0]),
    `the left is not quiet: ${left.step} N a tick, ${words[0]}`
  );
  expect(
    right.quiet === 1 && right.since < 1 && right.step <= 0.02 && /quiet after .* N a tick/.test(words[1]),
    `the right is quiet: ${right.step} N a tick, ${words[1]}`
  );
  expect(!/not quiet/.test(words[1]) && /shows \d+ of 10000 N\/m/.test(words[1]), `and shows: ${words[1]}`);
  console.log(
    `left: ${words[0]} | right: ${words[1]} | ${(await page.evaluate(() => window.page.cost())).toFixed(1)} ms a frame`
  );

  const cost = await page.evaluate(() => window.page.cost());
  expect(cost <= 8, `${cost} ms of script a frame, 8 at most`);
  await page.locator('#code').click();
  expect(
    /int main[^]*ph::make_touch<scene>\(device,\s+hand\)/.test(
      await page.locator('#codes pre').nth(1).textContent()
    ),
    'the C++ is shown'
  );
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#csv').click()]);
  const csv = fs.readFileSync(await download.path(), 'utf8').split('\n');
  expect(
    csv[0].startsWith('time s,left x m') &&
      csv.length > 1000 &&
      csv[5].split(',').length === csv[0].split(',').length,
    `the trace: ${csv.length} lines, ${csv[0]}`
  );
  await page.locator('#sound').selectOption('0');
  await page.waitForTimeout(300);

  await page.locator('#field_stiffness').fill('NaN');
  await page.locator('#field_stiffness').press('Enter');
  expect(/“NaN” is no number/.test(await notice(page)), `NaN in a field: ${await notice(page)}`);
  expect((await page.locator('#field_stiffness').inputValue()) === '10000', 'the stiffness stayed');
  await page.locator('#field_stiffness').fill('1500');
  await page.locator('#field_stiffness').press('Enter');
  const kept = await page.evaluate(() => location.hash);
  expect(kept.includes('stiffness=1500'), `the link holds the settings: ${kept}`);
  await close(page, 'the wall');
  const again = await open(kept);
  expect((await again.locator('#field_stiffness').inputValue()) === '1500', 'and brings them back');
  await close(again, 'the link');
}

// Every problem and every scene, for a second each; and the bits.
{
  const page = await lab(await open());
  for (const group of ['#problems', '#scenes']) {
    for (const b of await page.locator(`${group} button`).all()) {
      await b.click();
      await page.waitForTimeout(600);
      expect((await b.getAttribute('aria-pressed')) === 'true', `${await b.textContent()} is shown`);
      expect((await page.evaluate(() => window.page.ticks())) > 100, `${await b.textContent()} runs`);
      await page.screenshot({
        path: `${screenshots}/${group.slice(1)}_${(await b.textContent()).replaceAll(' ', '_')}.png`,
      });
    }
  }
  await page.evaluate(() => window.page.compareBits());
  const [equal, tried, ticks] = (await page.evaluate(() => document.documentElement.dataset.bits))
    .split('/')
    .map(Number);
  expect(equal === tried && ticks > 190000, `the bits: ${equal} of ${tried}, ${ticks} ticks`);
  console.log(await page.locator('#bitsSaid').textContent());
  await close(page, 'problems and scenes');
}

// The article: thirteen steps by its buttons, a slider and a press on the picture in each: by a finger, a mouse and keys,
// light and dark. Screenshots of the first step.
const ways = {
  async finger(page, [x, y]) {
    await page.touchscreen.tap(x, y);
  },
  async mouse(page, [x, y]) {
    await page.mouse.move(x, y - 60);
    await page.mouse.down();
    await page.mouse.move(x, y, {steps: 6});
  },
  async keys(page, at, view, way) {
    await view.focus();
    for (const [key, times] of way) for (let i = 0; i < times; ++i) await page.keyboard.press(`Shift+${key}`);
  },
};
for (const [width, height, press] of [
  [360, 740, 'finger'],
  [1024, 768, 'mouse'],
  [1920, 1080, 'keys'],
]) {
  for (const colorScheme of ['light', 'dark']) {
    const page = await open('', {viewport: {width, height}, colorScheme, hasTouch: press === 'finger'});
    const there = `at ${width} px, ${colorScheme}`;
    const shown = () => page.locator('#heading').textContent();
    const lead = page.locator('#lead');
    expect(/haptic/.test(await lead.textContent()), 'the first screen says what it is');
    const first = await page.locator('.side.left .view').boundingBox(),
      link = await lead.locator('a').boundingBox();
    expect(first.y + first.height <= height, `${there} the whole picture is on the first screen: ${JSON.stringify(first)}`);
    expect(link.y + link.height <= first.y, `${there} name, sentence and link are above it`);
    expect(!(await page.locator('.side.right .view').isVisible()), 'one picture first');
    expect((await page.locator('#counted').boundingBox()).y <= height, `${there} and the switch below it`);
    await page.waitForTimeout(1600);
    await page.screenshot({path: `${screenshots}/wall_${width}_${colorScheme}.png`});
    await page.screenshot({path: `${screenshots}/whole_${width}_${colorScheme}.png`, fullPage: true});
    await page.locator('#counted').click();
    expect(await page.locator('.side.right .view').isVisible(), 'the switch shows the other side');
    expect((await page.locator('#counted').getAttribute('aria-checked')) === 'true', 'and says so');
    expect(!(await page.locator('#knobs').isVisible()), 'the sliders are behind the lab');
    const seen = [];
    for (let step = 1; step <= 13; ++step) {
      const heading = await shown(),
        here = `${there}, ${heading}`;
      seen.push(heading);
      expect(heading.startsWith(`${step}. `), `step ${step}: ${heading}`);
      expect((await page.locator('#slider input[type=range]').count()) === 1, `${here}: one slider`);
      await page.locator('#slider input[type=range]').press('ArrowRight');
      // Where the hand goes to in the program to paste, into what is touched; the organ is lower than the ball of that.
      const view = page.locator(`.side.${step === 1 ? 'right' : 'left'} .view`);
      await view.scrollIntoViewIfNeeded();
      const box = await view.boundingBox();
      const [[cx, cy, span], from, to] = await page.evaluate(step => {
        const scene = scenes[problems[Object.keys(problems)[step - 1]].scene];
        const inPicture = text => {
          const all = text.match(/-?[\d.]+/g).map(Number);
          return all.length === 1 ? [0, all[0]] : [all[0], all.at(-1)];
        };
        const to = inPicture(scene.press);
        return [scene.view, inPicture(scene.start), [to[0], Math.min(to[1], scene.view[1])]];
      }, step);
      const at = [
        box.x + box.width / 2 + ((to[0] - cx) * box.height) / span,
        box.y + box.height / 2 - ((to[1] - cy) * box.height) / span,
      ];
      const far = i => Math.ceil(Math.abs(to[i] - from[i]) / 5e-3);
      await ways[press](page, at, view, [
        [to[0] < from[0] ? 'ArrowLeft' : 'ArrowRight', far(0)],
        ['ArrowDown', far(1)],
      ]);
      await page
        .waitForFunction(() => window.page.ticks() > 300 && window.page.verdict(1).touching === 1, null, {timeout: 8e3})
        .catch(() => expect(false, `${here}: who presses by ${press} touches`));
      if (press === 'mouse') await page.mouse.up();
      expect((await page.locator('#itself').getAttribute('aria-pressed')) === 'false', `${here}: and is the hand`);
      expect((await page.locator('.side.right .remarks').textContent()).length > 10, `${here}: it is put into words`);
      expect(
        (await page.evaluate(() => document.documentElement.scrollWidth)) <= width,
        `${here}: nothing is wider than the page`
      );
      const chip = await page.locator('#problems button[aria-pressed=true]').boundingBox();
      expect(chip.x >= 0 && chip.x + chip.width <= width + 1, `${here}: its name is in sight`);
      if ([1, 13].includes(step)) {
        const bad = await violations(page);
        expect(bad.length === 0, `${here}: axe: ${bad.join('; ')}`);
      }
      if (step < 13) await page.locator('#next').click();
      if (step < 13) await page.waitForFunction(n => document.getElementById('heading').textContent.startsWith(`${n}. `), step + 1);
    }
    expect(new Set(seen).size === 13, 'thirteen steps that differ');
    expect(await page.locator('#next').isDisabled(), 'the thirteenth is the last');
    await lab(page);
    const bad = await violations(page);
    expect(bad.length === 0, `the lab ${there}: axe: ${bad.join('; ')}`);
    if (press === 'keys' && colorScheme === 'dark') {
      await page.evaluate(() => document.querySelector('label[for=field_mass]').remove());
      expect((await violations(page)).some(v => v.startsWith('label')), 'the control: axe misses a label');
    }
    await close(page, `the article ${there}`);
  }
}

// The last two steps, and links to them.
{
  const page = await open('#v=2&step=13');
  await page.locator('#devices').selectOption({label: '3D Systems Touch'});
  expect(/Nobody has published/.test(await notice(page)), `what is not known: ${await notice(page)}`);
  expect((await page.locator('#step_mass').inputValue()) === '0.045', 'its mass is taken');
  for (const [text, sentence] of [
    ['{', /no JSON/],
    ['{"mass": 1}', /passive_haptics_device/],
    ['{"passive_haptics_device": 1, "mass": "x"}', /"mass" is no number/],
    ['{"passive_haptics_device": 1, "mass": 9}', /is shown as 0.5/],
  ]) {
    await page.locator('#identified').fill(text);
    await page.locator('#take').click();
    expect(sentence.test(await notice(page)), `${text}: ${await notice(page)}`);
  }
  await page.locator('#back').click();
  await page.waitForFunction(() => document.getElementById('heading').textContent.startsWith('12.'));
  expect(
    /✗ strict: you told 0 ticks late, it is 2/.test(await page.locator('.side.left .promise').textContent()),
    `a promise without its assumption: ${await page.locator('.side.left .promise').textContent()}`
  );
  expect(!/✗/.test(await page.locator('.side.right .promise').textContent()), 'and one that has it');
  const hash = await page.evaluate(() => location.hash);
  await close(page, 'the article');
  const again = await open(hash);
  expect((await again.locator('#heading').textContent()).startsWith('12. '), `the link brings the step back: ${hash}`);
  expect((await again.locator('#step_late').inputValue()) === '2', 'and its slider');
  await close(again, 'a link to a step');
}

// Keys alone; touch; resizing; a hash from another version; a page that was out of sight.
{
  const page = await open();
  await page.locator('.view').first().focus();
  for (let i = 0; i < 26; ++i) await page.keyboard.press('ArrowDown');
  await page.waitForTimeout(1200);
  const [, right] = await verdicts(page);
  expect(right.touching === 1 && right.made <= 1e-9, 'the keys press on the wall');
  expect((await page.locator('#itself').getAttribute('aria-pressed')) === 'false', 'and take the hand over');
  for (const width of [200, 360, 1024, 1920, 5120]) {
    await page.setViewportSize({width, height: width > 2000 ? 2160 : 800});
    await page.waitForTimeout(200);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    expect(wide <= width, `at ${width} px the page is ${wide} px wide`);
    expect(
      (await page
        .locator('.view')
        .first()
        .evaluate(v => v.clientWidth)) > 60,
      `there is a picture at ${width} px`
    );
    const share = await page.evaluate(() => document.querySelector('main').clientWidth / innerWidth);
    expect(share > 0.6, `at ${width} px the pictures take ${share} of the width`);
  }
  await close(page, 'keys and sizes');

  const touched = await open('', {hasTouch: true, viewport: {width: 360, height: 740}});
  await touched.locator('#counted').click();
  const box = await touched.locator('.view').nth(1).boundingBox();
  await touched.touchscreen.tap(box.x + box.width / 2, box.y + 0.9 * box.height);
  await touched.waitForTimeout(900);
  expect((await verdicts(touched))[1].touching === 1, 'a finger presses on the wall');
  await close(touched, 'touch');

  const other = await open('#v=99&scene=wall&left=none&right=quantum+leap&stiffness=NaN&colour=red');
  expect(
    /no controller|another version/.test(await notice(other)),
    `another version: ${await notice(other)}`
  );
  expect((await other.locator('html').getAttribute('data-state')) === 'ready', 'it runs all the same');
  await close(other, 'a hash of another version');

  const away = await open(
    '',
    {},
    `{ const real = window.requestAnimationFrame.bind(window); let shift = 0;
    window.leap = ms => { shift += ms; }; window.requestAnimationFrame = f => real(t => f(t + shift)); }`
  );
  await away.waitForTimeout(500);
  const before = await away.evaluate(() => window.page.ticks());
  await away.evaluate(() => window.leap(3600e3));
  await away.waitForTimeout(500);
  const gone = (await away.evaluate(() => window.page.ticks())) - before;
  expect(gone < 2500, `an hour out of sight is no hour of physics: ${gone} ticks`);
  expect(/out of sight for 60 minutes/.test(await notice(away)), `and is said: ${await notice(away)}`);
  await close(away, 'out of sight');
}

// What a browser may lack: a sentence each, never a blank page.
for (const [what, script, sentence] of [
  ['no WebAssembly', 'delete window.WebAssembly', /no WebAssembly/],
  ['no DecompressionStream', 'delete window.DecompressionStream', /older than 2023/],
  ['no canvas', 'HTMLCanvasElement.prototype.getContext = () => null', /no canvas/],
]) {
  const page = await open('', {}, script);
  expect(sentence.test(await notice(page)), `${what}: “${await notice(page)}”`);
  await close(page, what);
}
{
  const page = await open('', {}, 'delete window.AudioContext; delete window.webkitAudioContext');
  await page.locator('#listen').click();
  expect(/no WebAudio/.test(await notice(page)), `no audio: “${await notice(page)}”`);
  await close(page, 'no audio');
  const still = await open('', {reducedMotion: 'reduce'});
  await still.waitForTimeout(600);
  expect(
    (await still.locator('#itself').getAttribute('aria-pressed')) === 'false',
    'reduced motion: the hand waits'
  );
  await close(still, 'reduced motion');
  // The colours of a reader's own scheme: what is written on a card keeps the card's, so that it can be read.
  for (const colorScheme of ['light', 'dark']) {
    const forced = await open('#v=2&step=2', {forcedColors: 'active', colorScheme});
    await lab(forced);
    const bad = await violations(forced);
    expect(bad.length === 0, `forced colours, ${colorScheme}: ${bad.join('; ')}`);
    const same = await forced.evaluate(() => {
      const own = e => getComputedStyle(document.querySelector(e));
      return own('body').color === own('#lead').color && own('.side').backgroundColor !== own('.side').color;
    });
    expect(same, `forced colours, ${colorScheme}: the text has the reader's, a card its own`);
    await close(forced, `forced colours, ${colorScheme}`);
  }
  const context = await browser.newContext({javaScriptEnabled: false});
  const plain = await context.newPage();
  await plain.goto(url);
  expect(/needs JavaScript/.test(await plain.locator('body').innerText()), 'no JavaScript: a sentence');
  await context.close();
}

// Sound and rumble are off until they are asked for; the volume is capped; a pad that is there rumbles.
{
  const page = await open(
    '',
    {},
    `window.contexts = 0; window.gains = []; window.rumbles = [];
    window.AudioContext = class extends AudioContext {
      constructor() { super(); ++window.contexts; }
      createGain() { const g = super.createGain(); window.gains.push(g); return g; }
    };
    navigator.getGamepads = () => [null, {vibrationActuator: {playEffect: async (kind, what) => window.rumbles.push(what)}}];`
  );
  await page.waitForTimeout(1500);
  expect(
    (await page.evaluate(() => window.contexts + window.rumbles.length)) === 0,
    'neither sound nor rumble by itself'
  );
  const pressed = () => page.locator('#listen').getAttribute('aria-pressed');
  await page.locator('#listen').click();
  expect((await pressed()) === 'true' && (await page.locator('#sound').inputValue()) === '2', 'Listen is one in each ear');
  await lab(page);
  await page.locator('#sound').selectOption('');
  expect((await pressed()) === 'false', 'what the menu switches off is no longer pressed');
  await page.locator('#sound').selectOption('0');
  expect((await pressed()) === 'true', 'and what it switches on is');
  await page.locator('#rumble').selectOption('0');
  await page.waitForTimeout(2500);
  expect(
    await page.evaluate(() => window.contexts === 1 && window.gains.every(g => g.gain.value <= 0.2)),
    'one quiet sound'
  );
  const strong = await page.evaluate(() => Math.max(...window.rumbles.map(r => r.strongMagnitude)));
  expect(strong > 0.3 && strong <= 1, `the pad rumbles: ${strong}`);
  await close(page, 'sound and rumble');
}

// What is heard in each step: one side in each ear, above 25 Hz as the page filters it, over a round of the hand. Steps
// that say that the left is louder are 10 dB apart at least; a step where it is not is the control.
{
  const page = await open(
    '',
    {},
    `window.heard = [[], []];
    window.AudioContext = class extends AudioContext {
      createBufferSource() {
        const source = super.createBufferSource(), start = source.start.bind(source);
        source.start = when => {
          for (const w of [0, 1]) window.heard[w].push(...source.buffer.getChannelData(w));
          start(when);
        };
        return source;
      }
    };`
  );
  await page.locator('#listen').click();
  const said = [];
  let claimed = 0,
    control = false;
  for (let step = 1; step <= 13; ++step) {
    const claims = /Listen:/.test(await page.locator('#says').textContent()),
      heading = await page.locator('#heading').textContent();
    await page.evaluate(() => (window.heard = [[], []]));
    await page.waitForTimeout(5000);
    const [left, right] = await page.evaluate(() =>
      window.heard.map(samples => {
        const pass = 1 / (1 + (2 * Math.PI * 25) / 8000);
        let y = 0,
          sum = 0;
        samples.forEach((x, i) => {
          y = pass * (y + x - (samples[i - 1] ?? x));
          sum += y * y;
        });
        return samples.length > 8000 ? 10 * Math.log10(sum / samples.length) : NaN;
      })
    );
    said.push(`${step}${claims ? '' : ' (claims nothing)'}: ${(left - right).toFixed(1)}`);
    if (claims) expect(left - right >= 10, `${heading}: the left is ${left.toFixed(1)} dB, the right ${right.toFixed(1)} dB`);
    claimed += claims;
    control ||= !claims && left - right < 10;
    if (step < 13) await page.locator('#next').click();
    await page.waitForTimeout(300);
  }
  expect(claimed === 5 && control, `five steps are heard, and one at least that claims nothing is not: ${said}`);
  console.log(`left over right, dB: ${said.join(', ')}`);
  await close(page, 'what is heard');
}

await Promise.race([browser.close(), new Promise(gone => setTimeout(gone, 10e3))]);
console.log(failures() ? `${failures()} failed` : 'all is well');
process.exit(failures() ? 1 : 0);
