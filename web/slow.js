// What takes longer than a frame is asked of the worker. While things move, integrals come a little late,
// and say whether they are of the state that is shown.

export class Slow {
    constructor(models, store, answer) {
        Object.assign(this, { models, store, id: 0, ready: false, waiting: null, timer: 0 });
        this.since = { integrals: 0, picture: 0 }; // the numbers of the last questions
        this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        this.worker.onmessage = ({ data }) => {
            if (data.kind === "ready") {
                this.ready = true;
                if (this.waiting) this.send();
            } else if (data.kind === "integrals") {
                answer(data, data.id >= this.since.integrals);
            } else if (data.id >= this.since.picture) {
                answer(data, true);
            }
        };
    }

    ask(what) {
        const { state } = this.store;
        this.waiting = {
            ...this.waiting, ...what, id: ++this.id, seed: state.seed, spp: state.spp,
            scenes: ["a", "b"].map((k) => this.models.scene(state, state[k])),
        };
        for (const key of Object.keys(what)) if (what[key]) this.since[key] = this.id;
        this.timer ||= setTimeout(() => this.send(), 40);
    }

    send() {
        this.timer = 0;
        if (!this.ready || !this.waiting) return;
        this.worker.postMessage(this.waiting);
        this.waiting = null;
    }
}
