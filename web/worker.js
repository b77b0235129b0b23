// A second instance of the library, for what takes longer than a frame: integrals and the picture.
import { loadKernel } from "./kernel.js";

const kernel = await loadKernel(import.meta.url);
const ROWS = 16;
let asked = null;

function prepare({ scenes }) {
    scenes.forEach((scene, k) => kernel.prepare(k, ...scene));
}

function integrals(job) {
    prepare(job);
    const integral = [0, 1].map((k) => kernel.expect(k));
    postMessage({ kind: "integrals", id: job.id, integral, albedo: kernel.albedo(), expected: kernel.expected.map((e) => e.slice()) });
}

const breath = () => new Promise((resolve) => { setTimeout(resolve, 0); });

async function picture(job) {
    prepare(job);
    const side = kernel.picture_side();
    for (let first = 0; first < side; first += ROWS) {
        kernel.picture_rows(first, ROWS, job.seed, job.spp);
        const rows = kernel.picture.map((p) => p.slice(4 * side * first, 4 * side * (first + ROWS)));
        postMessage({ kind: "rows", id: job.id, first, count: ROWS, rows }, rows.map((r) => r.buffer));
        await breath();
        if (asked) return false;
    }
    postMessage({ kind: "noise", id: job.id, spp: job.spp, noise: [0, 1].map((k) => kernel.picture_noise(k)) });
    return true;
}

let working = false;
async function work() {
    working = true;
    while (asked) {
        const job = asked;
        asked = null;
        if (job.integrals) integrals(job);
        await breath();
        const done = !job.picture || (!asked && await picture(job));
        if (!done) asked.picture = true;
    }
    working = false;
}

onmessage = ({ data }) => {
    if (asked) {
        data.integrals ||= asked.integrals;
        data.picture ||= asked.picture;
    }
    asked = data;
    if (!working) work();
};
postMessage({ kind: "ready" });
