// Small things that every module needs.

export const $ = (id) => document.getElementById(id);

/** Sets text only where it differs: no layout for nothing. */
export function say(id, text) {
    const element = $(id);
    if (element.textContent !== text) element.textContent = text;
}

/** The colours of the theme, read when it changes. */
export const colours = {};
const NAMES = ["page", "card", "ink", "soft", "line", "faint", "a", "b", "a-wash", "b-wash", "region", "region-line"];

export function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of NAMES) colours[name] = style.getPropertyValue(`--${name}`).trim();
    colours.size = parseFloat(style.fontSize);
}

/** "#rrggbb" as three numbers from 0 to 1. */
export function rgb(hex) {
    const full = hex.length === 4 ? hex.replace(/[0-9a-f]/gi, "$&$&") : hex;
    return [1, 3, 5].map((at) => parseInt(full.slice(at, at + 2), 16) / 255);
}

export const pressed = (id, on) => $(id).setAttribute("aria-pressed", String(on));
