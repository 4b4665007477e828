"""The two skies: an even one of radiance 1, and a clear one with a small sun."""
import math

import numpy

WIDTH, HEIGHT = 1024, 512
SUN = (0.5, 0.62, 0.6)  # towards it, not of length 1
SUN_RADIANCE = 5000.0
SUN_TEXELS = 3  # a side: about a degree


def directions():
    """Towards each texel's middle. The top row is up, the middle column +Z, a quarter of the width left of it +X."""
    v, u = numpy.mgrid[0:HEIGHT, 0:WIDTH]
    down, turn = math.pi * (v + 0.5) / HEIGHT, 2 * math.pi * (0.5 - (u + 0.5) / WIDTH)
    return numpy.stack([numpy.sin(down) * numpy.sin(turn), numpy.cos(down), numpy.sin(down) * numpy.cos(turn)], -1)


def even():
    return numpy.ones((HEIGHT, WIDTH, 3), numpy.float32)


def sunny():
    d = directions()
    up = d[..., 1:2]
    horizon = numpy.exp(-12 * numpy.abs(up))
    sky = numpy.array([0.25, 0.42, 0.8]) * (0.6 + 0.4 * up) + 0.5 * horizon * numpy.array([1.0, 0.95, 0.85])
    ground = numpy.array([0.16, 0.13, 0.1]) + 0.2 * horizon
    picture = numpy.where(up > 0, sky, ground)
    sun = numpy.array(SUN) / numpy.linalg.norm(SUN)
    glow = numpy.exp(60 * (d @ sun - 1))[..., None]
    picture = picture + 2.0 * glow * (up > 0)
    row = round(HEIGHT * math.acos(sun[1]) / math.pi - 0.5)
    column = round(WIDTH * (0.5 - math.atan2(sun[0], sun[2]) / (2 * math.pi)) - 0.5)
    half = SUN_TEXELS // 2
    picture[row - half:row + half + 1, column - half:column + half + 1] = SUN_RADIANCE * numpy.array([1.0, 0.93, 0.82])
    return picture.astype(numpy.float32)


ALL = {"even": even, "sun": sunny}


def write(folder):
    """As EXR files: name -> path."""
    import OpenEXR

    found = {}
    for name, make in ALL.items():
        found[name] = folder / f"sky-{name}.exr"
        OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, {"RGB": make()}).write(str(found[name]))
    return found
