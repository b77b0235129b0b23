// The little of WebGL2 that the sphere needs: programs, buffers that are kept and written again.

export function program(gl, vertex, fragment) {
    const shader = (kind, text) => {
        const s = gl.createShader(kind);
        gl.shaderSource(s, `#version 300 es\nprecision highp float;\n${text}`);
        gl.compileShader(s);
        return s;
    };
    const p = gl.createProgram();
    gl.attachShader(p, shader(gl.VERTEX_SHADER, vertex));
    gl.attachShader(p, shader(gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(p);
    if (!gl.getProgramParameter(p, gl.LINK_STATUS) && !gl.isContextLost())
        throw new Error(gl.getProgramInfoLog(p));
    const names = {};
    for (let k = gl.getProgramParameter(p, gl.ACTIVE_UNIFORMS) - 1; k >= 0; --k) {
        const { name } = gl.getActiveUniform(p, k);
        names[name] = gl.getUniformLocation(p, name);
    }
    return { program: p, at: names };
}

class Buffers {
    constructor(gl) {
        this.gl = gl;
        this.array = gl.createVertexArray();
        this.count = 0;
        gl.bindVertexArray(this.array);
    }

    /** A buffer of `bytes`, read at a location. */
    buffer(location, parts, bytes) {
        const { gl } = this, buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.DYNAMIC_DRAW);
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, parts, gl.FLOAT, false, 0, 0);
        return buffer;
    }

    fill(buffer, data) {
        this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
        this.gl.bufferSubData(this.gl.ARRAY_BUFFER, 0, data);
    }

    draw(mode) {
        const { gl } = this;
        gl.bindVertexArray(this.array);
        if (this.indexed) gl.drawElements(mode, this.indexed, gl.UNSIGNED_INT, 0);
        else if (this.count) gl.drawArrays(mode, 0, this.count);
    }
}

/** Points (x, y, z) at location 0. */
export class Points extends Buffers {
    constructor(gl, capacity) {
        super(gl);
        this.data = new Float32Array(3 * capacity);
        this.own = this.buffer(0, 3, this.data.byteLength);
    }

    write(count) {
        this.count = count;
        this.fill(this.own, this.data.subarray(0, 3 * count));
    }
}

/** Four numbers a vertex, each from an array of its own: as the library has them. */
export class Columns extends Buffers {
    constructor(gl, capacity, indices) {
        super(gl);
        this.own = [0, 1, 2, 3].map((location) => this.buffer(location, 1, 4 * capacity));
        if (!indices) return;
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        this.indexed = indices.length;
    }

    write(columns, count) {
        this.count = count;
        columns.forEach((column, k) => this.fill(this.own[k], column.subarray(0, count)));
    }
}
