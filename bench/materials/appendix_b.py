"""glTF's reflection model (specification, appendix B) under an even sky of radiance 1, by quadrature: no noise, code of its own.

GGX with alpha = roughness squared, height-correlated Smith, Schlick; Lambert below. The specification leaves open how the matt part gives way to the mirror.
"mix": each of dielectric and metal by itself, Lambert times 1 - F(v.h), as its formulas stand. "short": one F of the mixed f0, as its code has it.
"view": Lambert times what the mirror leaves of a view, 1 - E(n.v). "none": all of Lambert.
"""
import functools

import numpy

COUPLINGS = ("mix", "short", "view", "none")
F0 = 0.04
COSINES = numpy.linspace(0.0, 1.0, 129)[1:] ** 1.5
POINTS = 160  # a side of the quadrature
LEAST_ALPHA = 1e-4


def midpoints():
    u = (numpy.arange(POINTS) + 0.5) / POINTS
    return (grid.ravel() for grid in numpy.meshgrid(u, u))


def visible_normals(view, alpha):
    """Half vectors as seen from the view, evenly weighted (Dupuy and Benyoub 2023)."""
    u, v = midpoints()
    stretched = view * (alpha, alpha, 1.0)
    stretched /= numpy.linalg.norm(stretched)
    z = (1 - v) * (1 + stretched[2]) - stretched[2]
    around = numpy.sqrt(numpy.clip(1 - z * z, 0, 1))
    cap = numpy.stack([around * numpy.cos(2 * numpy.pi * u), around * numpy.sin(2 * numpy.pi * u), z], -1) + stretched
    h = cap * (alpha, alpha, 1.0)
    return h / numpy.linalg.norm(h, axis=1, keepdims=True)


def smith(cosine, alpha):
    """Lambda of the Smith terms."""
    tangent2 = (1 - cosine ** 2) / cosine ** 2
    return 0.5 * (numpy.sqrt(1 + alpha ** 2 * tangent2) - 1)


@functools.cache
def tables(roughness):
    """Over COSINES: what the mirror returns with F = 1, what with F = (1 - v.h)^5, and the mean of (1 - v.h)^5 over Lambert's directions."""
    alpha = max(roughness ** 2, LEAST_ALPHA)
    whole, grazing, matt = (numpy.zeros(len(COSINES)) for _ in range(3))
    for i, cosine in enumerate(COSINES):
        view = numpy.array([numpy.sqrt(max(0.0, 1 - cosine ** 2)), 0.0, cosine])
        h = visible_normals(view, alpha)
        vh = h @ view
        down = 2 * vh * h[:, 2] - cosine  # the mirrored direction's cosine
        up = down > 1e-9
        weight = numpy.zeros_like(down)
        ours, theirs = smith(cosine, alpha), smith(numpy.maximum(down, 1e-9), alpha)
        weight[up] = ((1 + ours) / (1 + ours + theirs))[up]  # G2 / G1
        whole[i] = weight.mean()
        grazing[i] = (weight * (1 - vh) ** 5).mean()
        u, v = midpoints()
        light = numpy.stack([numpy.sqrt(u) * numpy.cos(2 * numpy.pi * v), numpy.sqrt(u) * numpy.sin(2 * numpy.pi * v), numpy.sqrt(1 - u)], -1)
        half = light + view
        half /= numpy.linalg.norm(half, axis=1, keepdims=True)
        matt[i] = ((1 - numpy.clip(half @ view, 0, 1)) ** 5).mean()
    return whole, grazing, matt


def radiance(cosines, base, metallic, roughness, coupling):
    """What a surface returns towards a view of that n.v, a number for each colour."""
    whole, grazing, matt = (numpy.interp(cosines, COSINES, t)[..., None] for t in tables(roughness))
    base = numpy.asarray(base, float)
    mirror = lambda f0: f0 * (whole - grazing) + grazing
    lost = lambda f0: f0 + (1 - f0) * matt
    mixed_f0 = F0 * (1 - metallic) + base * metallic
    colour = base * (1 - metallic)
    if coupling == "short":
        return mirror(mixed_f0) + colour * (1 - lost(mixed_f0))
    left = {"mix": 1 - lost(F0), "view": 1 - mirror(F0), "none": 1.0}[coupling]
    return (1 - metallic) * mirror(F0) + metallic * mirror(base) + colour * left


def cosines_of_pixels(size, eye_distance, fov, parts=4):
    """n.v at parts x parts points of each pixel of the sphere of radius 1; NaN where it is missed."""
    width, height = size
    scale = numpy.tan(numpy.radians(fov) / 2)
    x = ((numpy.arange(width * parts) + 0.5) / parts - width / 2) * 2 * scale / height
    y = (height / 2 - (numpy.arange(height * parts) + 0.5) / parts) * 2 * scale / height
    sine2 = (x[None, :] ** 2 + y[:, None] ** 2)
    sine2 = sine2 / (1 + sine2)  # of the angle between the ray and the axis
    inside = 1 - eye_distance ** 2 * sine2  # the squared cosine at the hit point
    return numpy.where(inside > 0, numpy.sqrt(numpy.maximum(inside, 0)), numpy.nan)


def picture(case, size, eye_distance, fov, coupling, parts=4):
    """The sphere under the even sky: (height, width, 4)."""
    cosines = cosines_of_pixels(size, eye_distance, fov, parts)
    hit = numpy.isfinite(cosines)
    colours = radiance(numpy.where(hit, cosines, 1.0), case.base, case.metallic, case.roughness, coupling) * hit[..., None]
    whole = numpy.concatenate([colours, hit[..., None]], -1)
    return whole.reshape(size[1], parts, size[0], parts, 4).mean(axis=(1, 3))
