/* What a glTF 2.0 file says, in plain structures: the seam between tinygltf (C++) and the importer.
 * Nothing is checked but what is said here. Indices are -1 where there is none, and may be out of
 * range; numbers may be anything. */
#ifndef LOBE_RENDER_GLTF_MODEL_H
#define LOBE_RENDER_GLTF_MODEL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gltf_bytes {
    const unsigned char *data;
    size_t size;
} gltf_bytes;

/* EXT_meshopt_compression */
typedef enum gltf_packing {
    GLTF_PLAIN,
    GLTF_ATTRIBUTES,
    GLTF_TRIANGLES,
    GLTF_INDICES
} gltf_packing;
typedef enum gltf_filter {
    GLTF_FILTER_NONE,
    GLTF_FILTER_OCTAHEDRAL,
    GLTF_FILTER_QUATERNION,
    GLTF_FILTER_EXPONENTIAL,
    GLTF_FILTER_UNKNOWN
} gltf_filter;

typedef struct gltf_view {
    int buffer; /* the packed one, if there is one */
    size_t offset, length, stride;
    gltf_packing packing;
    gltf_filter filter;
    size_t count; /* of packed elements */
} gltf_view;

typedef struct gltf_accessor {
    int view, component, channels; /* component: 5120 … 5126; channels: 0 is no scalar or vector */
    size_t offset, count;
    int is_normalized, is_sparse;
    size_t sparse_count;
    int index_view, index_component, value_view;
    size_t index_offset, value_offset;
} gltf_accessor;

enum {
    GLTF_POSITION,
    GLTF_NORMAL,
    GLTF_TANGENT,
    GLTF_COLOR,
    GLTF_TEXCOORD,
    GLTF_TEXCOORD_SETS = 8,
    GLTF_SEMANTICS = GLTF_TEXCOORD + GLTF_TEXCOORD_SETS
};

typedef struct gltf_primitive {
    int accessors[GLTF_SEMANTICS];
    int indices, material, mode;
    int draco_view;
    int draco_ids[GLTF_SEMANTICS];
    int has_targets;
} gltf_primitive;

typedef struct gltf_mesh {
    const gltf_primitive *primitives;
    size_t primitive_count;
} gltf_mesh;

typedef struct gltf_node {
    const char *name;
    int mesh, camera, skin, light;
    const int *children;
    size_t child_count;
    int has_matrix;
    double matrix[16]; /* by columns */
    double translation[3], rotation[4], scale[3];
} gltf_node;

typedef struct gltf_texture_use {
    int texture, uv_set;
    double offset[2], rotation, scale[2];
} gltf_texture_use;

typedef enum gltf_alpha { GLTF_OPAQUE, GLTF_MASK, GLTF_BLEND } gltf_alpha;

typedef struct gltf_material {
    double base_color[4], metallic, roughness;
    double emission[3], emissive_strength;
    double normal_scale, alpha_cutoff;
    double anisotropy, anisotropy_rotation;
    double specular, specular_color[3];
    double clearcoat, clearcoat_roughness, clearcoat_normal_scale;
    double transmission, ior, thickness;
    double attenuation_distance, attenuation_color[3];
    gltf_alpha alpha;
    int is_unlit;
    gltf_texture_use base, surface, normal, emissive, anisotropic, transmissive, specular_share,
        specular_tint, clearcoat_share, clearcoat_rough, clearcoat_normal;
} gltf_material;

enum { GLTF_REPEAT = 10497, GLTF_MIRROR = 33648, GLTF_CLAMP = 33071, GLTF_NEAREST = 9728 };

typedef struct gltf_texture {
    int image, wrap_u, wrap_v, filter;
} gltf_texture;

typedef struct gltf_image {
    const char *uri; /* "" where the picture is in the file */
    int view;
    gltf_bytes bytes; /* from a data URI or a file beside; not decoded */
} gltf_image;

typedef struct gltf_camera {
    const char *name;
    int is_perspective;
    double vertical_angle; /* radians */
} gltf_camera;

typedef enum gltf_light_kind {
    GLTF_LIGHT_POINT,
    GLTF_LIGHT_SPOT,
    GLTF_LIGHT_DIRECTIONAL,
    GLTF_LIGHT_UNKNOWN
} gltf_light_kind;

typedef struct gltf_light {
    gltf_light_kind kind;
    double color[3], intensity, range, inner_angle, outer_angle;
} gltf_light;

typedef struct gltf_model {
    const gltf_bytes *buffers;
    const gltf_view *views;
    const gltf_accessor *accessors;
    const gltf_mesh *meshes;
    const gltf_node *nodes;
    const gltf_material *materials;
    const gltf_texture *textures;
    const gltf_image *images;
    const gltf_camera *cameras;
    const gltf_light *lights;
    const char *const *extensions; /* used */
    const int *roots;              /* nodes of the scene that is shown */
    size_t buffer_count, view_count, accessor_count, mesh_count, node_count, material_count,
        texture_count, image_count, camera_count, light_count, extension_count, root_count;
    size_t animation_count;
} gltf_model;

/* Read a .glb file in memory; buffers and textures lie in `folder` ("" or with a slash at its end).
 * NULL: `message` says why. */
gltf_model *lobe_gltf_model_read(const unsigned char *glb, size_t size, const char *folder,
                                 char *message, size_t message_size);
void lobe_gltf_model_free(gltf_model *model); /* NULL is fine */

#ifdef __cplusplus
}
#endif

#endif
