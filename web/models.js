// Which methods there are, from the library's lists.

export class Models {
    constructor(kernel) {
        this.kernel = kernel;
        const names = (name, count) => Array.from({ length: count }, (_, k) => kernel.text(name(k)));
        this.ndfs = names(kernel.ndf_name, 2);
        this.maskings = names(kernel.masking_name, 2);
        this.methods = names(kernel.method_name, kernel.method_count());
        this.abouts = names(kernel.method_about, kernel.method_count());
    }

    kernelOf(state, method) {
        const at = this.kernel.kernel_name(this.ndfs.indexOf(state.ndf),
            this.maskings.indexOf(state.masking), this.methods.indexOf(method));
        return this.kernel.text(at);
    }

    /** Methods of a distribution and masking, from the plainest to the best. */
    of(state) {
        return this.methods.filter((method) => this.kernelOf(state, method) !== "");
    }

    about(method) {
        return this.abouts[this.methods.indexOf(method)] ?? "";
    }

    /** A state whose two methods exist: the best one takes the place of B, the one before it of A. */
    fix(state) {
        const known = this.of(state);
        const a = known.includes(state.a) ? state.a : known[known.length - 2];
        const b = known.includes(state.b) ? state.b : known[known.length - 1];
        return { ...state, a, b };
    }

    /** The arguments of `prepare` after the number of the method. */
    scene(state, method) {
        const wi = direction(state.theta, state.phi);
        const plane = state.nt === null ? [0, 0, 1] : direction(state.nt, state.np);
        return [this.ndfs.indexOf(state.ndf), this.maskings.indexOf(state.masking),
            this.methods.indexOf(method), state.ax, state.ay, ...wi, ...plane];
    }
}

/** Degrees from the normal and around it, to a unit vector. */
export function direction(theta, phi) {
    const t = theta * Math.PI / 180, p = phi * Math.PI / 180;
    return [Math.sin(t) * Math.cos(p), Math.sin(t) * Math.sin(p), Math.cos(t)];
}

export function anglesOf([x, y, z]) {
    const across = Math.hypot(x, y);
    return {
        theta: Math.atan2(across, z) * 180 / Math.PI,
        phi: across < 1e-6 ? 0 : Math.atan2(y, x) * 180 / Math.PI,
    };
}
