"""Mitsuba's time for its own sphere, which the spheres' page measures, and for the triangles that we draw."""
import time

import cases
import measure
import skies
import theirs

VIEW = (cases.EYE, cases.TARGET, cases.FOV)
SPHERES = [(0.0, 0.33), (0.5, 0.67), (1.0, 1.0)]


def write_obj(path):
    points, faces = cases.sphere()
    lines = [f"{kind} {x:.9g} {y:.9g} {z:.9g}" for kind in ("v", "vn") for x, y, z in points]
    lines += ["f " + " ".join(f"{i + 1}//{i + 1}" for i in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")
    return path


def run(mitsuba, folder, size, tell):
    """Yields a row for each sphere under the sky with a sun: milliseconds of processor time, the least of several in turn."""
    mesh = {"type": "obj", "filename": str(write_obj(folder / "sphere.obj"))}
    for metallic, roughness in SPHERES:
        scenes = [theirs.Scene(mitsuba, {"ball": {**shape, "bsdf": theirs.principled(theirs.rgb([1.0] * 3), metallic, roughness)}}, skies.sunny(), VIEW, size)
                  for shape in ({"type": "sphere"}, mesh)]
        times = ([], [])
        for seed in range(8):  # the first compiles
            for scene, found in zip(scenes, times):
                begin = time.process_time()
                scene.render(measure.SAMPLES, seed)
                found.append(1e3 * (time.process_time() - begin))
        row = {"name": cases.Case("grid", cases.COLOURS["white"], metallic, roughness).name, "ms": [min(t) for t in times]}
        tell(f"{row['name']}: Mitsuba's sphere {row['ms'][0]:.0f} ms, triangles {row['ms'][1]:.0f} ms")
        yield row


def table(rows):
    lines = ["| sphere | Mitsuba's own sphere, ms | the same triangles as ours, ms | ratio |", "|---|---:|---:|---:|"]
    lines += [f"| {r['name']} | {r['ms'][0]:.0f} | {r['ms'][1]:.0f} | {r['ms'][1] / r['ms'][0]:.2f} |" for r in rows]
    return "\n".join(lines)
