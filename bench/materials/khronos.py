"""Pictures by Khronos' glTF Sample Renderer (npm), in headless Chromium over a software OpenGL. It rasterises: a sky lights by prefiltered means.

For software its prefiltering takes an eighth of its samples and its table of GGX an eighth of its side, which smooth skies allow.
"""
import base64
import copy
import functools
import http.server
import io
import math
import pathlib
import shutil
import threading

import numpy

import gltf

FEWER = {"this.ggxSampleCount = 1024": "this.ggxSampleCount = 128", "this.lambertianSampleCount = 2048": "this.lambertianSampleCount = 256",
         "this.lutResolution = 1024": "this.lutResolution = 128"}
GAMMA = 2.2  # of its output
MOST_SECONDS = 600  # that it may take for a picture
BROWSER = ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")


def with_camera(document, view, aspect):
    """The document with one camera more, its last."""
    eye, target, fov = (numpy.array(view[0], float), numpy.array(view[1], float), view[2])
    away = numpy.linalg.norm(eye - target)
    back = (eye - target) / away
    right = numpy.cross((0, 1, 0), back)
    right /= numpy.linalg.norm(right)
    place = numpy.eye(4)
    place[:3] = numpy.stack([right, numpy.cross(back, right), back, eye], 1)
    document = copy.deepcopy(document)
    lens = {"yfov": math.radians(fov), "aspectRatio": aspect, "znear": 0.01 * away, "zfar": 100 * away}
    document.setdefault("cameras", []).append({"type": "perspective", "perspective": lens})
    document["nodes"].append({"camera": len(document["cameras"]) - 1, "matrix": place.T.ravel().tolist()})
    document["scenes"][document.get("scene", 0)].setdefault("nodes", []).append(len(document["nodes"]) - 1)
    return document


def write_hdr(path, light):
    """A Radiance file without run lengths. light: (height, width, 3), linear."""
    exponent = numpy.ceil(numpy.log2(numpy.maximum(light.max(-1, keepdims=True), 1e-30)) + 1e-6)
    texels = numpy.concatenate([numpy.clip(light / numpy.exp2(exponent) * 256, 0, 255), exponent + 128], -1).astype(numpy.uint8)
    path.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % light.shape[:2] + texels.tobytes())


class Silent(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class SampleRenderer:
    def __init__(self, package, folder, size):
        """package: the unpacked npm package. folder: for its files and for those that are drawn."""
        import PIL.Image
        import selenium.webdriver

        self.folder, self.size = folder, size
        shutil.copytree(package / "dist", folder / "dist", dirs_exist_ok=True)
        module = folder / "dist/gltf-viewer.module.js"
        text = module.read_text(encoding="utf-8")
        for many, few in FEWER.items():
            if many not in text:
                raise RuntimeError(f"{module}: '{many}' is not there: another version of the package?")
            text = text.replace(many, few)
        module.write_text(text, encoding="utf-8")
        shutil.copy(pathlib.Path(__file__).with_name("khronos.html"), folder)
        PIL.Image.new("RGB", (4, 4)).save(folder / "black.png")
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=str(folder)))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        options = selenium.webdriver.ChromeOptions()
        for argument in BROWSER:
            options.add_argument(argument)
        self.browser = selenium.webdriver.Chrome(options=options, service=selenium.webdriver.ChromeService("/usr/bin/chromedriver"))
        self.browser.command_executor.client_config.timeout = MOST_SECONDS
        self.browser.set_script_timeout(MOST_SECONDS)
        self.browser.get(f"http://127.0.0.1:{server.server_port}/khronos.html")

    def render(self, document, data, view, sky):
        """(height, width, 3), linear; sky: name of a file in the folder. A pixel is black where nothing is seen."""
        import PIL.Image

        gltf.write(self.folder / "model.glb", with_camera(document, view, self.size[0] / self.size[1]), data)
        found = self.browser.execute_async_script("const done = arguments[3]; draw(...[...arguments].slice(0, 3)).then(done, e => done(`${e}`))",
                                                  "model.glb", sky, self.size)
        if not found.startswith("data:"):
            raise RuntimeError(found)
        picture = PIL.Image.open(io.BytesIO(base64.b64decode(found.partition(",")[2]))).convert("RGB")
        return (numpy.asarray(picture, numpy.float32) / 255) ** GAMMA

    def close(self):
        self.browser.quit()
