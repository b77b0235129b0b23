/* lobe/render.h: a path tracer that shades with liblobe.
 *
 *     lobe_scene *scene = NULL;
 *     lobe_film *film = NULL;
 *     lobe_render_options options = lobe_render_default_options();
 *     options.samples = 64;
 *     options.reflection.model.method = LOBE_METHOD_BOUNDED;
 *     if (lobe_scene_load("gallery", lobe_scene_default_options(), &scene) != LOBE_RENDER_OK ||
 *         lobe_render(scene, options, &film, NULL) != LOBE_RENDER_OK ||
 *         lobe_film_write(film, "gallery.png", lobe_film_default_write_options()) != LOBE_RENDER_OK)
 *         fprintf(stderr, "lobe: %s\n", lobe_render_error_message());
 *     lobe_film_free(film);
 *     lobe_scene_free(scene);
 *
 * World: right-handed, Y up, as in glTF. Colours are linear, with the primaries of sRGB.
 * Environment: direction d lies at u = 1/2 + atan2(d.z, d.x)/(2 pi), v = acos(d.y)/pi from the top
 * row, texels centred.
 * Materials are those of glTF 2.0: a metal is GGX with Schlick's Fresnel (f0 = base colour; or another law:
 * lobe_metal), a dielectric is a GGX coat (of index 1.5 where the file has none) over a diffuse base, `metallic` blends the two. The base
 * receives what the coat lets through: a white dielectric reflects all light and never more, at any
 * roughness, angle and anisotropy (0.99 to 1.001; from 0.985 at an anisotropy of 0.6, from 0.95 at
 * 0.95). Every opaque surface is two-sided.
 * What transmits is a share of the surface (glTF's transmission factor): a rough dielectric
 * (lobe/dielectric.h) with the index of the file. With a thickness it is the boundary of a solid, whose
 * outside is where the triangles face: light is refracted, and absorbed inside (Beer's law); solids do
 * not nest: leaving one means air. Without, it is a thin wall: what its facets do not reflect, of all
 * orders between two interfaces, goes on as if it was reflected, to the other side. The base colour
 * tints what is transmitted, each time. Such a surface throws the shadow of an opaque one on what is lit by
 * a lamp that is drawn; its light and its caustics are found by the paths, without bias.
 * Of glTF 2.0 are read: meshes of triangles in any form, instances, two of the sets of texture
 * coordinates per material, vertex colours, alpha masks, alpha blending (as the probability that light
 * is stopped), cameras, and the extensions KHR_draco_mesh_compression, EXT_meshopt_compression,
 * KHR_mesh_quantization, KHR_texture_transform, KHR_lights_punctual, KHR_materials_anisotropy,
 * KHR_materials_emissive_strength, KHR_materials_transmission, KHR_materials_ior,
 * KHR_materials_volume (of thickness only whether it is 0), KHR_materials_unlit (emits its base colour). One candela, lux or
 * nit of a file is one unit of intensity, irradiance or radiance here. Nodes, morph targets and skins stand where an
 * animation has them at lobe_scene_options.frame_time. A mesh that many nodes or EXT_mesh_gpu_instancing place is in
 * memory once, unless all of its copies are small. Not read, with a warning: points, lines, other extensions; a
 * file that requires one of those is refused.
 * Not promised: the bits of a picture from version to version or between processors of different
 * instruction sets (Embree picks its code by the processor). On one machine the same scene, options
 * and seed give the same bits on any number of threads and processes, in parts and after any interruption.
 *
 * Any function may be called from any thread; one scene may be rendered by several threads at once.
 * A film is used by one thread at a time. */
#ifndef LOBE_RENDER_H
#define LOBE_RENDER_H

#include <signal.h>
#include <stddef.h>

#include "metrics.h"
#include "reflection.h"
#include "types.h"

LOBE_BEGIN_C

/* ---- Results --------------------------------------------------------------------------------- */

typedef enum lobe_render_result {
    LOBE_RENDER_OK,
    LOBE_RENDER_INTERRUPTED, /* stopped by `cancel`; the film holds what was finished */
    LOBE_RENDER_BAD_INPUT,   /* a file, name or option is unusable: exit status 2 */
    LOBE_RENDER_FAILED       /* memory, device, output file: exit status 1 */
} lobe_render_result;

/* Why the last call of this thread did not return LOBE_RENDER_OK: one line "WHERE: WHAT; HINT",
 * without a line end. Valid until the next call of this thread; "" if there was no error yet. */
LOBE_API const char *lobe_render_error_message(void);

/* Receives one line "WHERE: WHAT; HINT" for everything that was read, but not as the file meant it. */
typedef void (*lobe_warning_function)(void *user, const char *message);

/* ---- Scenes ---------------------------------------------------------------------------------- */

typedef struct lobe_scene lobe_scene;

/* The scenes that need no file. An index out of range gives NULL. */
LOBE_API size_t lobe_builtin_scene_count(void);
LOBE_API const char *lobe_builtin_scene_name(size_t index);
LOBE_API const char *lobe_builtin_scene_about(size_t index);

/* Told now and then, by one thread at a time, how much of the tree that rays go through is built, in [0, 1]. */
typedef void (*lobe_build_function)(void *user, double fraction);

typedef struct lobe_scene_options {
    const char *environment;    /* panorama to light with (.exr, .hdr, .png, …); NULL: the scene's
                                      own light, and a sky where a file brings none */
    float environment_rotation; /* degrees about +Y, counter-clockwise from above; default 0 */
    int strict;                 /* 1: a missing texture or another warning is an error; default 0 */
    int ground;                 /* 1: put a large matte floor below a file's scene; default 0 */
    float default_base_color[3]; /* material of meshes that bring none: linear, [0, 1]; 0.8 */
    float default_metallic;      /* [0, 1]; default 0 */
    float default_roughness;     /* perceptual, [0, 1]; alpha is its square; default 0.5 */
    double frame_time; /* moment of an animation to show, in seconds; before its first key and after
                          its last one their values hold. NaN, the default: none, nodes rest */
    const char
        *animation; /* its name, or "all" for all, later ones over earlier ones; NULL: the first */
    lobe_warning_function warning; /* NULL: warnings are dropped */
    void *warning_user;
    lobe_build_function progress; /* NULL: none */
    void *progress_user;
    const volatile sig_atomic_t
        *cancel; /* not NULL: the tree is given up soon after *cancel != 0 */
} lobe_scene_options;

LOBE_API lobe_scene_options lobe_scene_default_options(void);

/* Read a built-in scene by name, or a file (glTF 2.0 .gltf/.glb, OBJ, and what else the importer
 * reads). An existing file wins over a built-in of the same name. On success *scene is to be freed by
 * lobe_scene_free; otherwise it is NULL. */
LOBE_API lobe_render_result lobe_scene_load(const char *source, lobe_scene_options options,
                                            lobe_scene **scene);
LOBE_API void lobe_scene_free(lobe_scene *scene); /* NULL is fine */

typedef struct lobe_scene_info {
    uint64_t triangles;         /* in memory */
    uint64_t placed_triangles;  /* in the scene: those of instances once for each */
    uint64_t instances;         /* of meshes that are in memory once */
    uint64_t dropped_triangles; /* of zero area or with a coordinate that is not finite */
    uint64_t emissive_triangles;
    uint64_t vertices;
    uint64_t materials;
    uint64_t textures;
    uint64_t missing_textures; /* shown in magenta */
    uint64_t cameras;          /* in the file; 0: framed automatically */
    uint64_t warnings;
    uint64_t geometry_bytes, texture_bytes;
    uint64_t tree_bytes, tree_peak_bytes; /* of Embree, now and while it was built */
    uint64_t lamps;                       /* lights without extent */
    lobe_vec3_f32 low, high; /* a box around all triangles; that of instances is not the smallest */
} lobe_scene_info;

LOBE_API lobe_scene_info lobe_scene_get_info(const lobe_scene *scene);

/* What a scene is made of, one after the other. */
typedef enum lobe_scene_part {
    LOBE_SCENE_MESH,      /* count: triangles; uses: how often the scene shows it */
    LOBE_SCENE_MATERIAL,  /* count: triangles in memory that have it; about: what it uses */
    LOBE_SCENE_TEXTURE,   /* name: of the file or the picture; width, height */
    LOBE_SCENE_LIGHT,     /* without extent; about: its kind */
    LOBE_SCENE_CAMERA,    /* about: its angle */
    LOBE_SCENE_ANIMATION, /* count: channels; seconds: its last key; about: what it moves, and how */
    LOBE_SCENE_EXTENSION  /* of glTF; about: "read" or "ignored", and "required" */
} lobe_scene_part;

typedef struct lobe_scene_item {
    lobe_scene_part part;
    const char *name;  /* in the file; "": it has none */
    const char *about; /* words with ", " between; may be "" */
    uint64_t count, uses;
    int width, height;
    double seconds;
} lobe_scene_item;

LOBE_API size_t lobe_scene_item_count(const lobe_scene *scene);
LOBE_API const lobe_scene_item *lobe_scene_get_item(const lobe_scene *scene,
                                                    size_t index); /* out of range: NULL */
LOBE_API const char *lobe_scene_part_name(lobe_scene_part part);   /* "mesh", …; NULL: none */

/* Names of the cameras that the file brings; an index out of range gives NULL. */
LOBE_API const char *lobe_scene_camera_name(const lobe_scene *scene, size_t index);

/* Where a picture is seen from. */
typedef struct lobe_view {
    lobe_vec3_f32 position, target, up; /* up: not along the view */
    float vertical_degrees;             /* from the lower edge to the upper one, in (0, 180) */
} lobe_view;

/* A camera of the scene; NULL: its first. Of a scene without one, the whole of it: in a picture of width/height `aspect`, as
 * large as fits into a square of its shorter side. LOBE_RENDER_BAD_INPUT: no such name. */
LOBE_API lobe_render_result lobe_scene_view(const lobe_scene *scene, const char *camera,
                                            float aspect, lobe_view *view);

/* View `index` of `count` of a turntable: the camera is turned about +Y around the middle of the scene's box, index/count
 * of a full turn, counter-clockwise from above. View 0 is that of the camera, to the bit; but a scene without one is seen from
 * farther away than in a single picture, so that every side of it fits. */
LOBE_API lobe_render_result lobe_scene_orbit(const lobe_scene *scene, const char *camera,
                                             float aspect, int index, int count, lobe_view *view);

/* How far away is what the middle of the picture shows; 0: nothing is there. */
LOBE_API float lobe_scene_focus(const lobe_scene *scene, const lobe_view *view);

/* Radius of the lens, in metres, of a camera whose picture is 24 mm high. */
LOBE_API float lobe_lens_radius(float f_number, float vertical_degrees);

/* ---- Extra channels -------------------------------------------------------------------------- */

/* X(IDENTIFIER, "name", channels, "what it is"), all averaged over the samples of a pixel. */
#define LOBE_AOVS(X)                                                                               \
    X(ALBEDO, "albedo", 3, "base colour at the first hit")                                         \
    X(NORMAL, "normal", 3, "shading normal at the first hit, world space, [-1, 1]")                \
    X(DEPTH, "depth", 1, "distance from the camera to the first hit; 0 where there is none")       \
    X(REJECTED, "rejected", 1, "share of GGX draws on the pixel's paths that were rejected")       \
    X(VNDF_INTEGRAL, "vndf-integral", 1,                                                           \
      "integral of the visible normals' density at the first hit (lobe/reflection.h); 1 if none")  \
    X(MOTION, "motion", 2,                                                                         \
      "how far the first hit has moved in the picture since the frame before, in widths to the "   \
      "right and heights down; (2, 0): it was behind the camera")

typedef enum lobe_aov {
#define LOBE_AOV_ENUMERATOR(ID, name, channels, about) LOBE_AOV_##ID,
    LOBE_AOVS(LOBE_AOV_ENUMERATOR)
#undef LOBE_AOV_ENUMERATOR
        LOBE_AOV_COUNT
} lobe_aov;

#define LOBE_AOV_BIT(aov) (1u << (aov))

LOBE_API lobe_aov lobe_aov_from_name(const char *name); /* unknown: LOBE_AOV_COUNT */
LOBE_API const char *lobe_aov_name(lobe_aov aov);       /* out of range: NULL */
LOBE_API const char *lobe_aov_about(lobe_aov aov);
LOBE_API int lobe_aov_channels(lobe_aov aov);

/* ---- Rendering ------------------------------------------------------------------------------- */

/* How light that both a surface and a lamp could have sampled is weighed (Veach & Guibas 1995). The
 * last two switch one of the two off; they are noisy, and there to check the others. */
typedef enum lobe_heuristic {
    LOBE_HEURISTIC_BALANCE,
    LOBE_HEURISTIC_POWER,
    LOBE_HEURISTIC_BSDF_ONLY, /* misses lamps without extent */
    LOBE_HEURISTIC_LIGHT_ONLY /* mirrors still see the lamps */
} lobe_heuristic;

LOBE_API lobe_heuristic lobe_heuristic_from_name(const char *name, int *known);
LOBE_API const char *lobe_heuristic_name(lobe_heuristic heuristic); /* "balance", "power", … */

typedef struct lobe_render_progress {
    double fraction;        /* of the whole work, [0, 1] */
    double seconds;         /* since the start */
    double seconds_left;    /* estimated; negative: not known yet */
    uint64_t samples;       /* camera paths so far */
    uint32_t pixel_samples; /* whole passes over the image so far, in samples a pixel */
} lobe_render_progress;

/* Called by the thread that called lobe_render, a few times a second. */
typedef void (*lobe_progress_function)(void *user, const lobe_render_progress *progress);

/* What metals scatter more than once: left out, a second lobe (Kulla & Conty 2017), a factor (Turquin 2019):
 * lobe/albedo.h; or all of it, without bias, by random walks (Heitz et al. 2016): lobe/walk.h. Glass has
 * neither a second lobe nor walks: it is left out, or a factor, with any of them. */
typedef enum lobe_multiscatter {
    LOBE_MULTISCATTER_NONE,
    LOBE_MULTISCATTER_KULLA_CONTY,
    LOBE_MULTISCATTER_TURQUIN,
    LOBE_MULTISCATTER_WALK
} lobe_multiscatter;

/* What the facets of metals reflect, for all metals of the scene: Schlick's F or that with the F82 tint
 * (lobe/fresnel.h), both of the base colour straight ahead; or the exact F of a conductor, which takes the place
 * of the base colour and its texture where a surface is metal. Of a partly metallic surface it is so for that part;
 * the base below the coat keeps its colour. */
typedef enum lobe_metal_law {
    LOBE_METAL_SCHLICK,
    LOBE_METAL_F82,
    LOBE_METAL_CONDUCTOR
} lobe_metal_law;

#define LOBE_METAL_N_MIN 1e-3f
#define LOBE_METAL_INDEX_MAX 1e3f

/* By channel: red, green, blue. Only what the law takes is read. */
typedef struct lobe_metal {
    lobe_metal_law law;
    float tint[3]; /* F82, [0, 1] */
    float n[3];    /* conductor, LOBE_METAL_N_MIN to LOBE_METAL_INDEX_MAX */
    float k[3];    /* conductor, 0 to LOBE_METAL_INDEX_MAX */
} lobe_metal;

/* Conductors of measured indices at 650, 550 and 450 nm: "gold", "copper", … (render/metal_names.c names the
 * sources). 0: there is none of this name. An index out of range gives NULL. */
LOBE_API int lobe_metal_from_name(const char *name, lobe_metal *metal);
LOBE_API const char *lobe_metal_name(size_t index);

/* reflection.model.method may be LOBE_METHOD_COUNT, the default: by surface. Of Smith-GGX dielectrics and metals
 * of an alpha below 0.1 then take bounded caps and other metals horizon sampling, uniform where the shading
 * normal is tilted by 10 degrees or more; any other distribution takes its best method. */
/* How a lamp or an emissive triangle is chosen to light a place. */
typedef enum lobe_light_choice {
    LOBE_LIGHTS_AUTOMATIC, /* by power where there are at most 15, else by the tree */
    LOBE_LIGHTS_POWER,
    LOBE_LIGHTS_TREE /* by what they may send to the place: their power, distance and direction */
} lobe_light_choice;

/* "auto", "power", "tree"; NULL out of range. */
LOBE_API const char *lobe_light_choice_name(lobe_light_choice choice);

typedef struct lobe_render_options {
    lobe_reflection_options reflection; /* default Smith-GGX by LOBE_METHOD_COUNT; floor 0.25 */
    lobe_multiscatter multiscatter;     /* WALK: Smith, correlated only; default NONE */
    lobe_metal metal;                   /* default LOBE_METAL_SCHLICK */
    int width, height;                  /* pixels, 1 to LOBE_RENDER_SIZE_MAX; default 960 x 540 */
    uint32_t samples;   /* camera paths a pixel, 1 to LOBE_RENDER_SAMPLES_MAX; default 64 */
    int depth;          /* greatest number of surface scatterings on a path, 0 to 1000000; 8 */
    int roulette_depth; /* Russian roulette after so many scatterings; default 5 */
    uint64_t seed;      /* default 0 */
    int threads;        /* 0: as many as OpenMP offers; default 0 */
    double time_limit;  /* seconds, then stop with what is finished; 0: none; default 0 */
    const char *camera; /* name of a camera of the file; NULL: its first, else framed */

    /* Where to look from, in place of `camera`; NULL, the default: none. */
    const lobe_view *view;
    /* Where the frame before was seen from, for LOBE_AOV_MOTION; NULL, the default: from the same place. */
    const lobe_view *previous_view;
    /* Radius of a thin lens, in the scene's unit, at most 1e15; 0, the default: a pinhole, all is sharp. */
    float aperture;
    /* Not 0: the aperture is lobe_lens_radius of it, a unit being a metre; 0.001 to 1e15; default 0. */
    float f_number;
    /* Where the picture of a lens is sharp: distance of a plane across the view, 1e-15 to 1e15; 0, the default:
     * lobe_scene_focus of the view, and LOBE_RENDER_BAD_INPUT if nothing is there. */
    float focus;

    /* Over how much of a pixel textures are averaged, as a width: 1 is all of it, 0 takes texels as they are; at most 1000.
     * Negative, the default: 1 / sqrt(samples), at least 1/8, so that more samples make a sharper picture. */
    float footprint;

    lobe_light_choice light_choice; /* default LOBE_LIGHTS_AUTOMATIC */
    lobe_heuristic heuristic;       /* default LOBE_HEURISTIC_BALANCE */
    uint32_t aovs;                  /* LOBE_AOV_BIT(…) of the extra channels to keep; default 0 */
    lobe_progress_function progress; /* NULL: none */
    void *progress_user;
    const volatile sig_atomic_t *cancel; /* not NULL: rendering ends soon after *cancel != 0 */
    const char
        *checkpoint; /* file that keeps what is finished, written now and then and at the end;
                                  NULL: none */
    double checkpoint_seconds; /* from one to the next; default 60 */
    const char *resume; /* go on from this checkpoint, which is of the same scene, options and seed:
                                  the bits are those of a render that was not interrupted. If it does not exist
                                  and is `checkpoint` too, start. NULL: start */
    double noise; /* stop at the end of a pass when lobe_render_statistics.noise is at most this;
                                  0: never; default 0 */
    /* 1: `samples`, at least 64, are a mean over the picture, and more of them go where noise is; the expectation of
     * every pixel stays what it is. Needs all parts. A pixel's own number is known only in the end. Default 0. */
    int is_adaptive;
    uint32_t part,
        parts; /* render tiles part, part + parts, … only, for lobe_film_merge; default 1, 1 */
    lobe_warning_function
        warning; /* a checkpoint could not be written: rendering goes on; NULL: dropped */
    void *warning_user;
} lobe_render_options;

#define LOBE_RENDER_SIZE_MAX 32768
#define LOBE_RENDER_SAMPLES_MAX 16777216

LOBE_API lobe_render_options lobe_render_default_options(void);

/* "bounded"; "by surface" for LOBE_METHOD_COUNT; NULL out of range. */
LOBE_API const char *lobe_render_method_name(lobe_method method);

typedef struct lobe_render_statistics {
    uint64_t samples;         /* camera paths finished */
    uint64_t dropped_samples; /* of them not finite, not in the film: a defect if not 0 */
    uint64_t rays;            /* camera, bounce and shadow rays */
    uint64_t ggx_draws;
    uint64_t ggx_rejected;  /* of them below the shading or the geometric surface */
    double rejected_share;  /* ggx_rejected / ggx_draws */
    double seconds;         /* of the wall clock, those before a checkpoint included */
    double cpu_seconds;     /* of all threads together; likewise */
    uint32_t pixel_samples; /* fewest samples of any pixel */
    int threads;            /* used */
    /* Relative standard error, estimated: the root of the mean over the pixels of s^2/(m^2 + 0.01), m the mean of a
     * pixel's luminance, s its standard error, told from two halves of the samples. NaN below 32 samples. */
    double noise;
    int has_failed_to_save; /* 1: the last checkpoint could not be written */
} lobe_render_statistics;

typedef struct lobe_film lobe_film;

/* Whether `path` is an .exr that can be read whole and holds this picture of `scene` to its last sample, written at that
 * exposure. Where `noise` or `time_limit` ended it before, it is not: an .exr cannot tell that the end was reached.
 * LOBE_RENDER_BAD_INPUT: it is a picture of another scene, or of other options. Under mpirun all processes call it. */
LOBE_API lobe_render_result lobe_render_find_finished(const lobe_scene *scene,
                                                      lobe_render_options options, const char *path,
                                                      float exposure, int *is_finished);

/* Render `scene`. *film is to be freed by lobe_film_free after LOBE_RENDER_OK (also when the time
 * limit came first: statistics->pixel_samples tells) and after LOBE_RENDER_INTERRUPTED; otherwise it
 * is NULL. Pixels that got fewer samples than others are averaged over those they got.
 * `statistics` may be NULL. */
LOBE_API lobe_render_result lobe_render(const lobe_scene *scene, lobe_render_options options,
                                        lobe_film **film, lobe_render_statistics *statistics);

/* ---- Many processes -------------------------------------------------------------------------- */

/* The name of the MPI library, as "Open MPI v4.1.4"; NULL: built without. */
LOBE_API const char *lobe_ranks_library(void);

/* Under mpirun: join the other processes. From then on all of them have to call lobe_render with the same arguments;
 * rank 0 gets the film, the others NULL with LOBE_RENDER_OK. Otherwise nothing happens, and *rank is 0. Only the main
 * thread may call this and lobe_render. */
LOBE_API lobe_render_result lobe_ranks_join(int *rank);

/* LOBE_RENDER_OK if all ranks say so; otherwise all get the result and the message of the first that does not. */
LOBE_API lobe_render_result lobe_ranks_agree(lobe_render_result result);

/* The end. Not after an interrupt: the others may be gone. */
LOBE_API void lobe_ranks_leave(void);

/* ---- Films ----------------------------------------------------------------------------------- */

LOBE_API void lobe_film_free(lobe_film *film); /* NULL is fine */
LOBE_API int lobe_film_width(const lobe_film *film);
LOBE_API int lobe_film_height(const lobe_film *film);

typedef struct lobe_film_samples {
    uint32_t fewest, most; /* of any pixel */
    uint32_t seeds;        /* how many were joined; 0: not known */
} lobe_film_samples;

LOBE_API lobe_film_samples lobe_film_get_samples(const lobe_film *film);

/* Copy the means, rows from the top: width * height * 3 floats, or * lobe_aov_channels(aov). 0 if the
 * film does not hold this channel, otherwise 1. */
LOBE_API int lobe_film_copy_rgb(const lobe_film *film, float *rgb);
LOBE_API int lobe_film_copy_aov(const lobe_film *film, lobe_aov aov, float *values);

typedef enum lobe_film_pixels { LOBE_FILM_HALF, LOBE_FILM_FLOAT } lobe_film_pixels;

typedef enum lobe_film_compression {
    LOBE_FILM_COMPRESSION_NONE,
    LOBE_FILM_COMPRESSION_RLE,
    LOBE_FILM_COMPRESSION_ZIPS,
    LOBE_FILM_COMPRESSION_ZIP,
    LOBE_FILM_COMPRESSION_PIZ
} lobe_film_compression;

typedef struct lobe_film_write_options {
    float exposure;                    /* stops, for every format; default 0 */
    lobe_film_pixels pixels;           /* .exr only; default half */
    lobe_film_compression compression; /* .exr only; default ZIP */
    int durable; /* 1: on the disk before it has its name, as what may be all that is left; default 0 */
    int keep_seconds; /* .exr only: 1: write the time as an attribute, no two files are equal then; default 0 */
} lobe_film_write_options;

LOBE_API lobe_film_write_options lobe_film_default_write_options(void);

/* Most pixels of a .png. */
#define LOBE_FILM_PNG_PIXELS_MAX (256 * 1024 * 1024)

/* 1 if a film can be written under such a name: .exr, .png, .hdr or .pfm (any case). Ask before a
 * long render. */
LOBE_API int lobe_film_can_write(const char *path);

/* Write the film in the format of the file's ending, beside the final name, and rename it. .exr holds
 * the extra channels as layers ("albedo.R", …, "depth.Z", "rejected.Y",
 * "vndf-integral.Y", "motion.X"), "samples.Y" where not all pixels have the same number, and scene, method, samples,
 * seed, version and options as attributes; .png is sRGB, 8 bit, dithered. */
LOBE_API lobe_render_result lobe_film_write(const lobe_film *film, const char *path,
                                            lobe_film_write_options options);

/* A film of width * height * 3 floats, rows from the top. To be freed by lobe_film_free. */
LOBE_API lobe_render_result lobe_film_from_rgb(const float *rgb, int width, int height,
                                               lobe_film **film);

/* Join pictures of one scene and the same options: checkpoints, or .exr of lobe_render. Those of different seeds are
 * averaged by the numbers of their samples; of one seed only parts, which share no pixel, go together: then the film has
 * the bits of the whole render. The order of the paths does not matter. To be freed by lobe_film_free. */
LOBE_API lobe_render_result lobe_film_merge(const char *const *paths, size_t count,
                                            lobe_film **film);

/* Write all that a film holds, as a checkpoint. */
LOBE_API lobe_render_result lobe_film_save(const lobe_film *film, const char *path);

/* Read .exr, .hdr, .pfm or 8-bit pictures as sRGB (colour only) to compare with; refused if a value is not
 * finite. To be freed by lobe_film_free. */
LOBE_API lobe_render_result lobe_film_read(const char *path, lobe_film **film);

/* Difference of `film` from `reference`; LOBE_RENDER_BAD_INPUT if their sizes differ. */
LOBE_API lobe_render_result lobe_film_compare(const lobe_film *film, const lobe_film *reference,
                                              lobe_picture_difference *difference);

LOBE_END_C

#endif
