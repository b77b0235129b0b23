// The form: from inputs to the state, and back.
import { $ } from "./page.js";

const ALPHA_LOW = 0.01, ALPHA_HIGH = 2.5;
const toAlpha = (x) => Number((ALPHA_LOW * (ALPHA_HIGH / ALPHA_LOW) ** (x / 1000)).toPrecision(3));
const fromAlpha = (a) => Math.round(1000 * Math.log(Math.max(a, ALPHA_LOW) / ALPHA_LOW)
    / Math.log(ALPHA_HIGH / ALPHA_LOW));

const TITLES = { ggx: "GGX", beckmann: "Beckmann", smith: "Smith", vcavity: "V-cavities" };

function fill(select, names, title = (name) => TITLES[name] ?? name) {
    if (select.dataset.names === names.join()) return;
    select.dataset.names = names.join();
    select.replaceChildren(...names.map((name) => new Option(title(name), name)));
}

/** A range and a number for one quantity. */
function pair(store, id, key, { to = Number, low, high }, also) {
    const set = (value) => {
        if (Number.isFinite(value)) store.set(also({ [key]: Math.min(Math.max(value, low), high) }));
    };
    $(id).addEventListener("input", (event) => set(to(event.target.value)));
    $(`${id}-value`)?.addEventListener("change", (event) => set(event.target.valueAsNumber));
}

function alphas(store) {
    const both = (part) => {
        const value = Object.values(part)[0];
        return $("link-alpha").checked ? { ax: value, ay: value } : part;
    };
    pair(store, "alpha-x", "ax", { to: toAlpha, low: 0.001, high: 2.5 }, both);
    pair(store, "alpha-y", "ay", { to: toAlpha, low: 0.001, high: 2.5 }, both);
    $("link-alpha").checked = store.state.ax === store.state.ay;
    $("link-alpha").addEventListener("change", (event) => {
        if (event.target.checked) store.set({ ay: store.state.ax });
    });
}

function show(id, value, range, text) {
    const input = $(id);
    if (document.activeElement !== input || input.type === "range") input.value = range;
    input.setAttribute("aria-valuetext", text);
    const number = $(`${id}-value`);
    if (number.tagName === "OUTPUT") number.value = text;
    else number.value = String(Math.round(value * 1000) / 1000);
}

function bind(store) {
    const same = (part) => part;
    alphas(store);
    pair(store, "theta", "theta", { low: 0, high: 180 }, same);
    pair(store, "phi", "phi", { low: -180, high: 180 }, same);
    pair(store, "normal-theta", "nt", { low: 0, high: 85 }, same);
    pair(store, "normal-phi", "np", { low: -180, high: 180 }, same);
    pair(store, "samples", "n", { to: (x) => 2 ** x, low: 1, high: 65536 }, same);
    for (const [id, key] of Object.entries({
        ndf: "ndf", masking: "masking", "method-a": "a", "method-b": "b", pattern: "u",
    })) $(id).addEventListener("change", (event) => store.set({ [key]: event.target.value }));
    $("normal").addEventListener("change", (event) => store.set({ nt: event.target.checked ? 25 : null }));
    $("seed").addEventListener("click", () => store.set({ seed: store.state.seed + 1 }));
    $("spp").addEventListener("change", (event) => store.set({ spp: Number(event.target.value) }));
    $("controls").addEventListener("submit", (event) => event.preventDefault());
}

export function startControls(store, models) {
    bind(store);
    const update = () => {
        const s = store.state, degrees = (x) => `${Math.round(x * 10) / 10}°`;
        fill($("ndf"), models.ndfs);
        fill($("masking"), models.maskings);
        for (const k of ["a", "b"]) {
            fill($(`method-${k}`), models.of(s));
            $(`method-${k}`).value = s[k];
            $(`about-${k}`).textContent = models.about(s[k]);
        }
        for (const [id, key] of Object.entries({ ndf: "ndf", masking: "masking", pattern: "u", spp: "spp" }))
            $(id).value = s[key];
        if (s.ax !== s.ay) $("link-alpha").checked = false;
        show("alpha-x", s.ax, fromAlpha(s.ax), String(s.ax));
        show("alpha-y", s.ay, fromAlpha(s.ay), String(s.ay));
        show("theta", s.theta, s.theta, degrees(s.theta));
        show("phi", s.phi, s.phi, degrees(s.phi));
        $("normal").checked = s.nt !== null;
        $("normal-fields").hidden = s.nt === null;
        show("normal-theta", s.nt ?? 0, s.nt ?? 0, degrees(s.nt ?? 0));
        show("normal-phi", s.np, s.np, degrees(s.np));
        show("samples", s.n, Math.log2(s.n), s.n.toLocaleString("en"));
    };
    store.listeners.push(update);
    update();
}
