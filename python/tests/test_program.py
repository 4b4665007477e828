"""The module's pictures are the program's, bit for bit."""
import subprocess

import numpy
import pinocchio_renderer as pn
import pytest

CHANNELS = {
    "depth": ["Z"],
    "position": ["P.X", "P.Y", "P.Z"],
    "ids": ["id.triangle"],
    "mask": ["shadow.mask"],
}
HALVES = {
    "color": ["R", "G", "B", "A"],
    "normal": ["N.X", "N.Y", "N.Z"],
    "albedo": ["Albedo.R", "Albedo.G", "Albedo.B"],
    "reflection": ["reflection.R", "reflection.G", "reflection.B"],
}
MODES = [
    (["--mode", "raytrace"], {}),
    (["--mode", "raytrace", "--spp", "3"], {"spp": 3}),
    (["--mode", "hybrid"], {"mode": "hybrid"}),
    (["--design", "2"], {"mode": "hybrid", "design": 2}),
]


@pytest.mark.parametrize("options, settings", MODES, ids=lambda v: str(v))
@pytest.mark.parametrize("name", ["cornell.gltf", "two-lights.gltf", "speedboat.glb"])
def test_every_channel(scenes, program, tmp_path, name, options, settings):
    theirs, ours = tmp_path / "program.exr", tmp_path / "module.exr"
    command = [program, "render", scenes / name, *options, "--size", "160x100", "-o", theirs, "--quiet"]
    subprocess.run(command, check=True)
    wanted = pn.read_exr(theirs)
    result = pn.Engine().render(pn.load_scene(scenes / name), size=(160, 100), **settings)
    for field, names in {**CHANNELS, **HALVES}.items():
        array = getattr(result, field)
        array = array.reshape(*array.shape[:2], -1)
        for i, channel in enumerate(names):
            found = array[..., i].astype(numpy.float16 if field in HALVES else array.dtype)
            numpy.testing.assert_array_equal(found.astype(wanted[channel].dtype), wanted[channel], err_msg=channel)
    result.write_exr(ours)
    for channel, values in pn.read_exr(ours).items():
        numpy.testing.assert_array_equal(values, wanted[channel], err_msg=channel)
