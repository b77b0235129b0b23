#include "import_camera.h"

#include <assimp/cimport.h>
#include <assimp/scene.h>

#include "import_pose.h"
#include "inventory.h"

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
    lobe_import_find_node(file->mRootNode, c->mName.data, &to_world);
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

/* Of a directional light the colour is irradiance. */
static void import_sun(lobe_scene *s, const struct aiScene *file, const struct aiLight *from) {
    struct aiMatrix4x4 to_world;
    aiIdentityMatrix4(&to_world);
    lobe_import_find_node(file->mRootNode, from->mName.data, &to_world);
    const struct aiVector3D nowhere = {0.0f, 0.0f, 0.0f};
    const vec3 ahead =
        v3_sub(transform(&to_world, from->mDirection), transform(&to_world, nowhere));
    const lamp l = {.kind = LAMP_DIRECTIONAL,
                    .direction = v3_normalize_or(ahead, v3_all(0.0f)),
                    .intensity =
                        v3(from->mColorDiffuse.r, from->mColorDiffuse.g, from->mColorDiffuse.b)};
    const vec3 i = l.intensity;
    if (!v3_is_finite(i) || i.x < 0.0f || i.y < 0.0f || i.z < 0.0f ||
        !(v3_dot(l.direction, l.direction) > 0.0f)) {
        lobe_warn(&s->warnings, "%s: light %s is not one that can be used; it is left out", s->name,
                  from->mName.data);
        return;
    }
    lobe_scene_note(s, (lobe_scene_item){.part = LOBE_SCENE_LIGHT, .name = from->mName.data});
    lobe_scene_add_lamp(s, l);
}

void lobe_import_lights(lobe_scene *s, const struct aiScene *file) {
    const char *first = NULL;
    for (unsigned i = 0; i < file->mNumLights; i++) {
        const struct aiLight *l = file->mLights[i];
        if (l->mType == aiLightSource_DIRECTIONAL)
            import_sun(s, file, l);
        else if (!first)
            first = l->mName.data;
    }
    if (first)
        lobe_warn(
            &s->warnings,
            "%s: has lights that are not directional, the first one %s; their strength has no "
            "known unit, they are left out",
            s->name, first);
}
