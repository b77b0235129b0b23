// state.mjs MODULE-FOLDER: every state has an address that leads back to it, and no address leads to a state
// that the page cannot show.
import assert from "node:assert/strict";
import { resolve } from "node:path";

const { DEFAULTS, format, parse } = await import(resolve(process.argv[2], "state.mjs"));

assert.deepEqual(parse(""), DEFAULTS);
assert.equal(format(DEFAULTS), "#");

const other = {
    ax: 0.25, ay: 2.5, theta: 135.5, phi: -90, nt: 25, np: -45, ndf: "beckmann", masking: "vcavity",
    a: "vcavity", b: "vcavity-valid", n: 10000, u: "sobol", seed: 7, show: "a", yaw: -30, pitch: 80, split: 12,
    spp: 16, code: "b", lang: "hlsl", theme: "dark", tour: 3,
};
assert.deepEqual(Object.keys(other), Object.keys(DEFAULTS));
assert.deepEqual(parse(format(other)), other);
for (const key of Object.keys(DEFAULTS)) {
    const one = { ...DEFAULTS, [key]: other[key] };
    assert.deepEqual(parse(format(one)), one, key);
}

const hostile = parse("#ax=NaN&ay=-3&theta=1e9&phi=&nt=x&n=1e99&seed=2.7&ndf=phong&u=__proto__&split=%00&zzz=1&toString=1");
assert.deepEqual(hostile, { ...DEFAULTS, ay: 0.001, theta: 180, n: 65536, seed: 3 });
assert.equal(parse("#n=0").n, 1);
assert.equal(parse("#spp=3").spp, 4);
console.log("state: addresses lead back");
