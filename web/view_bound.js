// The longitude plot of Eto & Tokuyoshi: how far below the horizon of stretched space reflections reach.
import { $, colours, say } from "./page.js";
import { Sheet } from "./canvas.js";
import { Plot } from "./plot.js";
import { CAPS, capPen, hasCaps, legend } from "./view_stretched.js";

export class BoundView {
    constructor(store, kernel) {
        Object.assign(this, { store, kernel, sheet: new Sheet($("bound")) });
    }

    draw() {
        const { sheet, kernel, store: { state } } = this, [w, h] = sheet.begin(), em = colours.size;
        const plot = new Plot(sheet, [2.6 * em, 1.6 * em, w - 3.6 * em, h - 4.6 * em],
            { low: 0, high: 360, ticks: [0, 90, 180, 270, 360], format: (v) => `${v}°`, title: "azimuth φ of the reflection (degrees)" },
            { low: -1, high: 1, ticks: [-1, -0.5, 0, 0.5, 1], format: (v) => v.toFixed(1).replace("-", "−"), title: "height ô_z in stretched space", indent: 2.2 * em });
        plot.frame();
        if (!hasCaps(state)) {
            say("bound-note", "Caps and their bounds belong to GGX with Smith masking: choose these to see them.");
            legend("bound-legend", []);
            return;
        }
        say("bound-note", "Over the azimuth φ in stretched space: a cap must not end above the exact bound; what it has below is rejected.");
        const { curve } = kernel, count = kernel.bounds();
        const at = (k) => (i) => [plot.x(i), plot.y(curve[k][i])];
        this.fill(plot, curve[0], count);
        const entries = [{ title: "exact bound", colour: colours["region-line"] }];
        CAPS.forEach((cap, k) => {
            const pen = capPen(state, cap);
            sheet.line(count, at(k + 1), pen);
            entries.push({ title: pen.own ? `${pen.title} (${pen.own.toUpperCase()})` : pen.title, colour: pen.colour, dashed: cap !== "bounded" });
        });
        sheet.line(count, at(0), { colour: colours["region-line"], width: 2.4 });
        legend("bound-legend", entries);
    }

    /** What leaves the surface: above the exact bound. */
    fill(plot, bound, count) {
        const c = this.sheet.context;
        c.beginPath();
        c.moveTo(plot.x(0), plot.y(1));
        for (let k = 0; k < count; ++k) c.lineTo(plot.x(k), plot.y(bound[k]));
        c.lineTo(plot.x(360), plot.y(1));
        c.closePath();
        c.fillStyle = colours.region;
        c.fill();
    }
}
