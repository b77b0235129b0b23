"""The files of docs/gbuffer.md: OpenEXR without compression, and gbuffer.json. Needs NumPy alone."""
import json
import os
import struct
from pathlib import Path

import numpy as np

HALF, FLOAT = 1, 2
TYPES = {HALF: np.dtype("<f2"), FLOAT: np.dtype("<f4")}


def _attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_exr(path, channels):
    """`channels`: name -> array of height x width; written beside its name, then renamed."""
    names = sorted(channels)
    planes = [np.asarray(channels[name], "<f4") for name in names]
    height, width = planes[0].shape
    rows = np.stack(planes, axis=1)  # height, channel, width: as the format wants it
    listed = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", FLOAT, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + b"".join([
        _attribute("channels", "chlist", listed),
        _attribute("compression", "compression", b"\0"),
        _attribute("dataWindow", "box2i", window),
        _attribute("displayWindow", "box2i", window),
        _attribute("lineOrder", "lineOrder", b"\0"),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1))]) + b"\0"
    line = 4 * len(names) * width
    first = len(header) + 8 * height
    part = f"{path}.part"
    with open(part, "wb") as file:
        file.write(header)
        file.write(np.arange(first, first + height * (line + 8), line + 8, dtype="<u8").tobytes())
        for y in range(height):
            file.write(struct.pack("<ii", y, line) + rows[y].tobytes())
    os.replace(part, path)


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def read_exr(path):
    """name -> array of height x width, of a file in scan lines without compression."""
    data = Path(path).read_bytes()
    magic, version = struct.unpack_from("<ii", data)
    if magic != 20000630 or version & 0x1a00:
        raise ValueError(f"{path}: not OpenEXR in scan lines of one part")
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    if attributes["compression"] != b"\0":
        raise ValueError(f"{path}: compressed; write it with the codec NONE")
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    planes, spans, listed, begin = {}, [], 0, 0
    while attributes["channels"][listed]:
        name, listed = _text(attributes["channels"], listed)
        kind = TYPES[struct.unpack_from("<i", attributes["channels"], listed)[0]]
        listed += 16
        planes[name] = np.empty((height, width), np.float32)
        spans.append((name, kind, begin))
        begin += kind.itemsize * width
    offsets = np.frombuffer(data, "<u8", height, at + 1)
    for offset in offsets:
        y = struct.unpack_from("<i", data, int(offset))[0] - top
        for name, kind, start in spans:
            planes[name][y] = np.frombuffer(data, kind, width, int(offset) + 8 + start)
    return planes


def camera(right, up, forward, eye, tangents, near, far):
    """A camera of gbuffer.json from its axes."""
    rows = np.eye(4)
    rows[:3] = np.stack([np.asarray(right, float), np.asarray(up, float), -np.asarray(forward, float),
                         np.asarray(eye, float)], axis=1)
    return {"to_world": rows.tolist(), "tan": [float(t) for t in tangents], "near": float(near), "far": float(far)}


class Folder:
    """Writes frames, and gbuffer.json at the end."""

    def __init__(self, path, width, height):
        self.path = Path(path)
        self.path.mkdir(parents=True, exist_ok=True)
        self.text = {"format": "lobe-gbuffer", "version": 1, "width": width, "height": height, "frames": []}

    def add(self, view, channels):
        name = f"gbuffer-{len(self.text['frames']):04d}.exr"
        write_exr(self.path / name, channels)
        self.text["frames"].append({"file": name, "camera": view})

    def environment(self, rgb):
        """A panorama, height x width x 3: lobe filters it."""
        write_exr(self.path / "environment.exr", {c: rgb[..., i] for i, c in enumerate("RGB")})
        self.text["environment"] = {"file": "environment.exr", "width": rgb.shape[1], "height": rgb.shape[0],
                                    "levels": 1}

    def finish(self):
        part = self.path / "gbuffer.json.part"
        part.write_text(json.dumps(self.text, indent=1) + "\n")
        os.replace(part, self.path / "gbuffer.json")
