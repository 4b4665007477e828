"""Pictures of 3D scenes as NumPy arrays: exact shadows and mirrors, with no GPU and no display.

    import pinocchio_renderer as pn
    scene = pn.load_scene("scenes/cornell.gltf")
    picture = pn.Engine().render(scene, size=(320, 240))
    picture.color      # (240, 320, 4) float32, linear
    picture.write_exr("cornell.exr")

It is not the robotics library `pinocchio` (PyPI: pin). Both may be installed.
"""

from . import _core
from ._core import (
    Camera,
    Engine,
    Error,
    Hits,
    Light,
    Material,
    Result,
    Scene,
    Tracer,
    assemble,
    compare,
    load_scene,
    read_exr,
)
from ._masks import amodal_masks, boxes, visible_share
from ._trimesh import from_trimesh

__version__: str = getattr(_core, "__version__")

__all__ = [
    "Camera",
    "Engine",
    "Error",
    "Hits",
    "Light",
    "Material",
    "Result",
    "Scene",
    "Tracer",
    "__version__",
    "amodal_masks",
    "assemble",
    "boxes",
    "compare",
    "from_trimesh",
    "load_scene",
    "read_exr",
    "visible_share",
]
