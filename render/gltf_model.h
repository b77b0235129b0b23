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

enum { GLTF_MATRIX = 16 };

typedef struct gltf_accessor {
    int view, component; /* 5120 … 5126 */
    int channels;        /* 1 to 4, GLTF_MATRIX: 4 x 4 by columns; 0: none of these */
    size_t offset, count;
    int is_normalized, is_sparse;
    double greatest; /* of the first channel, as the file says; 0: it does not */
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
    GLTF_JOINTS = GLTF_TEXCOORD + GLTF_TEXCOORD_SETS,
    GLTF_JOINT_SETS = 2, /* of four joints each */
    GLTF_WEIGHTS = GLTF_JOINTS + GLTF_JOINT_SETS,
    GLTF_SEMANTICS = GLTF_WEIGHTS + GLTF_JOINT_SETS
};

/* A morph target: accessors of what is added to GLTF_POSITION, GLTF_NORMAL, GLTF_TANGENT. */
enum { GLTF_MORPHED = GLTF_TANGENT + 1 };
typedef struct gltf_target {
    int accessors[GLTF_MORPHED];
} gltf_target;

typedef struct gltf_primitive {
    int accessors[GLTF_SEMANTICS];
    int indices, material, mode;
    int draco_view;
    int draco_ids[GLTF_SEMANTICS];
    const gltf_target *targets;
    size_t target_count;
    int has_more; /* joints, colours or morphed attributes beyond those above */
} gltf_primitive;

typedef struct gltf_mesh {
    const char *name;
    const gltf_primitive *primitives;
    size_t primitive_count;
    const double *weights; /* of the morph targets */
    size_t weight_count;
} gltf_mesh;

typedef struct gltf_skin {
    int inverse_bind;  /* accessor of matrices */
    const int *joints; /* nodes */
    size_t joint_count;
} gltf_skin;

typedef enum gltf_path {
    GLTF_TRANSLATION,
    GLTF_ROTATION,
    GLTF_SCALE,
    GLTF_MORPH,
    GLTF_NO_PATH
} gltf_path;
typedef enum gltf_interpolation { GLTF_STEP, GLTF_LINEAR, GLTF_CUBIC } gltf_interpolation;

typedef struct gltf_channel {
    int node, input, output; /* input, output: accessors */
    gltf_path path;
    gltf_interpolation interpolation;
} gltf_channel;

typedef struct gltf_animation {
    const char *name;
    const gltf_channel *channels;
    size_t channel_count;
} gltf_animation;

typedef struct gltf_node {
    const char *name;
    int mesh, camera, skin, light;
    int is_instanced, instances[3]; /* EXT_mesh_gpu_instancing: accessors by gltf_path */
    const int *children;
    size_t child_count;
    int has_matrix;
    double matrix[16]; /* by columns */
    double translation[3], rotation[4], scale[3];
    const double *weights;
    size_t weight_count; /* 0: those of the mesh */
} gltf_node;

typedef struct gltf_texture_use {
    int texture, uv_set;
    double offset[2], rotation, scale[2];
} gltf_texture_use;

typedef enum gltf_alpha { GLTF_OPAQUE, GLTF_MASK, GLTF_BLEND } gltf_alpha;

typedef struct gltf_material {
    const char *name;
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

enum { GLTF_REPEAT = 10497, GLTF_MIRROR = 33648, GLTF_CLAMP = 33071 };

enum {
    GLTF_NEAREST = 9728,
    GLTF_BILINEAR,
    GLTF_NEAREST_MIPMAP_NEAREST = 9984,
    GLTF_LINEAR_MIPMAP_NEAREST,
    GLTF_NEAREST_MIPMAP_LINEAR
};

typedef struct gltf_texture {
    int image, wrap_u, wrap_v, filter, small_filter;
} gltf_texture;

typedef struct gltf_image {
    const char *name;
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
    const char *name;
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
    const gltf_skin *skins;
    const gltf_animation *animations;
    const char *const *extensions, *const *required; /* extensions used, and those that must be */
    const int *roots;                                /* nodes of the scene that is shown */
    size_t buffer_count, view_count, accessor_count, mesh_count, node_count, material_count,
        texture_count, image_count, camera_count, light_count, skin_count, animation_count,
        extension_count, required_count, root_count;
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
