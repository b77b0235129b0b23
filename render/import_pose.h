/* Nodes of a file that Assimp reads: upright, in metres, where they are at a moment. */
#ifndef LOBE_RENDER_IMPORT_POSE_H
#define LOBE_RENDER_IMPORT_POSE_H

#include "scene.h"

struct aiMatrix4x4;
struct aiNode;
struct aiScene;

/* To be called before anything asks where a node is. BAD_INPUT: there is no animation of the name that is asked for. */
lobe_render_result lobe_import_pose(lobe_scene *s, struct aiScene *file, const char *path,
                                    const lobe_scene_options *options);

/* The node called `name`, at `node` or below, or NULL. `to_world` may be NULL; if there is one, it is that of the parent of
 * `node`, and becomes that of the node. */
struct aiNode *lobe_import_find_node(struct aiNode *node, const char *name,
                                     struct aiMatrix4x4 *to_world);

#endif
