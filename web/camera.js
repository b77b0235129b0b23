// An orthographic look at the unit sphere, z up. Shared by the views of spheres: they turn together.

export function cameraOf({ yaw, pitch }) {
    const a = yaw * Math.PI / 180, b = pitch * Math.PI / 180;
    const right = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(b) * Math.cos(a), -Math.sin(b) * Math.sin(a), Math.cos(b)];
    const toward = [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
    return { right, up, toward };
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Right, up, and toward the viewer. */
export const seen = (camera, v) => [dot(camera.right, v), dot(camera.up, v), dot(camera.toward, v)];

/** The point of the sphere at (x, y), in front or behind; outside of the outline: on it. */
export function onSphere(camera, x, y, front) {
    const r = Math.hypot(x, y), k = r > 1 ? 1 / r : 1;
    const z = Math.sqrt(Math.max(0, 1 - (x * x + y * y) * k * k)) * (front ? 1 : -1);
    return [0, 1, 2].map((i) => k * x * camera.right[i] + k * y * camera.up[i] + z * camera.toward[i]);
}

/** Dragging turns the sphere; `scale` is pixels from centre to outline. */
export function turnByDrag(element, store, scale) {
    let last = null;
    element.addEventListener("pointerdown", (event) => {
        last = [event.clientX, event.clientY];
        element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
        if (!last) return;
        const k = 57.3 / scale();
        const yaw = store.state.yaw - k * (event.clientX - last[0]);
        const pitch = Math.min(90, Math.max(-90, store.state.pitch + k * (event.clientY - last[1])));
        last = [event.clientX, event.clientY];
        store.set({ yaw: ((yaw + 540) % 360) - 180, pitch });
    });
    for (const end of ["pointerup", "pointercancel"]) element.addEventListener(end, () => { last = null; });
}
