#include "program.h"

#include <stdio.h>
#include <string.h>

#include "../message.h"
#include "context.h"
#include "texts.h"

static const char *text_of(const char *name) {
    const ssr_text *t = lobe_ssr_texts;
    while (t->name && strcmp(t->name, name) != 0) t++;
    return t->name ? t->text : "#error no such text\n";
}

/* The first line of what the compiler says. */
static lobe_ssr_result refused(const char *name, const char *log) {
    char line[400];
    snprintf(line, sizeof line, "%s", log);
    line[strcspn(line, "\n")] = '\0';
    return lobe_ssr_fail(LOBE_SSR_FAILED,
                         "OpenGL: the driver refuses shader %s: %s; use the processor "
                         "(--backend cpu)",
                         name, line);
}

static lobe_ssr_result compile(const char *const lines[], int count, const char *name,
                               GLuint *shader) {
    char log[1024] = "";
    GLint is_good = 0;
    *shader = glCreateShader(GL_COMPUTE_SHADER);
    glShaderSource(*shader, count, lines, NULL);
    glCompileShader(*shader);
    glGetShaderiv(*shader, GL_COMPILE_STATUS, &is_good);
    if (is_good) return LOBE_SSR_OK;
    glGetShaderInfoLog(*shader, sizeof log, NULL, log);
    return refused(name, log);
}

static lobe_ssr_result link(GLuint shader, const char *name, GLuint *program) {
    char log[1024] = "";
    GLint is_good = 0;
    *program = glCreateProgram();
    glAttachShader(*program, shader);
    glLinkProgram(*program);
    glGetProgramiv(*program, GL_LINK_STATUS, &is_good);
    if (is_good) return LOBE_SSR_OK;
    glGetProgramInfoLog(*program, sizeof log, NULL, log);
    glDeleteProgram(*program);
    *program = 0;
    return refused(name, log);
}

lobe_ssr_result lobe_ssr_gl_program(const char *words, const char *const parts[], GLuint *program) {
    const char *lines[PROGRAM_PARTS_MAX + 3] = {"#version 450\n", words ? words : "",
                                                text_of("common")};
    int count = 3;
    *program = 0;
    for (int k = 0; parts[k]; k++) lines[count++] = text_of(parts[k]);
    const char *name = parts[count - 4];
    GLuint shader;
    lobe_ssr_result result = compile(lines, count, name, &shader);
    if (result == LOBE_SSR_OK) result = link(shader, name, program);
    glDeleteShader(shader);
    return result == LOBE_SSR_OK ? lobe_ssr_gl_check(name) : result;
}
