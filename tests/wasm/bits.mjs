// bits.mjs INPUTS KERNEL.js WASM...: draws, densities and values in WebAssembly have the bits that the library of
// this processor wrote to INPUTS (inputs.c). With --spoil one input is changed: the comparison must fail.
import { readFile } from "node:fs/promises";
import { basename, resolve } from "node:path";

const [inputs, module, ...rest] = process.argv.slice(2);
const spoil = rest[0] === "--spoil";
const { kernelOf } = await import(resolve(module));
const file = await readFile(inputs);
const COLUMNS = 18, INPUTS = 6;

function sameBits(a, b) {
    return Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength),
        Buffer.from(b.buffer, b.byteOffset, b.byteLength)) === 0;
}

/** Blocks of the file: a model, a scene, and columns of numbers. */
function* blocks() {
    const all = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
    for (let at = 0; at < all.byteLength;) {
        const head = new Int32Array(all, at, 4), scene = new Float32Array(all, at + 16, 8);
        const rows = head[3], first = at + 48;
        const columns = Array.from({ length: COLUMNS },
            (_, k) => new Float32Array(all, first + 4 * rows * k, rows));
        yield { head, scene, columns, rows };
        at = first + 4 * rows * COLUMNS;
    }
}

/** The columns that a block should have according to WebAssembly. */
function answers(kernel, { head, scene, columns, rows }) {
    kernel.prepare(1, head[0], head[1], head[2], ...scene);
    for (let k = 0; k < 3; ++k) {
        kernel.numbers[k].set(columns[k]);
        kernel.query[k].set(columns[3 + k]);
    }
    if (spoil) kernel.numbers[0][rows - 1] = 0.5;
    kernel.draw(1, rows);
    kernel.eval(1, rows);
    const d = kernel.draws[1];
    return [...d.m, ...d.wo, d.cos, d.pdfM, d.pdf, d.weight, ...kernel.answer]
        .map((column) => column.subarray(0, rows));
}

let failed = 0;
for (const wasm of rest.filter((word) => word !== "--spoil")) {
    const { instance } = await WebAssembly.instantiate(await readFile(wasm), { Math });
    const kernel = kernelOf(instance);
    const models = new Set();
    let rows = 0, differ = 0, drawn = 0;
    for (const block of blocks()) {
        answers(kernel, block).forEach((column, k) => {
            if (!sameBits(column, block.columns[INPUTS + k])) ++differ;
        });
        models.add(block.head.slice(0, 3).join());
        rows += block.rows;
        drawn += block.columns[14].filter((pdf) => pdf > 0).length;
    }
    console.log(`${basename(wasm)}: ${rows} inputs of ${models.size} models, ${drawn} draws leave, `
        + `${differ} columns differ`);
    if (differ > 0 || rows < 10000 || drawn === 0) failed = 1;
}
process.exit(failed);
