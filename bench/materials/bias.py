"""Whether the estimator is without bias: means of many samples of a sphere over those of the program's own reference, which is other code in double and samples nothing at random."""
import cases
import figures

SIZE = (48, 36)
SAMPLES = 1024  # a picture; two pictures
REFERENCE_SAMPLES = 16  # of the pixel; 256 of the sky in each
VIEW = (cases.EYE, cases.TARGET, cases.FOV)
SPHERES = [(0.0, 0.33), (0.0, 1.0), (0.5, 0.67), (1.0, 0.33), (1.0, 1.0)]


def run(ours, files, folder, tell):
    """Yields a row for each sphere under the sky with a sun."""
    for metallic, roughness in SPHERES:
        case = cases.Case("grid", cases.COLOURS["white"], metallic, roughness)
        scene = cases.write_sphere(folder / "sphere.glb", case)
        draw = lambda samples, seed, options=(): ours.render(scene, VIEW, files["sun"], samples, seed, options)[0]
        pictures = [draw(SAMPLES, seed) for seed in (1, 2)]
        reference = draw(REFERENCE_SAMPLES, 3, ["--precise"])
        mask = figures.covered(*pictures, reference)
        mean = lambda picture: float(figures.mean(picture, mask).mean())
        row = {"name": case.name, "shares": [mean(p) / mean(reference) for p in pictures],
               "brightest": [float(figures.grey(p)[mask].max() / figures.grey(reference)[mask].max()) for p in pictures]}
        tell(f"{row['name']}: mean of {SAMPLES} samples / reference {row['shares'][0]:.4f}, {row['shares'][1]:.4f}")
        yield row


def table(rows):
    lines = [f"| sphere | mean of {SAMPLES} samples / reference | another seed | brightest pixel / reference's |", "|---|---:|---:|---:|"]
    lines += [f"| {r['name']} | {r['shares'][0]:.4f} | {r['shares'][1]:.4f} | {r['brightest'][0]:.3f} |" for r in rows]
    return "\n".join(lines)
