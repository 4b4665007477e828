"""A film of a scene, without files for its frames: video.py SCENE OUT.mp4 [FRAMES]

Pipes raw frames to ffmpeg (apt-get install ffmpeg). An animated scene plays; for any other, the camera goes around it.
"""
import subprocess
import sys

import numpy
import pinocchio_renderer as pn
from thumbnails import on_screen

SIZE = (320, 240)
RATE = 25  # frames a second


def camera_around(scene: pn.Scene, turn: float) -> pn.Camera:
    low, high = map(numpy.array, scene.bounds)
    middle, size = (low + high) / 2, float(numpy.linalg.norm(high - low))
    return pn.Camera(eye=middle + size * numpy.array([numpy.sin(turn), 0.4, numpy.cos(turn)]), target=middle, fov=50)


def main(file: str, out: str, frames: int = 50) -> None:
    scene = pn.load_scene(file)
    width, height = SIZE
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-video_size",
               f"{width}x{height}", "-framerate", str(RATE), "-i", "-", "-pix_fmt", "yuv420p", out]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as encoder, pn.Engine() as engine:
        assert encoder.stdin
        for frame in range(frames):
            now, camera = scene, None
            if scene.duration > 0:
                now = scene.at_time(frame / RATE % scene.duration)
            else:
                camera = camera_around(scene, 2 * numpy.pi * frame / frames)
            picture = engine.render(now, camera, size=SIZE, spp=4)
            encoder.stdin.write(on_screen(picture.color).tobytes())  # waits while ffmpeg is busy
    if encoder.returncode:
        sys.exit(f"ffmpeg ended with {encoder.returncode}")
    print(f"{out}: {frames} frames of {width}x{height}")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
