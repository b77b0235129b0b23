#include "import_camera.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <string.h>

/* The node called `name` below `node`, and its transform to the world; NULL: there is none. */
static const struct aiNode *find_node(const struct aiNode *node, const char *name,
                                      struct aiMatrix4x4 *to_world) {
    const struct aiMatrix4x4 parent = *to_world;
    aiMultiplyMatrix4(to_world, &node->mTransformation);
    if (strcmp(node->mName.data, name) == 0) return node;
    const struct aiMatrix4x4 own = *to_world;
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        const struct aiNode *found = find_node(node->mChildren[i], name, to_world);
        if (found) return found;
        *to_world = own;
    }
    *to_world = parent;
    return NULL;
}

static vec3 transform(const struct aiMatrix4x4 *m, struct aiVector3D v) {
    aiTransformVecByMatrix4(&v, m);
    return v3(v.x, v.y, v.z);
}

static float vertical_angle(const struct aiCamera *c) {
    const float aspect = c->mAspect > 0.0f ? c->mAspect : 16.0f / 9.0f;
    return 2.0f * atanf(tanf(0.5f * c->mHorizontalFOV) / aspect);
}

static void import_camera(lobe_scene *s, const struct aiScene *file, const struct aiCamera *c) {
    struct aiMatrix4x4 to_world;
    aiIdentityMatrix4(&to_world);
    find_node(file->mRootNode, c->mName.data, &to_world);
    const struct aiVector3D place = c->mPosition;
    const struct aiVector3D ahead = {place.x + c->mLookAt.x, place.y + c->mLookAt.y,
                                     place.z + c->mLookAt.z};
    const struct aiVector3D above = {place.x + c->mUp.x, place.y + c->mUp.y, place.z + c->mUp.z};
    const vec3 position = transform(&to_world, place), target = transform(&to_world, ahead);
    const vec3 up = v3_sub(transform(&to_world, above), position);
    const float degrees = vertical_angle(c) * (180.0f / LOBE_PI);
    const int is_usable = v3_is_finite(position) && v3_is_finite(target) && v3_is_finite(up) &&
                          degrees > 0.1f && degrees < 179.0f;
    if (is_usable)
        lobe_scene_add_camera(s, c->mName.data, position, target, up, degrees);
    else
        lobe_warn(&s->warnings,
                  "%s: camera %s is not a perspective one that can be used; it is "
                  "left out",
                  s->name, c->mName.data);
}

void lobe_import_cameras(lobe_scene *s, const struct aiScene *file) {
    for (unsigned i = 0; i < file->mNumCameras; i++) import_camera(s, file, file->mCameras[i]);
}
