/* The texts of the shaders, made by embed.cmake; the last has no name. */
#ifndef LOBE_SSR_GL_TEXTS_H
#define LOBE_SSR_GL_TEXTS_H

typedef struct ssr_text {
    const char *name, *text;
} ssr_text;

extern const ssr_text lobe_ssr_texts[];

#endif
