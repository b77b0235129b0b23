// The library: loads WebAssembly, with vectors where the browser has them, and gives views of its memory.

// A module with one vector instruction: valid only where vectors are known.
const VECTORS = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0,
    10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);

/** Which file this machine can run. */
export function fileName() {
    return WebAssembly.validate(VECTORS) ? "lobe-simd.wasm" : "lobe.wasm";
}

/** The exports, and typed arrays on their memory. */
export function kernelOf(instance) {
    const x = instance.exports;
    const rows = x.rows_at_most();
    const floats = (at, count) => new Float32Array(x.memory.buffer, at, count);
    const column = (at, k) => floats(at + 4 * rows * k, rows);
    const columns = (at, count) => Array.from({ length: count }, (_, k) => column(at, k));
    const draws = (method) => {
        const c = columns(x.draws_at(method), 10);
        return { m: c.slice(0, 3), wo: c.slice(3, 6), cos: c[6], pdfM: c[7], pdf: c[8], weight: c[9] };
    };
    const text = (at) => {
        if (at === 0) return "";
        const bytes = new Uint8Array(x.memory.buffer, at);
        return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
    };
    return {
        ...x, rows, text, file: fileName(),
        numbers: columns(x.numbers_at(), 3),
        query: columns(x.query_at(), 3),
        answer: columns(x.answer_at(), 2),
        curve: Array.from({ length: 4 }, (_, k) => floats(x.curve_at() + 4 * x.curve_at_most() * k, x.curve_at_most())),
        expected: [0, 1].map((k) => floats(x.expected_at(k), 512 + 45 + 36)),
        observed: [0, 1].map((k) => floats(x.observed_at(k), 512 + 45 + 36)),
        picture: [0, 1].map((k) => new Uint8ClampedArray(x.memory.buffer, x.picture_at(k), 4 * x.picture_side() ** 2)),
        result: new Float64Array(x.memory.buffer, x.result_at(), 16),
        draws: [draws(0), draws(1)],
    };
}

/** Fetches and starts the library. Servers that do not know the type of .wasm are no obstacle. */
export async function loadKernel(base) {
    const response = await fetch(new URL(fileName(), base));
    if (!response.ok) throw new Error(`${fileName()}: ${response.status}`);
    const { instance } = await WebAssembly.instantiate(await response.arrayBuffer(), { Math });
    return kernelOf(instance);
}
