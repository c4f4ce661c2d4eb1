// Validates a VRM with Khronos' glTF-Validator, and draws it with three-vrm in headless Chromium, with camera and light
// stated beside each picture in the form that `hikage compare-references` reads.
//
// node check.mjs MODEL.vrm OUTDIR CHROMIUM

import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { chromium } from 'playwright-core';
import validator from 'gltf-validator';

const [model, out, browserPath] = process.argv.slice(2);
const here = import.meta.dirname;
const bytes = fs.readFileSync(model);

const report = await validator.validateBytes(new Uint8Array(bytes), { uri: path.basename(model), maxIssues: 0 });
const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
console.log(`glTF-Validator ${validator.version()}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos, ${numHints} hints`);
const counts = new Map();
for (const m of messages) {
  const key = `${['error', 'warning', 'info', 'hint'][m.severity]} ${m.code}`;
  counts.set(key, [(counts.get(key)?.[0] ?? 0) + 1, counts.get(key)?.[1] ?? m]);
}
for (const [key, [n, m]] of counts) console.log(`  ${n} x ${key}, first at ${m.pointer ?? '-'}: ${m.message}`);

// Views: name, what the camera looks at (height, visible height), turn of the camera.
const VIEWS = [
  ['front', 1.385, 0.5, 0],
  ['three-quarter', 1.385, 0.5, 35],
  ['profile', 1.385, 0.5, 90],
  ['back', 1.385, 0.5, 180],
  ['full', 0.78, 1.7, 0],
  ['full-three-quarter', 0.78, 1.7, 35],
];
const SIZE = 1024;
const FOV = 20;
const shots = VIEWS.map(([name, height, visible, yaw]) => {
  const distance = visible / 2 / Math.tan((FOV / 2) * Math.PI / 180);
  const a = (yaw * Math.PI) / 180;
  return {
    model: path.basename(model),
    view: name,
    width: SIZE,
    height: SIZE,
    camera: {
      eye: [distance * Math.sin(a), height, distance * Math.cos(a)],
      target: [0, height, 0],
      up: [0, 1, 0],
      fovYDeg: FOV,
      near: 0.1,
      far: 50,
    },
    light: { dirToLight: [0.34954588, 0.54928639, 0.75901392], colorLinear: [1, 1, 1], unitIntensity: 1 },
    ambient: { colorLinear: [1, 1, 1], unitIntensity: 0.1 },
    background: '#808080',
    expressions: null,
  };
});

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript' };
const server = http.createServer((request, response) => {
  const name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  const file = name === '/model' ? model : path.join(here, path.normalize(name));
  fs.readFile(file, (error, data) => {
    response.writeHead(error ? 404 : 200, { 'content-type': TYPES[path.extname(file)] ?? 'application/octet-stream' });
    response.end(data);
  });
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));

const browser = await chromium.launch({
  executablePath: browserPath,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking',
    '--disable-component-update', '--disable-sync', '--no-first-run'],
});
let failed = numErrors > 0;
try {
  const page = await browser.newPage();
  page.on('console', (m) => ['error', 'warning'].includes(m.type()) && console.log(`  page: ${m.text()}`));
  page.on('pageerror', (e) => { failed = true; console.log(`  page: ${e.message}`); });
  await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
  const info = await page.evaluate(() => window.loaded);
  console.log(`three-vrm: ${info.name}, VRM ${info.version}, ${info.bones} bones, ${info.expressions} expressions, ` +
    `${info.springs} spring joints, ${info.materials} materials`);
  fs.mkdirSync(out, { recursive: true });
  for (const shot of shots) {
    const url = await page.evaluate((s) => window.draw(s), shot);
    const stem = path.join(out, `${path.basename(model, '.vrm')}.${shot.view}`);
    fs.writeFileSync(`${stem}.png`, Buffer.from(url.split(',')[1], 'base64'));
    fs.writeFileSync(`${stem}.json`, JSON.stringify(shot, null, 1));
  }
} finally {
  await browser.close();
  server.close();
}
process.exit(failed ? 1 : 0);
