"""One object drawn by us and by Mitsuba under the same sky: noise at equal samples and at equal time, means, fireflies."""
import figures

SAMPLES = 16
MORE_SAMPLES = 32  # for mean colours, beside two pictures of 16
MOST_SAMPLES = 1024  # for equal time


ROUNDS = 3  # of both in turn, so that both have the machine's quiet moments


def compare(ours, theirs):
    """`ours` and `theirs` are render(samples, seed) -> picture, ms. Returns the figures, the mask and both pictures of 16 samples."""
    theirs(SAMPLES, 0)  # compiles
    rounds = [(ours(SAMPLES, seed), theirs(SAMPLES, seed)) for seed in range(1, ROUNDS + 1)]
    our_ms, their_ms = (min(r[who][1] for r in rounds) for who in (0, 1))
    (a, c), (b, d) = ([picture for picture, _ in r] for r in rounds[:2])
    many = 0.25 * (a + b) + 0.5 * ours(MORE_SAMPLES, 3)[0]
    their_many = 0.25 * (c + d) + 0.5 * theirs(MORE_SAMPLES, 3)[0]
    mask = figures.covered(a, c)
    as_long = max(1, min(MOST_SAMPLES, round(SAMPLES * their_ms / our_ms)))
    e, f = (ours(as_long, seed)[0] for seed in (1, 2))
    found = {
        "pixels": int(mask.sum()), "finite": all(map(figures.finite, (a, b, many))),
        "ours": {"mean": figures.mean(many, mask).tolist(), "noise": figures.noise(a, b, mask), "ms": our_ms,
                 "fireflies": figures.fireflies(a, mask), "noise_in_their_time": figures.noise(e, f, mask), "samples_in_their_time": as_long},
        "theirs": {"mean": figures.mean(their_many, mask).tolist(), "noise": figures.noise(c, d, mask), "ms": their_ms,
                   "fireflies": figures.fireflies(c, mask)}}
    return found, mask, {"ours": a, "theirs": c, "ours, many": many, "theirs, many": their_many}
