// SPDX-License-Identifier: Apache-2.0
// The same field through hogel and through plain sums, in another language and without a transform: to another plane by
// Rayleigh's and Sommerfeld's first integral, and photographed through a lens by the sum over every sample, point of the pupil
// and point of the film (docs/notation.md, section 4). Written for this comparison, of the published equations alone.
//
// usage: node camera_against_sums.mjs HOGEL
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

const hogelProgram = resolve(process.argv[2]);
const folder = mkdtempSync(join(tmpdir(), 'sums'));
const N = 128, pitch = 2e-6, wavelength = 532e-9, k = 2 * Math.PI / wavelength;
const place = (i, count, step) => (i + 0.5 - count / 2) * step;
const given = ['--pitch', '2um', '--wavelength', '532nm', '--threads', '1', '-q'];
const hogel = (...words) => execFileSync(hogelProgram, words, { cwd: folder }).toString();

// Plane waves of a quarter of the directions that the samples carry, with random amplitudes.
function makeField() {
    let state = 1;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647 - 0.5;
    const waves = Array.from({ length: 300 }, () =>
        ({ fx: 0.25 / pitch * random(), fy: 0.25 / pitch * random(), re: 0.004 * random(), im: 0.004 * random() }));
    const field = { re: new Float32Array(N * N), im: new Float32Array(N * N) };
    for (let row = 0; row < N; ++row)
        for (let column = 0; column < N; ++column) {
            const x = place(column, N, pitch), y = -place(row, N, pitch);
            let re = 0, im = 0;
            for (const w of waves) {
                const phase = 2 * Math.PI * (w.fx * x + w.fy * y), c = Math.cos(phase), s = Math.sin(phase);
                re += w.re * c - w.im * s;
                im += w.re * s + w.im * c;
            }
            field.re[row * N + column] = re;
            field.im[row * N + column] = im;
        }
    return field;
}

// Sum over the samples of F (z/r) (1/r - ik) e^{ikr}/(2 pi r), at a point.
function waveAt(field, px, py, pz) {
    let re = 0, im = 0;
    for (let row = 0; row < N; ++row) {
        const dy = py + place(row, N, pitch);
        for (let column = 0; column < N; ++column) {
            const dx = px - place(column, N, pitch), r = Math.sqrt(dx * dx + dy * dy + pz * pz);
            const c = Math.cos(k * r), s = Math.sin(k * r), scale = pz / (2 * Math.PI * r * r) * pitch * pitch;
            const hr = scale * (c / r + k * s), hi = scale * (s / r - k * c), i = row * N + column;
            re += field.re[i] * hr - field.im[i] * hi;
            im += field.re[i] * hi + field.im[i] * hr;
        }
    }
    return [re, im];
}

function writeNpy(name, field) {
    const header = `{'descr': '<c8', 'fortran_order': False, 'shape': (${N}, ${N}), }`.padEnd(117) + '\n';
    const numbers = new Float32Array(2 * N * N);
    for (let i = 0; i < N * N; ++i) numbers.set([field.re[i], field.im[i]], 2 * i);
    const head = Buffer.concat([Buffer.from([0x93]), Buffer.from('NUMPY\x01\0v\0'), Buffer.from(header)]);
    writeFileSync(join(folder, name), Buffer.concat([head, Buffer.from(numbers.buffer)]));
}

function readNpy(name) {
    const bytes = readFileSync(join(folder, name)), start = 10 + bytes.readUInt16LE(8);
    return (row, column) => [0, 4].map((part) => bytes.readFloatLE(start + 8 * (row * N + column) + part));
}

// A TIFF file of one channel of floats, in one strip.
function writeTiff(name, width, height, pixels) {
    const tags = [[256, 4, width], [257, 4, height], [258, 3, 32], [259, 3, 1], [262, 3, 1], [273, 4, 8], [277, 3, 1],
        [278, 4, height], [279, 4, 4 * width * height], [339, 3, 3]];
    const bytes = Buffer.alloc(8 + 4 * width * height + 2 + 12 * tags.length + 4);
    bytes.write('II*\0', 'latin1');
    let at = 8;
    for (const value of pixels) at = bytes.writeFloatLE(value, at);
    bytes.writeUInt32LE(at, 4);
    at = bytes.writeUInt16LE(tags.length, at);
    for (const [tag, type, value] of tags) {
        bytes.writeUInt16LE(tag, at);
        bytes.writeUInt16LE(type, at + 2);
        bytes.writeUInt32LE(1, at + 4);
        type === 3 ? bytes.writeUInt16LE(value, at + 8) : bytes.writeUInt32LE(value, at + 8);
        at += 12;
    }
    writeFileSync(join(folder, name), bytes);
}

const field = makeField();
writeNpy('field.npy', field);

hogel('propagate', 'field.npy', '-o', 'there.npy', '--distance', '3mm', ...given);
const there = readNpy('there.npy');
let both = [0, 0], mine = 0, theirs = 0;
for (let row = 3; row < N; row += 8)
    for (let column = 3; column < N; column += 8) {
        const [a, b] = waveAt(field, place(column, N, pitch), -place(row, N, pitch), 3e-3), [c, d] = there(row, column);
        both = [both[0] + a * c + b * d, both[1] + a * d - b * c];
        mine += a * a + b * b;
        theirs += c * c + d * d;
    }
console.log(`3 mm on, 256 places: correlation ${(Math.hypot(...both) / Math.sqrt(mine * theirs)).toFixed(6)}, ` +
    `energy ${(theirs / mine).toFixed(5)} of the sum's`);

// Through a pupil of 1.2 mm at 20 mm: waves of a point p of the plane in focus arrive in step.
const R = 20e-3, pupil = 1.2e-3, pupilPoints = 72, pixels = 24, pixel = N * pitch / pixels, sub = 3;
for (const focus of [0, 0.5e-3]) {
    const step = pupil / pupilPoints, lens = [];
    for (let j = 0; j < pupilPoints; ++j)
        for (let i = 0; i < pupilPoints; ++i) {
            const x = place(i, pupilPoints, step), y = place(j, pupilPoints, step);
            if (Math.hypot(x, y) <= pupil / 2) lens.push([x, y, ...waveAt(field, x, y, R)]);
        }
    const m = 1 + focus / R, area = lens.length * step * step, film = new Float32Array(pixels * pixels);
    for (let row = 0; row < pixels; ++row)
        for (let column = 0; column < pixels; ++column)
            for (let s = 0; s < sub * sub; ++s) {
                const x = place(column * sub + s % sub, pixels * sub, pixel / sub);
                const y = -place(row * sub + Math.floor(s / sub), pixels * sub, pixel / sub);
                let re = 0, im = 0;
                for (const [qx, qy, a, b] of lens) {
                    const r = Math.hypot(qx - m * x, qy - m * y, m * R);
                    const c = Math.cos(k * r), d = Math.sin(k * r);
                    re += a * c + b * d;
                    im += b * c - a * d;
                }
                const cosine = R / Math.hypot(x, y, R);
                film[row * pixels + column] +=
                    (re * re + im * im) * step ** 4 * cosine / (wavelength ** 2 * area) / (sub * sub);
            }
    writeTiff('sums.tif', pixels, pixels, film);
    for (const camera of ['narrow', 'full']) {
        hogel('photo', 'field.npy', '-o', 'hogel.exr', '--camera', camera, '--eye', '0,0,20mm', '--pupil', '1.2mm', '--focus',
            `${focus * 1e3}mm`, '--resolution', String(pixels), ...given);
        console.log(`${camera}, focus ${focus * 1e3} mm behind the plane: ` +
            hogel('compare', 'sums.tif', 'hogel.exr').trim().replace(/\s+/g, ' '));
    }
}
