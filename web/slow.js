// What takes longer than a frame is asked of the worker: the last question counts.

export class Slow {
    constructor(models, store, answer) {
        Object.assign(this, { models, store, id: 0, ready: false, waiting: null, busy: false });
        this.worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        this.worker.onmessage = ({ data }) => {
            if (data.kind === "ready") {
                this.ready = true;
                if (this.waiting) this.send();
            } else if (data.kind !== "idle" && data.id === this.id) {
                answer(data);
            }
        };
    }

    ask(what) {
        const { state } = this.store;
        this.waiting = {
            ...this.waiting, ...what, id: ++this.id, seed: state.seed, spp: state.spp,
            scenes: ["a", "b"].map((k) => this.models.scene(state, state[k])),
        };
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.send(), 60);
    }

    send() {
        if (!this.ready || !this.waiting) return;
        this.worker.postMessage(this.waiting);
        this.waiting = null;
    }
}
