// Draws views when they are needed: once a frame at most, only those that can be seen.

export class Views {
    constructor() {
        this.views = new Map();
        this.dirty = new Set();
        this.visible = new Set();
        this.frame = 0;
        this.before = () => {};
        this.observer = new IntersectionObserver((entries) => {
            for (const { target, isIntersecting } of entries) {
                if (isIntersecting) this.visible.add(target.id);
                else this.visible.delete(target.id);
            }
            this.ask();
        }, { rootMargin: "100px" });
        this.sizes = new ResizeObserver((entries) => this.touch(...entries.map(({ target }) => target.closest(".card").id)));
    }

    add(card, view) {
        this.views.set(card.id, view);
        this.observer.observe(card);
        this.sizes.observe(view.sheet?.canvas ?? view.canvas ?? card);
        this.dirty.add(card.id);
    }

    /** These, or all, are to be drawn again. */
    touch(...ids) {
        for (const id of ids.length ? ids : this.views.keys()) this.dirty.add(id);
        this.ask();
    }

    ask() {
        if (this.frame === 0) this.frame = requestAnimationFrame(() => this.run());
    }

    run() {
        this.frame = 0;
        this.before();
        for (const id of this.dirty)
            if (this.visible.has(id)) {
                this.dirty.delete(id);
                this.views.get(id).draw();
            }
    }
}
