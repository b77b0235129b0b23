// What the page shows, and how it stands in the address.

export const DEFAULTS = {
    ax: 0.2, ay: 0.8, theta: 60, phi: 45, nt: null, np: 90, ndf: "ggx", masking: "smith",
    a: "bounded", b: "optimal", n: 4096, u: "random", seed: 1,
    show: "both", yaw: 55, pitch: 24, split: 50, spp: 4, code: "a", lang: "c", theme: "auto", tour: 0,
};

const RANGES = {
    ax: [0.001, 2.5], ay: [0.001, 2.5], theta: [0, 180], phi: [-180, 180], nt: [0, 85], np: [-180, 180],
    n: [1, 65536], seed: [0, 2 ** 31 - 1], yaw: [-360, 360], pitch: [-90, 90], split: [0, 100],
    spp: [1, 64], tour: [0, 7],
};
const PICTURE_SAMPLES = [1, 4, 16, 64];
const WHOLE = new Set(["n", "seed", "spp", "tour"]);
const WORDS = {
    ndf: ["ggx", "beckmann"], masking: ["smith", "vcavity"], u: ["random", "stratified", "sobol"],
    show: ["a", "b", "both"], code: ["a", "b"], lang: ["c", "glsl", "hlsl"], theme: ["auto", "light", "dark"],
};

function number(key, text) {
    const [low, high] = RANGES[key], value = Number(text);
    if (text === "" || !Number.isFinite(value)) return DEFAULTS[key];
    if (key === "spp" && !PICTURE_SAMPLES.includes(value)) return DEFAULTS.spp;
    const clamped = Math.min(Math.max(value, low), high);
    return WHOLE.has(key) ? Math.round(clamped) : clamped;
}

/** The state of an address; what it does not say, or says wrongly, has its default. */
export function parse(hash) {
    const state = { ...DEFAULTS };
    for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
        if (Object.hasOwn(RANGES, key)) state[key] = number(key, text);
        else if (Object.hasOwn(WORDS, key) && WORDS[key].includes(text)) state[key] = text;
        else if (key === "a" || key === "b") state[key] = text;
    }
    return state;
}

const shorter = (value) => typeof value === "number" ? String(Math.round(value * 1e4) / 1e4) : value;

/** What differs from the defaults, as an address. */
export function format(state) {
    const words = Object.keys(DEFAULTS)
        .filter((key) => state[key] !== DEFAULTS[key] && state[key] !== null)
        .map((key) => `${key}=${shorter(state[key])}`);
    return `#${words.join("&")}`;
}

/** Holds the state, tells listeners what changed, and writes the address when things calm down. */
export class Store {
    constructor(fix) {
        this.fix = fix;
        this.listeners = [];
        this.state = fix(parse(location.hash));
        this.timer = 0;
        this.written = location.hash;
        addEventListener("hashchange", () => {
            if (location.hash !== this.written) this.replace(parse(location.hash));
        });
    }

    replace(next) {
        const old = this.state;
        this.state = this.fix(next);
        const changed = new Set(Object.keys(DEFAULTS).filter((key) => old[key] !== this.state[key]));
        if (changed.size === 0) return;
        for (const listener of this.listeners) listener(changed);
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.write(), 200);
    }

    set(part) {
        this.replace({ ...this.state, ...part });
    }

    write() {
        this.written = format(this.state);
        history.replaceState(null, "", this.written === "#" ? location.pathname + location.search : this.written);
        this.written = location.hash;
    }
}
