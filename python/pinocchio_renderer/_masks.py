"""Boxes, masks and visible shares of a scene's nodes, for data sets."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Optional, Sequence, Set, Tuple, Union

from ._core import Camera, Engine, Error, Scene

if TYPE_CHECKING:
    import numpy
    from numpy.typing import ArrayLike, NDArray

Node = Union[int, str]
NOTHING = 0xFFFFFFFF


def boxes(ids: ArrayLike) -> Dict[int, Tuple[int, int, int, int]]:
    """The tight box of each number in a picture of ids: {number: (x0, y0, x1, y1)}, in pixels, x1 and y1 excluded.

    ids: (h, w) of whole numbers, as Result.objects, Result.materials and Result.ids are. 0xffffffff, where nothing is
    hit, has no box. Raises Error if ids has another shape.
    """
    import numpy

    picture = numpy.asarray(ids)
    if picture.ndim != 2:
        raise Error(f"ids has the shape {picture.shape}; give the ids of one picture, (height, width)")
    if picture.size and picture.dtype.kind not in "iu":
        raise Error(f"ids is of the type {picture.dtype}; give whole numbers, as Result.objects are")
    found: Dict[int, Tuple[int, int, int, int]] = {}
    for y, row in enumerate(picture):  # a few numbers in each
        begins = numpy.flatnonzero(numpy.diff(row, prepend=row[:1] + 1))
        ends = numpy.append(begins[1:], len(row))
        for number, x0, x1 in zip(row[begins].tolist(), begins.tolist(), ends.tolist()):
            if number == NOTHING:
                continue
            box = found.get(number, (x0, y, x1, y + 1))
            found[number] = (min(box[0], x0), box[1], max(box[2], x1), y + 1)
    return dict(sorted(found.items()))


def _number(scene: Scene, node: Node) -> int:
    if isinstance(node, str):
        names = list(scene.nodes)
        if node not in names:
            raise Error(f"there is no node '{node}'; Scene.nodes lists them")
        return names.index(node)
    return int(node)


def _with_children(scene: Scene, node: Node) -> List[int]:
    inside: Set[int] = {_number(scene, node)}
    for child, parent in enumerate(scene.node_parents):
        if int(parent) in inside:
            inside.add(child)
    return sorted(inside)


def amodal_masks(
    engine: Engine,
    scene: Scene,
    nodes: Optional[Iterable[Node]] = None,
    camera: Optional[Union[Camera, int, str]] = None,
    size: Sequence[int] = (800, 600),
    **settings: Any,
) -> Dict[Node, NDArray[numpy.bool_]]:
    """The pixels in which each node would be seen if nothing else were there: {node: (h, w) bool}.

    nodes: names or indices of Scene.nodes, each with all nodes below it. None: every node with triangles of its own.
    camera, size, settings: as for Engine.render. Each node takes a picture, which traces the camera's rays alone.
    Raises Error if there is no such node or camera.
    """
    chosen = list(nodes) if nodes is not None else _drawn_nodes(scene)
    if camera is None or not isinstance(camera, Camera):
        camera = _camera(scene, camera)
    masks: Dict[Node, Any] = {}
    for node in chosen:
        part = scene.only([_number(scene, node)])
        if part is None:
            import numpy

            masks[node] = numpy.zeros((size[1], size[0]), bool)
            continue
        seen = engine.render_many(part, [camera], size, outputs=["ids"], **settings)["ids"][0]
        masks[node] = seen != NOTHING
    return masks


def _drawn_nodes(scene: Scene) -> List[Node]:
    import numpy

    names = list(scene.nodes)
    return [names[i] for i in numpy.unique(scene.triangle_nodes) if i < len(names)]


def _camera(scene: Scene, camera: Optional[Union[int, str]]) -> Camera:
    cameras = list(scene.cameras)
    if camera is None:
        return cameras[0] if cameras else scene.camera()
    for one in cameras:
        if one.name == camera:
            return one
    if not isinstance(camera, str) and 0 <= operator.index(camera) < len(cameras):
        return cameras[operator.index(camera)]
    raise Error(f"the scene has no camera {camera!r}; Scene.cameras lists them")


def visible_share(
    engine: Engine,
    scene: Scene,
    nodes: Optional[Iterable[Node]] = None,
    camera: Optional[Union[Camera, int, str]] = None,
    size: Sequence[int] = (800, 600),
    **settings: Any,
) -> Dict[Node, float]:
    """The share of each node's pixels that other nodes leave visible: {node: 0 to 1}; 0 outside the picture.

    Arguments and errors as for amodal_masks.
    """
    import numpy

    chosen = list(nodes) if nodes is not None else _drawn_nodes(scene)
    if camera is None or not isinstance(camera, Camera):
        camera = _camera(scene, camera)
    objects = engine.render_many(scene, [camera], size, outputs=["objects"], **settings)["objects"][0]
    shares: Dict[Node, float] = {}
    for node, mask in amodal_masks(engine, scene, chosen, camera, size, **settings).items():
        seen = numpy.isin(objects, _with_children(scene, node)) & mask
        shares[node] = float(seen.sum() / max(int(mask.sum()), 1))
    return shares
