"""A data set in shards, drawn by many processes or machines: farm_ray.py SCENE OUT_FOLDER PICTURES [WORKERS [SHARD]]

Ray (pip install ray) runs a worker for each engine. Picture number i depends on SEED and i alone, so neither the number
of workers nor the order changes a byte. A shard is a tar file that WebDataset reads; it gets its name when it is
complete. Run the same command again to go on: complete shards are left as they are. A shard that fails is tried
TRIES times and then reported; the others are drawn all the same.
"""
import io
import json
import os
import pathlib
import sys
import tarfile
import time
from typing import Any

import numpy
import pinocchio_renderer as pn
import ray  # type: ignore[import, unused-ignore]
from dataset import FOCAL, SIZE, random_camera

SEED = 0
TRIES = 2
QUEUED = 2  # shards that a worker has at a time: one that it draws, one that waits


def name_of(shard: int) -> str:
    return f"shard-{shard:06d}.tar"


class Worker:
    """Draws shards with one engine. The scene is read once."""

    def __init__(self, file: str, out: str, threads: int) -> None:
        self.scene, self.out, self.engine = pn.load_scene(file), pathlib.Path(out), pn.Engine(threads=threads)

    def draw(self, shard: int, first: int, last: int) -> int:
        poses = [random_camera(self.scene, numpy.random.default_rng([SEED, i])) for i in range(first, last)]
        center = (SIZE[0] - 1) / 2, (SIZE[1] - 1) / 2
        cameras = [pn.Camera.from_intrinsics(SIZE, FOCAL, FOCAL, *center, pose) for pose in poses]
        arrays: dict[str, Any] = self.engine.render_many(self.scene, cameras, SIZE, outputs=["color", "depth", "objects"])
        part = self.out / f".{name_of(shard)}.part"
        with tarfile.open(part, "w") as tar:
            for i in range(last - first):
                add(tar, f"{first + i:08d}.json", json.dumps({"pose": poses[i].tolist(), "focal": FOCAL, "center": center}).encode())
                for array in arrays:
                    buffer = io.BytesIO()
                    numpy.save(buffer, arrays[array][i].astype(numpy.float16) if array == "color" else arrays[array][i])
                    add(tar, f"{first + i:08d}.{array}.npy", buffer.getvalue())
        os.replace(part, self.out / name_of(shard))
        return shard


def add(tar: tarfile.TarFile, name: str, content: bytes) -> None:
    member = tarfile.TarInfo(name)  # time 0, so that equal pictures are equal files
    member.size = len(content)
    tar.addfile(member, io.BytesIO(content))


def main(file: str, out: str, pictures: int, workers: int = 2, shard_size: int = 100) -> int:
    folder = pathlib.Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    ranges = {s: (s * shard_size, min((s + 1) * shard_size, pictures)) for s in range(-(-pictures // shard_size))}
    left = [shard for shard in ranges if not (folder / name_of(shard)).is_file()]
    drawn, tries = 0, dict.fromkeys(left, 0)
    failed: list[int] = []
    running: dict[Any, tuple[int, Any]] = {}
    cluster: Any = ray
    ray.init(ignore_reinit_error=True, log_to_driver=False, include_dashboard=False)
    cores = int(cluster.cluster_resources()["CPU"])
    workers = max(1, min(workers, cores))
    threads = cores // workers
    remote: Any = ray.remote(num_cpus=threads, max_restarts=-1)(Worker)
    actors = [remote.remote(str(pathlib.Path(file).resolve()), str(folder.resolve()), threads) for _ in range(workers)]
    ray.get([actor.__ray_ready__.remote() for actor in actors])
    begin = time.perf_counter()
    free = actors * QUEUED  # an actor for each shard that may be given out: back-pressure
    while left or running:
        while left and free:
            shard, actor = left.pop(0), free.pop(0)
            tries[shard] += 1
            running[actor.draw.remote(shard, *ranges[shard])] = shard, actor
        done, _ = ray.wait(list(running))
        shard, actor = running.pop(done[0])
        free.append(actor)
        try:
            ray.get(done[0])
            drawn += 1
        except ray.exceptions.RayError as error:  # an exception in draw, or a worker that died
            print(f"{name_of(shard)}: {str(error).strip().splitlines()[-1]}", file=sys.stderr)
            (left if tries[shard] < TRIES else failed).append(shard)
    seconds = time.perf_counter() - begin
    print(f"{out}: {drawn} shards drawn in {seconds:.2f} s, {len(ranges) - drawn - len(failed)} were there, {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:])))
