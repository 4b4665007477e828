"""Scenes from trimesh's meshes. The caller imports trimesh."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, Optional, Tuple

from ._core import Error, Light, Material, Scene, assemble

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def _linear(srgb: Any) -> Any:
    """sRGB 0..255 to linear 0..1 (IEC 61966-2-1)."""
    import numpy

    c = numpy.asarray(srgb, numpy.float32)[..., :3] / 255
    return numpy.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4).astype(numpy.float32)


def _image(material: Any) -> Any:
    image = getattr(material, "baseColorTexture", None)
    return image if image is not None else getattr(material, "image", None)


def _factor(material: Any) -> Tuple[float, ...]:
    """The material's own colour, linear: a glTF file's factor, or an MTL file's Kd."""
    import numpy

    return tuple(map(float, numpy.asarray(material.main_color, numpy.float32)[:3] / 255))


def _surface(mesh: Any, material: Optional[Material]) -> dict[str, Any]:
    """Keyword arguments for Scene: the given material, else the mesh's visual."""
    import numpy

    visual = mesh.visual
    if material is not None:
        return {"materials": material}
    if visual.kind == "texture" and visual.uv is not None and _image(visual.material) is not None:
        texture = numpy.ascontiguousarray(numpy.asarray(_image(visual.material).convert("RGBA")))
        uvs = numpy.asarray(visual.uv, numpy.float32) * [1, -1] + [0, 1]  # trimesh counts v upwards
        own = getattr(visual.material, "baseColorFactor", None)
        diffuse = (1.0, 1.0, 1.0) if own is None else _factor(visual.material)
        return {"uvs": uvs.astype(numpy.float32), "materials": Material(diffuse=diffuse, texture=texture)}
    if visual.kind == "texture":
        return {"materials": Material(diffuse=_factor(visual.material))}
    if visual.kind == "vertex":
        return {"colors": _linear(visual.vertex_colors)}
    if visual.kind == "face":  # as materials: a mesh may have as many triangles as vertices
        colors, of_triangle = numpy.unique(_linear(visual.face_colors), axis=0, return_inverse=True)
        return {
            "materials": [Material(diffuse=tuple(map(float, c))) for c in colors],
            "triangle_materials": numpy.ascontiguousarray(of_triangle.reshape(-1), numpy.uint32),
        }
    return {}


def from_trimesh(
    mesh: Any,
    *,
    smooth: bool = True,
    material: Optional[Material] = None,
    lights: Iterable[Light] = (),
    ambient: ArrayLike = (0.1, 0.1, 0.1),
) -> Scene:
    """A Scene from a trimesh.Trimesh, or from a trimesh.Scene, whose geometry becomes nodes that can be moved.

    smooth: shade with the mesh's vertex normals. False: triangles are flat.
    material: a Material that replaces the mesh's own colours or texture. Colours of materials are linear, as in glTF and
    MTL files; those of vertices and faces are sRGB.
    lights: a list of Light. ambient: three numbers, linear.
    Raises Error if there are no triangles.
    """
    import numpy

    if not hasattr(mesh, "geometry") and not hasattr(mesh, "faces"):
        raise Error(f"a {type(mesh).__name__} has no triangles; give a trimesh.Trimesh or a trimesh.Scene")
    if hasattr(mesh, "geometry") and hasattr(mesh, "graph"):
        parts = {}
        for node in mesh.graph.nodes_geometry:
            pose, name = mesh.graph[node]
            if hasattr(mesh.geometry[name], "faces"):
                part = from_trimesh(mesh.geometry[name], smooth=smooth, material=material)
                parts[node] = (part, numpy.ascontiguousarray(pose, numpy.float64))
        if not parts:
            raise Error("the trimesh scene has no triangles; there is nothing to draw")
        scene = assemble(parts)
        scene.lights = list(lights)
        scene.ambient = ambient
        return scene
    return Scene(
        numpy.ascontiguousarray(mesh.vertices, numpy.float32),
        numpy.ascontiguousarray(mesh.faces, numpy.uint32),
        normals=numpy.ascontiguousarray(mesh.vertex_normals, numpy.float32) if smooth else None,
        lights=list(lights),
        ambient=ambient,
        **_surface(mesh, material),
    )
