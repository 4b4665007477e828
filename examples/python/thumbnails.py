"""A thumbnail of every model of a folder, without a GPU or a display: thumbnails.py FOLDER OUT [SIZE]"""
import pathlib
import sys

import numpy
import pinocchio_renderer as pn
from numpy.typing import NDArray
from PIL import Image


def on_screen(color: NDArray[numpy.float32], background: float = 0.18) -> NDArray[numpy.uint8]:
    """Converts linear RGBA over grey to 8-bit sRGB."""
    linear = numpy.clip(color[..., :3] + background * (1 - color[..., 3:]), 0, 1)
    srgb = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return (255 * srgb + 0.5).astype(numpy.uint8)


def main(folder: str, to: str, size: int = 256) -> None:
    engine, out = pn.Engine(), pathlib.Path(to)
    out.mkdir(parents=True, exist_ok=True)
    for path in sorted(pathlib.Path(folder).iterdir()):
        if path.suffix.lower() not in (".gltf", ".glb", ".obj", ".ply", ".stl"):
            continue
        try:
            scene = pn.load_scene(path)
        except pn.Error as error:  # one line: the file, what is wrong, what to do
            print(error, file=sys.stderr)
            continue
        picture = engine.render(scene, scene.camera(), size=(size, size), spp=4)
        file = out / (path.name + ".png")
        Image.fromarray(on_screen(picture.color)).save(file)
        print(file, f"{picture.record['ms']:.0f} ms")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
