#!/usr/bin/env python3
"""gbuffer_blender.py FILE.blend -o DIR [--frames N] [--samples N]
    blender -b FILE.blend -P gbuffer_blender.py -- -o DIR

Writes frames of a Blender scene (Cycles) as docs/gbuffer.md has them, for `lobe ssr DIR -o OUT`: the scene's own
frames from its first on, through its camera. Runs inside Blender, or with `pip install bpy`.

Each frame is rendered twice: once with one sample at the centre of each pixel for depth, normal, motion, and shader
AOVs of roughness and reflectance (of Principled BSDFs; other surfaces count as rough and dark), once as it is for the
colour. Blender has z up; the folder has y up, as glTF: (x, y, z) becomes (x, z, -y).
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gbuffer_files import Folder, camera, read_exr  # noqa: E402


def y_up(v):
    return (v[0], v[2], -v[1])


def add_aov(layer, name, kind):
    if name not in layer.aovs:
        aov = layer.aovs.add()
        aov.name, aov.type = name, kind


def wire(tree, output, socket, value):
    """`value` is a socket of the tree or a constant."""
    if isinstance(value, bpy.types.NodeSocket):
        if value.is_linked:
            tree.links.new(value.links[0].from_socket, output.inputs[socket])
        else:
            wire(tree, output, socket, value.default_value)
    elif socket == "Color":
        output.inputs[socket].default_value = (*list(value)[:3], 1.0)
    else:
        output.inputs[socket].default_value = value


def output_of(tree, name):
    node = tree.nodes.new("ShaderNodeOutputAOV")
    node.aov_name = name
    return node


def expose_material(material):
    """Shader AOVs of what lobe needs: roughness, and metallic and base colour, from which f0 follows."""
    tree = material.node_tree
    shader = next((n for n in tree.nodes if n.type == "BSDF_PRINCIPLED"), None) if tree else None
    if not shader:
        return
    wire(tree, output_of(tree, "roughness"), "Value", shader.inputs["Roughness"])
    wire(tree, output_of(tree, "metallic"), "Value", shader.inputs["Metallic"])
    wire(tree, output_of(tree, "index"), "Value", shader.inputs["IOR"])
    wire(tree, output_of(tree, "base"), "Color", shader.inputs["Base Color"])


def prepare(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.render.use_motion_blur = False
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):  # since 5.0
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "NONE"
    if hasattr(settings, "use_exr_interleave"):  # since 5.0: all passes in one part
        settings.use_exr_interleave = True
    layer = scene.view_layers[0]
    layer.use_pass_combined = layer.use_pass_z = layer.use_pass_normal = layer.use_pass_vector = True
    for name, kind in (("roughness", "VALUE"), ("metallic", "VALUE"), ("index", "VALUE"), ("base", "COLOR")):
        add_aov(layer, name, kind)
    for material in bpy.data.materials:
        expose_material(material)
    for other in scene.view_layers[1:]:
        other.use = False


def render(scene, folder):
    """Channels by their last two names: "Depth.V" of "ViewLayer.Depth.V"."""
    scene.render.filepath = str(Path(folder) / "frame.exr")
    scene.render.use_file_extension = False
    bpy.ops.render.render(write_still=True)
    return {".".join(name.split(".")[-2:]): plane for name, plane in read_exr(scene.render.filepath).items()}


class Changed:
    """Settings of an object for a while."""

    def __init__(self, holder, **values):
        self.holder, self.values = holder, values

    def __enter__(self):
        self.before = {name: getattr(self.holder, name) for name in self.values}
        for name, value in self.values.items():
            setattr(self.holder, name, value)

    def __exit__(self, *_):
        for name, value in self.before.items():
            setattr(self.holder, name, value)


def passes(scene, folder):
    """One sample at the centre of each pixel."""
    with Changed(scene.cycles, samples=1, use_adaptive_sampling=False, use_denoising=False,
                 pixel_filter_type="BOX", filter_width=0.01):
        return render(scene, folder)


def view_of(scene, width, height):
    lens = scene.camera.data
    if lens.type != "PERSP" or lens.shift_x or lens.shift_y:
        raise SystemExit("gbuffer_blender: only perspective cameras without shift can be exported")
    if width * scene.render.pixel_aspect_x != height * scene.render.pixel_aspect_y * width / height:
        raise SystemExit("gbuffer_blender: pixels that are not square cannot be exported")
    wide = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and width >= height)
    sensor = lens.sensor_height if lens.sensor_fit == "VERTICAL" else lens.sensor_width
    tangent = sensor / (2 * lens.lens)
    tangents = (tangent, tangent * height / width) if wide else (tangent * width / height, tangent)
    m = scene.camera.matrix_world.normalized()
    column = [y_up([m[row][k] for row in range(3)]) for k in range(4)]
    return camera(column[0], column[1], [-c for c in column[2]], column[3], tangents, lens.clip_start, lens.clip_end)


def planes_of(found, color, is_first, far):
    depth = found.get("Depth.V", found.get("Depth.Z"))
    height, width = depth.shape
    hit = depth < far
    metallic, base = found["metallic.V"] if "metallic.V" in found else found["metallic.X"], [
        found[f"base.{c}"] for c in "RGB"]
    roughness = found.get("roughness.V", found.get("roughness.X"))
    index = found.get("index.V", found.get("index.X"))
    step = np.where(index > 0, ((index - 1) / (index + 1)) ** 2, 0)
    planes = {"Z": np.where(hit, depth, 0),
              # without a Principled BSDF all AOVs are 0
              "roughness": np.where(hit, np.where(index > 0, roughness, 1), 0),
              "N.X": found["Normal.X"], "N.Y": found["Normal.Z"], "N.Z": -found["Normal.Y"]}
    planes |= {f"f0.{c}": np.where(hit, step + (b - step) * metallic, 0) for c, b in zip("RGB", base)}
    planes |= {c: color[f"Combined.{c}"] for c in "RGB"}
    # Blender: pixels, y up, before minus now. The first frame has no other before it.
    scale = 0 if is_first else 1
    planes["motion.X"] = -scale * found["Vector.X"] / width
    planes["motion.Y"] = scale * found["Vector.Y"] / height
    return planes


def panorama(scene, folder, width=256, height=128):
    """What the world alone looks like from everywhere: lobe's u grows from -x over -z, +x and +z."""
    lens = bpy.data.cameras.new("panorama")
    lens.type = "PANO"
    if hasattr(lens, "panorama_type"):
        lens.panorama_type = "EQUIRECTANGULAR"
    else:
        lens.cycles.panorama_type = "EQUIRECTANGULAR"
    eye = bpy.data.objects.new("panorama", lens)
    eye.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    scene.collection.objects.link(eye)
    shown = [o for o in scene.objects if not o.hide_render and o is not eye]
    for o in shown:
        o.hide_render = True
    with Changed(scene, camera=eye), Changed(scene.render, resolution_x=width, resolution_y=height,
                                             resolution_percentage=100), Changed(
            scene.cycles, use_denoising=False):
        found = render(scene, folder)
    for o in shown:
        o.hide_render = False
    bpy.data.objects.remove(eye)
    return np.stack([found[f"Combined.{c}"] for c in "RGB"], -1)


def main():
    inside = "--" in sys.argv
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    if not inside:
        parser.add_argument("blend")
    parser.add_argument("-o", dest="out", required=True)
    parser.add_argument("--frames", type=int, help="default: all of the scene")
    parser.add_argument("--samples", type=int, default=64)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if inside else None)
    if not inside:
        bpy.ops.wm.open_mainfile(filepath=options.blend)
    scene = bpy.context.scene
    prepare(scene)
    scene.cycles.samples = options.samples
    percent = scene.render.resolution_percentage
    width, height = (scene.render.resolution_x * percent // 100, scene.render.resolution_y * percent // 100)
    folder = Folder(options.out, width, height)
    count = options.frames or scene.frame_end - scene.frame_start + 1
    with tempfile.TemporaryDirectory() as work:
        for i in range(count):
            scene.frame_set(scene.frame_start + i)
            found, color = passes(scene, work), render(scene, work)
            folder.add(view_of(scene, width, height), planes_of(found, color, i == 0, scene.camera.data.clip_end))
        folder.environment(panorama(scene, work))
    folder.finish()


if __name__ == "__main__":
    main()
