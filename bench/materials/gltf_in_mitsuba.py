"""A glTF file's triangles and materials as shapes of Mitsuba's: by its principled model, or by glTF's own (appendix_b_bsdf.py)."""
import numpy

import gltf
import theirs


def bitmap(mitsuba, pixels):
    return {"type": "bitmap", "data": mitsuba.TensorXf(numpy.ascontiguousarray(pixels, numpy.float32)), "raw": True}


class Materials:
    """Each material as a dictionary of Mitsuba's. Mirrored texture coordinates turn a normal map's green around."""

    def __init__(self, mitsuba, document, data, model):
        self.mitsuba, self.document, self.data, self.model = mitsuba, document, data, model

    def texels(self, texture):
        return gltf.image_of(self.document, self.data, texture)

    def of(self, index, textured, turned):
        material = {} if index is None else self.document["materials"][index]
        found = material.get("pbrMetallicRoughness", {})
        factor = numpy.array(found.get("baseColorFactor", [1, 1, 1, 1]), float)
        base, metallic, roughness = theirs.rgb(factor[:3]), found.get("metallicFactor", 1.0), found.get("roughnessFactor", 1.0)
        opacity = None
        if textured and "baseColorTexture" in found:
            texels = self.texels(found["baseColorTexture"])
            base = bitmap(self.mitsuba, gltf.linear(texels[..., :3]) * factor[:3])
            if material.get("alphaMode") == "MASK":
                opacity = bitmap(self.mitsuba, (texels[..., 3:] * factor[3] >= material.get("alphaCutoff", 0.5)).astype(float))
        if textured and "metallicRoughnessTexture" in found:
            texels = self.texels(found["metallicRoughnessTexture"])
            metallic, roughness = (bitmap(self.mitsuba, texels[..., k:k + 1] * f) for k, f in ((2, metallic), (1, roughness)))
        if self.model == "principled":
            surface = theirs.principled(base, metallic, roughness)
        else:
            surface = {"type": "gltf", "base_color": base, "metallic": metallic, "roughness": roughness}
        if textured and "normalTexture" in material:
            normals = 2 * self.texels(material["normalTexture"])[..., :3] - 1
            scale = material["normalTexture"].get("scale", 1.0)
            normals = normals * (scale, -scale if turned else scale, 1)
            normals /= numpy.maximum(numpy.linalg.norm(normals, axis=-1, keepdims=True), 1e-6)
            surface = {"type": "normalmap", "normalmap": bitmap(self.mitsuba, 0.5 * normals + 0.5), "nested": surface}
        surface = {"type": "twosided", "nested": surface}
        return {"type": "mask", "opacity": opacity, "nested": surface} if opacity else surface


def is_mirrored(positions, normals, coordinates, faces):
    """For each triangle: does the texture lie on it as seen in a mirror?"""
    a, b, c = (positions[faces[:, k]] for k in range(3))
    u, v, w = (coordinates[faces[:, k]].astype(float) for k in range(3))
    area = (v - u)[:, 0] * (w - u)[:, 1] - (v - u)[:, 1] * (w - u)[:, 0]  # v runs down, so it is negative where nothing is mirrored
    facing = numpy.cross(b - a, c - a)
    side = numpy.einsum("ij,ij->i", facing, normals[faces].sum(axis=1)) if normals is not None else numpy.ones(len(faces))
    return area * numpy.where(side < 0, -1, 1) > 0


def write_ply(path, positions, normals, coordinates, faces):
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals is not None else []) + (["u", "v"] if coordinates is not None else [])
    columns = [positions] + ([normals] if normals is not None else []) + ([coordinates] if coordinates is not None else [])
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(positions)}"] + [f"property float {n}" for n in names]
    head += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    rows = numpy.zeros(len(faces), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    rows["n"], rows["corners"] = 3, faces
    path.write_bytes(("\n".join(head) + "\n").encode() + numpy.concatenate(columns, 1).astype("<f4").tobytes() + rows.tobytes())


def shapes(mitsuba, document, data, folder, model):
    """The dictionary of shapes: one for each material of each primitive, and for each side that a texture is seen from."""
    materials = Materials(mitsuba, document, data, model)
    found = {}
    for i, (positions, normals, sets, faces, index) in enumerate(gltf.parts(document, data)):
        used = gltf.textures_of(document["materials"][index]) if index is not None else []
        coordinates = sets.get(used[0].get("texCoord", 0)) if used else None
        mirrored = is_mirrored(positions, normals, coordinates, faces) if coordinates is not None else numpy.zeros(len(faces), bool)
        for turned in (False, True):
            chosen = faces[mirrored == turned]
            if not len(chosen):
                continue
            path = folder / f"part-{i}-{int(turned)}.ply"
            write_ply(path, positions, normals, coordinates, chosen)
            found[f"part{i}x{int(turned)}"] = {"type": "ply", "filename": str(path), "face_normals": normals is None,
                                              "bsdf": materials.of(index, coordinates is not None, turned)}
    return found
