/* app/info.c: `lobe info`: what is in a scene. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lobe/render.h>

#include "commands.h"
#include "interrupt.h"
#include "json.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "view.h"

typedef struct info_values {
    lobe_app_view view; /* of which the scene's options count */
    uint64_t most;
    int progress;
    bool json;
} info_values;

#define AT(member) offsetof(info_values, member)

static const lobe_app_option info_options[] = {
    {"--most", "N", "20", "items of a kind to print; --json has all", lobe_app_read_count, AT(most),
     NULL},
    {"--json", NULL, NULL, "all of it as JSON on standard output", NULL, AT(json), NULL},
    LOBE_APP_PROGRESS_OPTION(info_values, progress),
    {0}};

static const lobe_scene_part parts[] = {
    LOBE_SCENE_MESH,   LOBE_SCENE_MATERIAL,  LOBE_SCENE_TEXTURE,  LOBE_SCENE_LIGHT,
    LOBE_SCENE_CAMERA, LOBE_SCENE_ANIMATION, LOBE_SCENE_EXTENSION};
static const char *const titles[] = {"meshes",  "materials",  "textures",  "lights",
                                     "cameras", "animations", "extensions"};

enum { PARTS = sizeof parts / sizeof parts[0] };

/* ---- Text ------------------------------------------------------------------------------------ */

static void print_numbers(const lobe_scene *scene) {
    const lobe_scene_info i = lobe_scene_get_info(scene);
    const double mega = 1e-6;
    lobe_app_print("triangles   %llu in memory", (unsigned long long)i.triangles);
    if (i.instances)
        lobe_app_print(", %llu placed by %llu instances", (unsigned long long)i.placed_triangles,
                       (unsigned long long)i.instances);
    if (i.emissive_triangles)
        lobe_app_print(", %llu of them lights", (unsigned long long)i.emissive_triangles);
    if (i.dropped_triangles)
        lobe_app_print(", %llu left out", (unsigned long long)i.dropped_triangles);
    lobe_app_print("\nvertices    %llu\n", (unsigned long long)i.vertices);
    lobe_app_print("box         %.5g %.5g %.5g to %.5g %.5g %.5g\n", (double)i.low.x,
                   (double)i.low.y, (double)i.low.z, (double)i.high.x, (double)i.high.y,
                   (double)i.high.z);
    lobe_app_print(
        "memory      %.3g MB of geometry, %.3g MB of textures, %.3g MB of tree (%.3g MB while "
        "it was built)\n",
        mega * (double)i.geometry_bytes, mega * (double)i.texture_bytes,
        mega * (double)i.tree_bytes, mega * (double)i.tree_peak_bytes);
}

static void print_item(const lobe_scene_item *item) {
    lobe_app_print("  %s", item->name[0] ? item->name : "(no name)");
    if (item->part == LOBE_SCENE_MESH) {
        lobe_app_print(": %llu triangles, shown ", (unsigned long long)item->count);
        if (item->uses == 1)
            lobe_app_print("once");
        else
            lobe_app_print("%llu times", (unsigned long long)item->uses);
    }
    if (item->part == LOBE_SCENE_MATERIAL)
        lobe_app_print(": %llu triangles", (unsigned long long)item->count);
    if (item->part == LOBE_SCENE_TEXTURE) lobe_app_print(": %d x %d", item->width, item->height);
    if (item->part == LOBE_SCENE_ANIMATION)
        lobe_app_print(": %.4g s, %llu channels", item->seconds, (unsigned long long)item->count);
    const bool is_first = item->part == LOBE_SCENE_LIGHT || item->part == LOBE_SCENE_CAMERA ||
                          item->part == LOBE_SCENE_EXTENSION;
    if (item->about[0]) lobe_app_print("%s %s", is_first ? ":" : ",", item->about);
    lobe_app_print("\n");
}

static void print_part(const lobe_scene *scene, int part, uint64_t most) {
    uint64_t count = 0;
    const lobe_scene_item *item;
    for (size_t i = 0; (item = lobe_scene_get_item(scene, i)); i++)
        count += item->part == parts[part];
    lobe_app_print("%-12s%llu\n", titles[part], (unsigned long long)count);
    uint64_t printed = 0;
    for (size_t i = 0; (item = lobe_scene_get_item(scene, i)) && printed < most; i++) {
        if (item->part != parts[part]) continue;
        print_item(item);
        printed++;
    }
    if (printed < count) lobe_app_print("  and %llu more\n", (unsigned long long)(count - printed));
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static json_t *json_item(const lobe_scene_item *item) {
    json_t *object = json_pack("{so}", "name", lobe_app_json_text(item->name));
    if (item->about[0]) json_object_set_new(object, "about", lobe_app_json_text(item->about));
    if (item->part == LOBE_SCENE_MESH || item->part == LOBE_SCENE_MATERIAL)
        json_object_set_new(object, "triangles", json_integer((json_int_t)item->count));
    if (item->part == LOBE_SCENE_MESH)
        json_object_set_new(object, "uses", json_integer((json_int_t)item->uses));
    if (item->part == LOBE_SCENE_TEXTURE) {
        json_object_set_new(object, "width", json_integer(item->width));
        json_object_set_new(object, "height", json_integer(item->height));
    }
    if (item->part == LOBE_SCENE_ANIMATION) {
        json_object_set_new(object, "channels", json_integer((json_int_t)item->count));
        json_object_set_new(object, "seconds", lobe_app_json_number(item->seconds));
    }
    return object;
}

static json_t *json_vector(lobe_vec3_f32 v) {
    return json_pack("[ooo]", lobe_app_json_number((double)v.x), lobe_app_json_number((double)v.y),
                     lobe_app_json_number((double)v.z));
}

static json_t *json_numbers(const char *source, const lobe_scene_info *i) {
    return json_pack(
        "{so sI sI sI sI sI sI sI so so s{sI sI sI sI}}", "scene", lobe_app_json_text(source),
        "triangles", (json_int_t)i->triangles, "placed_triangles", (json_int_t)i->placed_triangles,
        "instances", (json_int_t)i->instances, "emissive_triangles",
        (json_int_t)i->emissive_triangles, "dropped_triangles", (json_int_t)i->dropped_triangles,
        "vertices", (json_int_t)i->vertices, "warnings", (json_int_t)i->warnings, "low",
        json_vector(i->low), "high", json_vector(i->high), "bytes", "geometry",
        (json_int_t)i->geometry_bytes, "textures", (json_int_t)i->texture_bytes, "tree",
        (json_int_t)i->tree_bytes, "tree_peak", (json_int_t)i->tree_peak_bytes);
}

static lobe_app_status print_json(const char *source, const lobe_scene *scene) {
    const lobe_scene_info info = lobe_scene_get_info(scene);
    json_t *object = json_numbers(source, &info);
    for (int part = 0; part < PARTS; part++) {
        json_t *list = json_array();
        const lobe_scene_item *item;
        for (size_t i = 0; (item = lobe_scene_get_item(scene, i)); i++)
            if (item->part == parts[part]) json_array_append_new(list, json_item(item));
        json_object_set_new(object, titles[part], list);
    }
    return lobe_app_print_json(object);
}

/* ---- The command ----------------------------------------------------------------------------- */

static lobe_app_status show(const info_values *v, const char *source) {
    lobe_scene *scene = NULL;
    const lobe_render_result result = lobe_app_load_scene(&v->view, v->progress, source, &scene);
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    lobe_app_status status = LOBE_APP_DONE;
    if (v->json) {
        status = print_json(source, scene);
    } else {
        print_numbers(scene);
        for (int part = 0; part < PARTS; part++) print_part(scene, part, v->most);
    }
    lobe_scene_free(scene);
    return status;
}

lobe_app_status lobe_app_info(int argc, char **argv) {
    info_values values = {.view = lobe_app_default_view(), .most = 20};
    const lobe_app_group groups[] = {
        {"Output", info_options, &values}, {"Scene", lobe_app_scene_options, &values.view}, {0}};
    const lobe_app_command command = {
        "info",
        "SCENE [OPTIONS]",
        "Prints what is in a scene: meshes, materials and what they use, textures, lights, "
        "cameras,\n"
        "animations, extensions read and ignored, and the memory that it takes. What is ignored is "
        "named\n"
        "on standard error.",
        "SCENE",
        groups,
        "lobe info model.glb --json"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if (!arguments.operand)
        return lobe_app_reject("info", "give a file or a name of lobe render --list-scenes",
                               "no scene");
    if ((status = lobe_app_check_view(&values.view))) return status;
    lobe_app_catch_interrupt();
    return show(&values, arguments.operand);
}
