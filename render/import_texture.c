#include "import_texture.h"

#include <assimp/scene.h>
#include <assimp/texture.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "inventory.h"

static int read_embedded(const struct aiTexture *embedded, texture *t, int is_srgb) {
    if (embedded->mHeight == 0)
        return lobe_texture_read_memory(t, embedded->pcData, embedded->mWidth, is_srgb);
    unsigned char *rgb = malloc(3 * (size_t)embedded->mWidth * embedded->mHeight);
    if (!rgb) return 0;
    for (size_t i = 0; i < (size_t)embedded->mWidth * embedded->mHeight; i++) {
        rgb[3 * i] = embedded->pcData[i].r;
        rgb[3 * i + 1] = embedded->pcData[i].g;
        rgb[3 * i + 2] = embedded->pcData[i].b;
    }
    *t = (texture){(int)embedded->mWidth, (int)embedded->mHeight, 3, is_srgb, .texels = rgb};
    return 1;
}

/* "*3", or the name of a texture in the file; NULL: it lies outside. */
static const struct aiTexture *find_embedded(const struct aiScene *file, const char *name) {
    if (name[0] == '*') {
        unsigned long i = strtoul(name + 1, NULL, 10);
        return i < file->mNumTextures ? file->mTextures[i] : NULL;
    }
    for (unsigned i = 0; i < file->mNumTextures; i++)
        if (file->mTextures[i]->mFilename.length &&
            strcmp(file->mTextures[i]->mFilename.data, name) == 0)
            return file->mTextures[i];
    return NULL;
}

static int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* "%20" and the like, in place: names in glTF are URIs. */
static void decode_percent(char *text) {
    char *to = text;
    for (const char *from = text; *from; from++) {
        const int high = *from == '%' ? hex_digit(from[1]) : -1;
        const int low = high >= 0 ? hex_digit(from[2]) : -1;
        if (low > 0 || (low == 0 && high > 0)) {
            *to++ = (char)(16 * high + low);
            from += 2;
        } else {
            *to++ = *from;
        }
    }
    *to = 0;
}

int lobe_import_texture_beside(const char *scene_path, const char *name, texture *t, int is_srgb) {
    char path[PATH_MAX];
    const char *slash = strrchr(scene_path, '/');
    const int folder = slash && name[0] != '/' ? (int)(slash - scene_path) + 1 : 0;
    if (snprintf(path, sizeof path, "%.*s%s", folder, scene_path, name) >= (int)sizeof path)
        return 0;
    for (char *c = path + folder; *c; c++)
        if (*c == '\\') *c = '/';
    if (lobe_texture_read_file(t, path, is_srgb)) return 1;
    if (!strchr(name, '%')) return 0;
    decode_percent(path + folder);
    return lobe_texture_read_file(t, path, is_srgb);
}

void lobe_import_missing_texture(lobe_scene *s, const char *path, const char *name) {
    s->info.missing_textures++;
    lobe_warn(&s->warnings, "%s: texture %s is missing or unreadable; it is shown in magenta", path,
              name);
}

int lobe_import_magenta(lobe_scene *s, int is_srgb) {
    texture t;
    if (!is_srgb || !lobe_texture_solid(&t, v3(1.0f, 0.0f, 1.0f), 1)) return NO_TEXTURE;
    lobe_scene_note(s, (lobe_scene_item){.part = LOBE_SCENE_TEXTURE, .name = "(missing)"});
    return lobe_scene_add_texture(s, t);
}

static int read_new(texture_reader *r, const char *name, picture_use use) {
    const struct aiTexture *embedded = find_embedded(r->file, name);
    const int is_srgb = use == AS_COLOR;
    texture t;
    if (embedded ? read_embedded(embedded, &t, is_srgb)
                 : lobe_import_texture_beside(r->path, name, &t, is_srgb)) {
        if (use == AS_OPACITY && !lobe_texture_make_opacity(&t)) r->scene->out_of_memory = 1;
        lobe_scene_note(r->scene, (lobe_scene_item){.part = LOBE_SCENE_TEXTURE, .name = name});
        return lobe_scene_add_texture(r->scene, t);
    }
    lobe_import_missing_texture(r->scene, r->path, name);
    return lobe_import_magenta(r->scene, is_srgb);
}

/* Without memory for the note the texture is read again, which is slow and not wrong. */
static void remember(texture_reader *r, const char *name, picture_use use, int index) {
    read_texture *known = realloc(r->known, (r->count + 1) * sizeof *known);
    if (!known) return;
    r->known = known;
    const size_t size = strlen(name) + 1;
    char *copy = malloc(size);
    if (!copy) return;
    memcpy(copy, name, size);
    known[r->count++] = (read_texture){copy, use, index};
}

int lobe_import_texture(texture_reader *r, const char *name, picture_use use) {
    for (size_t i = 0; i < r->count; i++)
        if (r->known[i].use == use && strcmp(r->known[i].name, name) == 0) return r->known[i].index;
    const int index = read_new(r, name, use);
    remember(r, name, use, index);
    return index;
}

void lobe_import_textures_end(texture_reader *r) {
    for (size_t i = 0; i < r->count; i++) free(r->known[i].name);
    free(r->known);
}
