"""What is told of a picture: mean colour, noise, fireflies. Pictures are arrays (height, width, 4), linear, the last channel what is covered."""
import numpy

FIREFLY = 5.0  # times the local median
FAINT = 0.1  # of the mean: what is darker is no firefly


def covered(*pictures):
    """Pixels that the object fills in all of them."""
    return numpy.logical_and.reduce([p[..., 3] > 0.9999 for p in pictures])


def mean(picture, mask):
    return picture[mask][:, :3].astype(float).mean(axis=0)


def grey(picture):
    return picture[..., :3].astype(float).mean(axis=-1)


def noise(a, b, mask):
    """Of one of two pictures that differ by their seeds: rms over mean."""
    difference = (grey(a) - grey(b))[mask]
    level = 0.5 * (grey(a) + grey(b))[mask].mean()
    return float(numpy.sqrt((difference ** 2).mean() / 2) / max(level, 1e-12))


def fireflies(picture, mask):
    """Pixels brighter than 5 times the median of the 5 x 5 around, of those that the object fills."""
    level = numpy.where(mask, grey(picture), numpy.nan)
    around = numpy.lib.stride_tricks.sliding_window_view(numpy.pad(level, 2, constant_values=numpy.nan), (5, 5))
    found = 0
    for y in range(level.shape[0]):  # a row at a time, for the memory
        columns = numpy.flatnonzero(mask[y])
        if len(columns):
            median = numpy.nanmedian(around[y, columns].reshape(len(columns), 25), axis=1)
            bright = level[y, columns]
            found += int(((bright > FIREFLY * median) & (bright > FAINT * numpy.nanmean(level))).sum())
    return found


def rings(picture, mask, mu, parts=12):
    """Means of rings of equal width in n.v, from the edge to the centre: under an even sky each pixel of a ring is the same."""
    which = numpy.minimum((mu * parts).astype(int), parts - 1)
    level = grey(picture)
    return [float(level[mask & (which == k)].mean()) for k in range(parts) if (mask & (which == k)).sum() > 20]


def finite(picture):
    return bool(numpy.isfinite(picture).all())


def halves(pictures, names):
    """Those of the pictures as half floats, for keeping."""
    return {name: numpy.clip(numpy.nan_to_num(pictures[name]), 0, 65504).astype(numpy.float16) for name in names if name in pictures}
