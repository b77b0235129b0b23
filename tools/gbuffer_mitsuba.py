#!/usr/bin/env python3
"""gbuffer_mitsuba.py SCENE.xml -o DIR [--frames N --orbit DEGREES] [--spp N] [--variant NAME]

Writes frames of a Mitsuba 3 scene as docs/gbuffer.md has them, for `lobe ssr DIR -o OUT`.
Without --frames every sensor of the scene is a frame; with it the first sensor turns about the middle of the scene's
box, DEGREES a frame, about +Y. Needs `pip install mitsuba numpy`; the llvm variants want DRJIT_LIBLLVM_PATH.

The surface at the centre of each pixel comes from ray_intersect (an averaged depth of the `aov` integrator is that
of no surface where two meet), the colour from the scene's own integrator.
"""
import argparse

import numpy as np

from gbuffer_files import Folder, camera

ROUGH_NAMES, SMOOTH = ("roughness", "alpha", "alpha_u"), ("Conductor", "Dielectric", "Plastic", "ThinDielectric")


def view_of(mi, sensor):
    """(camera of gbuffer.json, forward, eye): Mitsuba's sensors look along +z and have +x to the left."""
    p = mi.traverse(sensor)
    if "x_fov" not in p:
        raise SystemExit("gbuffer_mitsuba: only perspective sensors can be exported")
    if float(p["principal_point_offset_x"][0]) or float(p["principal_point_offset_y"][0]):
        raise SystemExit("gbuffer_mitsuba: a shifted lens cannot be exported")
    m = np.array(p["to_world"].matrix, float).reshape(4, 4)
    axes = m[:3, :3] / np.linalg.norm(m[:3, :3], axis=0)
    width, height = sensor.film().crop_size()
    tangent = float(np.tan(np.radians(np.array(p["x_fov"], float).ravel()[0]) / 2))
    view = camera(-axes[:, 0], axes[:, 1], axes[:, 2], m[:3, 3], (tangent, tangent * height / width),
                  sensor.near_clip(), sensor.far_clip())
    return view, axes[:, 2], m[:3, 3]


def material(mi, dr, shape, si, count):
    """Roughness and reflectance at normal incidence on one shape."""
    bsdf = shape.bsdf()
    kinds = str(bsdf)
    roughness = np.ones(count)
    for name in ROUGH_NAMES:
        if bool(dr.all(bsdf.has_attribute(name))):
            value = np.array(bsdf.eval_attribute_1(name, si)).ravel() * np.ones(count)
            roughness = value if name == "roughness" else np.sqrt(value)
            break
    else:
        if "Diffuse" not in kinds and any(name in kinds for name in SMOOTH):
            roughness = np.zeros(count)
    f0 = np.full((count, 3), 0.04)
    p = mi.traverse(bsdf)
    eta = next((p[k] for k in p.keys() if k.endswith("eta.value")), None)
    absorbs = next((p[k] for k in p.keys() if k.endswith("k.value") and "eta" not in k), None)
    if eta is not None and absorbs is not None:
        n, k = np.array(eta, float).ravel(), np.array(absorbs, float).ravel()
        f0[:] = ((n - 1) ** 2 + k ** 2) / ((n + 1) ** 2 + k ** 2)
    elif bool(dr.all(bsdf.has_attribute("metallic"))):
        metallic = np.array(bsdf.eval_attribute_1("metallic", si)).reshape(-1, 1) * np.ones((count, 1))
        base = np.array(bsdf.eval_attribute_3("base_color", si)).T.reshape(-1, 3)
        f0 = 0.04 + (base - 0.04) * metallic
    elif "Conductor" in kinds:
        f0[:] = 1.0
    elif "Diffuse" in kinds and "Rough" not in kinds and "Principled" not in kinds:
        f0[:] = 0.0
    return roughness, f0


def surfaces(mi, dr, scene, sensor, forward, eye):
    """The channels but the colour."""
    width, height = sensor.film().crop_size()
    count = width * height
    i = dr.arange(mi.UInt32, count)
    at = mi.Point2f((mi.Float(i % width) + 0.5) / width, (mi.Float(i // width) + 0.5) / height)
    ray, _ = sensor.sample_ray(0, 0.5, at, 0.5)
    si = scene.ray_intersect(ray)
    hit = np.array(si.is_valid()).astype(bool)
    normal = np.array(si.sh_frame.n).T.reshape(count, 3)
    # of a surface that reflects on both sides, the side that is seen
    direction = np.array(ray.d).T.reshape(count, 3)
    normal *= np.where((normal * direction).sum(1) > 0, -1, 1)[:, None]
    place = np.array(si.p).T.reshape(count, 3)
    roughness, f0 = np.zeros(count), np.zeros((count, 3))
    for shape in scene.shapes():
        chosen = np.array(si.shape == mi.ShapePtr(shape)).astype(bool) & hit
        if chosen.any():
            r, f = material(mi, dr, shape, si, count)
            roughness[chosen], f0[chosen] = r[chosen], f[chosen]
    z = np.where(hit, (place - eye) @ forward, 0)
    planes = {"Z": z, "roughness": np.where(hit, roughness, 0)}
    planes |= {f"N.{c}": np.where(hit, normal[:, k], 0) for k, c in enumerate("XYZ")}
    planes |= {f"f0.{c}": np.where(hit, f0[:, k], 0) for k, c in enumerate("RGB")}
    return {name: np.reshape(plane, (height, width)) for name, plane in planes.items()}


def panorama(mi, dr, scene, width=256, height=128):
    """The light from everywhere: direction d at u = 1/2 + atan2(d.z, d.x)/2 pi, v = acos(d.y)/pi."""
    i = dr.arange(mi.UInt32, width * height)
    phi = ((mi.Float(i % width) + 0.5) / width - 0.5) * (2 * np.pi)
    theta = (mi.Float(i // width) + 0.5) / height * np.pi
    si = dr.zeros(mi.SurfaceInteraction3f, width * height)
    si.wi = -mi.Vector3f(dr.sin(theta) * dr.cos(phi), dr.cos(theta), dr.sin(theta) * dr.sin(phi))
    light = np.array(scene.environment().eval(si)).T.reshape(-1, 3)  # one row where it is constant
    return np.broadcast_to(light, (width * height, 3)).reshape(height, width, 3)


def sensors_of(mi, scene, frames, degrees):
    if not frames:
        yield from scene.sensors()
        return
    sensor = scene.sensors()[0]
    p = mi.traverse(sensor)
    start = mi.ScalarTransform4f(np.array(p["to_world"].matrix, float).reshape(4, 4))
    middle = np.array(scene.bbox().center(), float).ravel().tolist()
    for i in range(frames):
        turn = mi.ScalarTransform4f().translate(middle).rotate([0, 1, 0], degrees * i).translate([-c for c in middle])
        p["to_world"] = mi.Transform4f(turn @ start)
        p.update()
        yield sensor


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("-o", dest="out", required=True)
    parser.add_argument("--frames", type=int, default=0)
    parser.add_argument("--orbit", type=float, default=1.0)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--variant", default="llvm_ad_rgb")
    options = parser.parse_args()
    import drjit as dr
    import mitsuba as mi
    mi.set_variant(options.variant)
    scene = mi.load_file(options.scene)
    folder = None
    for i, sensor in enumerate(sensors_of(mi, scene, options.frames, options.orbit)):
        width, height = sensor.film().crop_size()
        folder = folder or Folder(options.out, int(width), int(height))
        view, forward, eye = view_of(mi, sensor)
        planes = surfaces(mi, dr, scene, sensor, forward, eye)
        rgb = np.array(mi.render(scene, sensor=sensor, spp=options.spp, seed=i))[..., :3]
        folder.add(view, planes | {c: rgb[..., k] for k, c in enumerate("RGB")})
    if scene.environment() is not None:
        folder.environment(panorama(mi, dr, scene))
    folder.finish()


if __name__ == "__main__":
    main()
