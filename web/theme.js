// Dark and light: what the system says, until somebody chooses.
import { $, readColours } from "./page.js";

export function startTheme(store, redraw) {
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const isDark = () => store.state.theme === "auto" ? dark.matches : store.state.theme === "dark";
    const apply = () => {
        if (store.state.theme === "auto") delete document.documentElement.dataset.theme;
        else document.documentElement.dataset.theme = store.state.theme;
        readColours();
    };
    $("theme").addEventListener("click", () => store.set({ theme: isDark() ? "light" : "dark" }));
    store.listeners.push((changed) => { if (changed.has("theme")) apply(); });
    dark.addEventListener("change", () => { apply(); redraw(); });
    apply();
}
