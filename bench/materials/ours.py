"""Our pictures: the program over a scene, and what it took."""
import json
import pathlib
import subprocess


class Ours:
    """Draws with --mode raytrace; `extra` are further options of the program."""

    def __init__(self, program, folder, threads, size, extra=()):
        self.program, self.folder, self.threads, self.size, self.extra = program, folder, threads, size, list(extra)

    def render(self, scene, view, sky, samples, seed=0, options=()):
        """The picture (height, width, 4), linear, and the milliseconds of its frame, without reading and writing files."""
        import numpy
        import OpenEXR

        eye, target, fov = view
        picture, stats = self.folder / "ours.exr", self.folder / "ours.json"
        three = lambda p: ",".join(f"{x:.9g}" for x in p)
        light = ["--environment", sky] if sky else []
        command = [self.program, "render", scene, "--mode", "raytrace", "--quiet", "--size", "x".join(map(str, self.size)), "--eye", three(eye),
                   "--target", three(target), "--up", "0,1,0", "--fov", f"{fov:.9g}", "--spp", str(samples), "--seed", str(seed), "--threads",
                   str(self.threads), "--aov", "none", "-o", picture, "--stats-json", stats, *light, *options, *self.extra]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(done.stderr.strip() or f"{self.program} ended with {done.returncode}")
        figures = json.loads(pathlib.Path(stats).read_text())
        pixels = OpenEXR.File(str(picture)).channels()["RGBA"].pixels
        return numpy.asarray(pixels, numpy.float32), 1e3 * figures["frames"] / figures["fps"]

    def version(self):
        text = subprocess.run([str(self.program), "info", "--system", "--json"], capture_output=True, text=True).stdout
        try:
            found = json.loads(text)
        except ValueError:
            found = {}
        return {key: found.get(key) for key in ("pinocchio", "cpu", "cores", "simd")}
