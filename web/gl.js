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

/** Vertices of `parts` numbers at location 0, of a size that never changes. */
export class Vertices {
    constructor(gl, capacity, parts) {
        Object.assign(this, { gl, parts, array: gl.createVertexArray(), buffer: gl.createBuffer() });
        this.data = new Float32Array(capacity * parts);
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
        gl.bufferData(gl.ARRAY_BUFFER, this.data.byteLength, gl.DYNAMIC_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, parts, gl.FLOAT, false, 0, 0);
        this.count = 0;
    }

    indices(list) {
        const { gl } = this;
        gl.bindVertexArray(this.array);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, list, gl.STATIC_DRAW);
        this.indexed = list.length;
    }

    write(count) {
        const { gl } = this;
        this.count = count;
        gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
        gl.bufferSubData(gl.ARRAY_BUFFER, 0, this.data.subarray(0, count * this.parts));
    }

    draw(mode) {
        const { gl } = this;
        gl.bindVertexArray(this.array);
        if (this.indexed) gl.drawElements(mode, this.indexed, gl.UNSIGNED_INT, 0);
        else if (this.count) gl.drawArrays(mode, 0, this.count);
    }
}
