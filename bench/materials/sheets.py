"""Contact sheets as PNG files of at most 300 KB. Every second pixel is shown, so noise stays what it is."""
import numpy

MOST_BYTES = 300_000
GAP = 2


def screen(picture, background=0.0):
    """Linear light as a screen shows it, (height, width, 3), 0 to 255."""
    colour = numpy.nan_to_num(picture[..., :3].astype(float), nan=0.0, posinf=1e4) + background * (1 - picture[..., 3:4])
    colour = numpy.clip(colour, 0, 1)
    srgb = numpy.where(colour <= 0.0031308, 12.92 * colour, 1.055 * colour ** (1 / 2.4) - 0.055)
    return numpy.round(255 * srgb).astype(numpy.uint8)


def opaque(picture):
    """The same of a picture without alpha, or with alpha before black."""
    return screen(numpy.concatenate([picture[..., :3], numpy.ones_like(picture[..., :1])], -1))


def grid(tiles, columns):
    """Tiles of one size, row by row."""
    height, width, _ = tiles[0].shape
    rows = -(-len(tiles) // columns)
    whole = numpy.full((rows * (height + GAP) - GAP, columns * (width + GAP) - GAP, 3), 255, numpy.uint8)
    for i, tile in enumerate(tiles):
        y, x = (i // columns) * (height + GAP), (i % columns) * (width + GAP)
        whole[y:y + height, x:x + width] = tile
    return whole


def save(pixels, path):
    import PIL.Image

    path.parent.mkdir(parents=True, exist_ok=True)
    picture = PIL.Image.fromarray(pixels)
    for colours in (256, 160, 96, 64, 40, 24):
        picture.quantize(colours, dither=PIL.Image.Dither.NONE).save(path, optimize=True)
        if path.stat().st_size <= MOST_BYTES:
            return


def of_spheres(folder, rows, path):
    """Under the sky with the sun: a row of ours and a row of Mitsuba's for each of three metallics."""
    tiles, columns = [], 0
    for metallic in (0.0, 0.5, 1.0):
        chosen = sorted((r for r in rows if r["sky"] == "sun" and r["kind"] == "grid" and r["metallic"] == metallic), key=lambda r: r["roughness"])
        columns = len(chosen)
        for who in ("ours", "theirs"):
            for row in chosen:
                picture = numpy.load(folder / f"sphere-sun-{row['name']}.npz")[who].astype(float)
                height, width, _ = picture.shape
                side = int(0.88 * height) // 2 * 2
                y, x = (height - side) // 2, (width - side) // 2
                tile = picture[y:y + side:2, x:x + side:2].copy()
                tile[..., :3] *= tile[..., 3:4]  # ours sees the sky behind
                tiles.append(screen(tile))
    if tiles:
        save(grid(tiles, columns), path)


def of_models(folder, path, most=20):
    """Ours at 16 samples, every second pixel of each model."""
    files = sorted(folder.glob("model-*.npz"))[:most]
    tiles = [screen(numpy.load(file)["sheet"][::2, ::2].astype(float)) for file in files]
    if tiles:
        save(grid(tiles, 5), path)
