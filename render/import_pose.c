#include "import_pose.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <string.h>

#include "affine.h"
#include "image.h"
#include "inventory.h"

struct aiNode *lobe_import_find_node(struct aiNode *node, const char *name,
                                     struct aiMatrix4x4 *to_world) {
    struct aiMatrix4x4 own = to_world ? *to_world : node->mTransformation;
    if (to_world) aiMultiplyMatrix4(&own, &node->mTransformation);
    struct aiNode *found = strcmp(node->mName.data, name) == 0 ? node : NULL;
    if (found && to_world) *to_world = own;
    for (unsigned i = 0; i < node->mNumChildren && !found; i++) {
        struct aiMatrix4x4 below = own;
        found = lobe_import_find_node(node->mChildren[i], name, to_world ? &below : NULL);
        if (found && to_world) *to_world = below;
    }
    return found;
}

/* ---- A moment of an animation ------------------------------------------------------------------------ */

/* The last of `count` keys that is not after `time`, the first one if there is none; *share: how far it is to the next. */
#define KEY_BEFORE(keys, count, time, share)                                                       \
    do {                                                                                           \
        while (key + 1 < (count) && !((keys)[key + 1].mTime > (time))) key++;                      \
        const double length = key + 1 < (count) ? (keys)[key + 1].mTime - (keys)[key].mTime : 0.0; \
        (share) =                                                                                  \
            length > 0.0 ? fmin(fmax(((time) - (keys)[key].mTime) / length, 0.0), 1.0) : 0.0;      \
    } while (0)

static vec3 vector_at(const struct aiVectorKey *keys, unsigned count, double time, vec3 resting) {
    if (count == 0) return resting;
    unsigned key = 0;
    double share;
    KEY_BEFORE(keys, count, time, share);
    const struct aiVector3D a = keys[key].mValue, b = keys[key + 1 < count ? key + 1 : key].mValue;
    return v3_lerp(v3(a.x, a.y, a.z), v3(b.x, b.y, b.z), (float)share);
}

static struct aiQuaternion rotation_at(const struct aiQuatKey *keys, unsigned count, double time,
                                       struct aiQuaternion resting) {
    if (count == 0) return resting;
    unsigned key = 0;
    double share;
    KEY_BEFORE(keys, count, time, share);
    if (!(share > 0.0)) return keys[key].mValue;
    struct aiQuaternion q;
    aiQuaternionInterpolate(&q, &keys[key].mValue, &keys[key + 1].mValue, (float)share);
    return q;
}

static struct aiMatrix4x4 matrix_of(vec3 place, struct aiQuaternion turn, vec3 size) {
    const double t[3] = {(double)place.x, (double)place.y, (double)place.z};
    const double r[4] = {(double)turn.x, (double)turn.y, (double)turn.z, (double)turn.w};
    const double s[3] = {(double)size.x, (double)size.y, (double)size.z};
    const affine a = lobe_affine_of(t, r, s);
    return (struct aiMatrix4x4){a.m[0][0], a.m[0][1], a.m[0][2], a.m[0][3], a.m[1][0], a.m[1][1],
                                a.m[1][2], a.m[1][3], a.m[2][0], a.m[2][1], a.m[2][2], a.m[2][3],
                                0.0f,      0.0f,      0.0f,      1.0f};
}

static void play(struct aiScene *file, const struct aiAnimation *animation, double seconds) {
    const double rate = animation->mTicksPerSecond > 0.0 ? animation->mTicksPerSecond : 25.0;
    const double time = seconds * rate;
    for (unsigned i = 0; i < animation->mNumChannels; i++) {
        const struct aiNodeAnim *c = animation->mChannels[i];
        struct aiNode *node = lobe_import_find_node(file->mRootNode, c->mNodeName.data, NULL);
        if (!node) continue;
        struct aiVector3D size, place;
        struct aiQuaternion turn;
        aiDecomposeMatrix(&node->mTransformation, &size, &turn, &place);
        node->mTransformation = matrix_of(
            vector_at(c->mPositionKeys, c->mNumPositionKeys, time, v3(place.x, place.y, place.z)),
            rotation_at(c->mRotationKeys, c->mNumRotationKeys, time, turn),
            vector_at(c->mScalingKeys, c->mNumScalingKeys, time, v3(size.x, size.y, size.z)));
    }
}

static void note_animation(lobe_scene *s, const struct aiAnimation *a) {
    const double rate = a->mTicksPerSecond > 0.0 ? a->mTicksPerSecond : 25.0;
    lobe_scene_note(s, (lobe_scene_item){.part = LOBE_SCENE_ANIMATION,
                                         .name = a->mName.data,
                                         .about = "",
                                         .count = a->mNumChannels,
                                         .seconds = a->mDuration / rate});
}

static lobe_render_result play_all(lobe_scene *s, struct aiScene *file,
                                   const lobe_scene_options *options) {
    const char *asked = options->animation;
    int is_found = !asked || strcmp(asked, "all") == 0;
    for (unsigned i = 0; i < file->mNumAnimations; i++) {
        const struct aiAnimation *a = file->mAnimations[i];
        const int is_asked =
            asked ? strcmp(asked, "all") == 0 || strcmp(asked, a->mName.data) == 0 : i == 0;
        is_found |= is_asked;
        if (is_asked) play(file, a, options->frame_time);
    }
    if (is_found) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: no animation named %.100s; lobe info lists them, without a name the "
                     "first one is taken",
                     s->name, asked);
}

/* What an animation moves and these importers do not. */
static void warn_of_bends(lobe_scene *s, const struct aiScene *file) {
    int has_bones = 0, has_shapes = 0;
    for (unsigned i = 0; i < file->mNumMeshes; i++) {
        has_bones |= file->mMeshes[i]->mNumBones > 0;
        has_shapes |= file->mMeshes[i]->mNumAnimMeshes > 0;
    }
    if (has_bones)
        lobe_warn(&s->warnings, "%s: has skinned meshes; they are shown as they were bound",
                  s->name);
    if (has_shapes)
        lobe_warn(&s->warnings, "%s: has morphed meshes; they are shown without", s->name);
}

/* ---- Axes and units of FBX --------------------------------------------------------------------------- */

static double number_of(const struct aiScene *file, const char *name, double fallback) {
    const struct aiMetadata *m = file->mMetaData;
    for (unsigned i = 0; m && i < m->mNumProperties; i++) {
        if (strcmp(m->mKeys[i].data, name) != 0 || !m->mValues[i].mData) continue;
        if (m->mValues[i].mType == AI_INT32) return *(const int32_t *)m->mValues[i].mData;
        if (m->mValues[i].mType == AI_FLOAT) return (double)*(const float *)m->mValues[i].mData;
        if (m->mValues[i].mType == AI_DOUBLE) return *(const double *)m->mValues[i].mData;
    }
    return fallback;
}

/* A row of what makes +X, +Y or +Z of an axis of the file. 0: it has no such axis. */
static int read_axis(const struct aiScene *file, const char *name, const char *sign_name, int usual,
                     float size, float row[3]) {
    const double axis = number_of(file, name, usual);
    if (axis != 0.0 && axis != 1.0 && axis != 2.0) return 0;
    row[(int)axis] = number_of(file, sign_name, 1.0) < 0.0 ? -size : size;
    return 1;
}

/* FBX says which axis is up, and how many centimetres a unit is. */
static void stand_up(struct aiScene *file) {
    const double size = 0.01 * number_of(file, "UnitScaleFactor", 1.0);
    if (!(size > 0.0) || !isfinite((float)size)) return;
    float m[3][3] = {{0}};
    if (!read_axis(file, "CoordAxis", "CoordAxisSign", 0, (float)size, m[0]) ||
        !read_axis(file, "UpAxis", "UpAxisSign", 1, (float)size, m[1]) ||
        !read_axis(file, "FrontAxis", "FrontAxisSign", 2, (float)size, m[2]))
        return;
    for (int i = 0; i < 3; i++)
        if (m[0][i] * m[1][i] != 0.0f || m[0][i] * m[2][i] != 0.0f || m[1][i] * m[2][i] != 0.0f)
            return;
    struct aiMatrix4x4 t = {m[0][0], m[0][1], m[0][2], 0.0f, m[1][0], m[1][1], m[1][2], 0.0f,
                            m[2][0], m[2][1], m[2][2], 0.0f, 0.0f,    0.0f,    0.0f,    1.0f};
    aiMultiplyMatrix4(&t, &file->mRootNode->mTransformation);
    file->mRootNode->mTransformation = t;
}

lobe_render_result lobe_import_pose(lobe_scene *s, struct aiScene *file, const char *path,
                                    const lobe_scene_options *options) {
    s->is_animated = file->mNumAnimations > 0;
    for (unsigned i = 0; i < file->mNumAnimations; i++) note_animation(s, file->mAnimations[i]);
    lobe_render_result result = LOBE_RENDER_OK;
    if (s->is_animated && isfinite(options->frame_time))
        result = play_all(s, file, options);
    else if (s->is_animated)
        lobe_warn(&s->warnings,
                  "%s: is animated; nodes are shown where they rest, --frame-time shows a moment",
                  s->name);
    warn_of_bends(s, file);
    if (lobe_path_ends(path, ".fbx")) stand_up(file);
    return result;
}
