"""The charts of a page, as SVG files. Exit code 3 where matplotlib is missing."""
import fcntl
import json
import math
import random
import sys
import textwrap

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import FuncFormatter, NullFormatter
except ImportError:
    sys.exit(3)

# Text stays text, so that charts are small; a width that every reader's fonts come close to.
plt.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "pinocchio", "font.size": 9.5,
    "font.family": "sans-serif", "font.sans-serif": ["DejaVu Sans", "Verdana", "sans-serif"],
    "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "#888888",
    "axes.labelcolor": "#333333", "xtick.color": "#555555", "ytick.color": "#555555",
    "axes.titlesize": 11, "axes.titlelocation": "left", "figure.facecolor": "white"})

CLOCKS = {"frame": "frame time", "cpu": "processor time a frame"}
METRICS = {"flip": "mean FLIP", "rmse": "RMSE", "relmse": "relative MSE"}
AXES = {}  # names and titles, in their order: results.json has them
COLOURS = ["#3b6fb6", "#d1495b", "#2a9d8f", "#e09f3e", "#7d5ba6", "#5c946e", "#b56576", "#4d908e",
           "#c9713a", "#6c757d", "#8d99ae", "#a26769", "#577590", "#9a8c98", "#386641", "#111111", "#1098ad"]
MARKERS = "osD^vPX<>phd8H*PX"
FRONT_COLOUR = "#222222"


def style(axis):
    index = list(AXES).index(axis) if axis in AXES else 0
    return COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)]


def named(point):
    """What a person types to get the point."""
    return point["options"] or "default"


def charted(points, reference="centre"):
    """The first point of each setting, with an error to show."""
    seen, chosen = set(), []
    for point in points:
        key = json.dumps(point["settings"], sort_keys=True)
        if point["reference"] == reference and point["flip"] is not None and key not in seen:
            seen.add(key)
            chosen.append(point)
    return chosen


def short(value):
    """A tick's label: 0.05, 20, 500 k, 2 M."""
    for size, letter in ((1e6, " M"), (1e3, " k")):
        if value >= size:
            return f"{value / size:g}{letter}"
    return f"{value:g}"


class LogScale:
    """Places values on a log axis; 0, which has no place there, on a floor below the least of the others."""

    def __init__(self, values, zero_name):
        positive = [v for v in values if v > 0]
        self.zero_name = zero_name
        self.has_zero = len(positive) < len(values)
        self.floor = 10 ** math.floor(math.log10(min(positive)) - 0.5) if positive else 1e-6
        self.top = max(positive, default=self.floor)
        self.bottom = self.floor if self.has_zero else min(positive, default=self.floor)

    def __call__(self, value):
        return value if value > 0 else self.floor

    def apply(self, axes, which):
        getattr(axes, f"set_{which}scale")("log")
        room = max((self.top / self.bottom) ** 0.06, 1.08)
        getattr(axes, f"set_{which}lim")(self.bottom / room, self.top * room)
        decades = math.log10(self.top / self.bottom)
        axis = axes.xaxis if which == "x" else axes.yaxis
        if decades < 2:
            low, high = self.bottom / room, self.top * room
            steps = [1, 2, 5] if decades > 0.7 else [1, 1.5, 2, 3, 4, 5, 6, 8]
            ticks = [m * 10.0 ** e for e in range(-12, 12) for m in steps if low <= m * 10.0 ** e <= high]
            axis.set_ticks(ticks)
            axis.set_major_formatter(FuncFormatter(lambda v, _: short(v)))
        axis.set_minor_formatter(NullFormatter())
        if self.has_zero:
            line = axes.axhline if which == "y" else axes.axvline
            line(self.floor, color="#bbbbbb", linewidth=0.8, linestyle=":")
            at = (0.995, self.floor) if which == "y" else (self.floor, 0.995)
            transform = axes.get_yaxis_transform() if which == "y" else axes.get_xaxis_transform()
            axes.text(*at, self.zero_name, transform=transform, color="#888888", fontsize=8.5,
                      ha="right" if which == "y" else "left", va="bottom" if which == "y" else "top",
                      rotation=0 if which == "y" else 90)


def write_whole(path, write):
    """Calls write(part) with a new file beside `path`, which gets its name once it is whole. What is left of it
    when the program is killed is locked by nobody: the next run sweeps it (core/files/part_file.h)."""
    letters = "".join(random.choices("abcdefghijklmnopqrstuvwxyz0123456789", k=6))
    part = path.with_name(f".{path.stem}-{letters}.part{path.suffix}")
    with open(part, "x", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        try:
            write(part)
            part.replace(path)
        except BaseException:
            part.unlink(missing_ok=True)
            raise


def save(figure, path):
    write_whole(path, lambda part: figure.savefig(part, metadata={"Date": None}))
    plt.close(figure)


def grid(axes):
    axes.grid(True, which="major", color="#e6e6e6", linewidth=0.7)
    axes.set_axisbelow(True)


def front_chart(path, points, front, cost, cost_label, error, title, costs_nothing):
    """Every point by cost and error; the front's points are numbered, and listed by their options."""
    points = charted(points)
    on_front = sorted((p for p in points if front in p["pareto"]), key=cost)
    figure, axes = plt.subplots(figsize=(9.6, 5.4))
    figure.subplots_adjust(left=0.085, right=0.60, top=0.92, bottom=0.115)
    grid(axes)
    place_x = LogScale([cost(p) for p in points], costs_nothing)
    place_y = LogScale([p[error] for p in points], "exact")
    place_x.apply(axes, "x")
    place_y.apply(axes, "y")
    for axis in AXES:
        mine = [p for p in points if p["axis"] == axis and p["options"]]
        colour, marker = style(axis)
        if mine:
            axes.scatter([place_x(cost(p)) for p in mine], [place_y(p[error]) for p in mine], s=26, c=colour,
                         marker=marker, alpha=0.75, linewidths=0, label=AXES[axis], zorder=3)
    for p in points:
        if not p["options"]:
            axes.scatter([place_x(cost(p))], [place_y(p[error])], s=130, c="#f2b705", marker="*",
                         edgecolors=FRONT_COLOUR, linewidths=0.7, label="default", zorder=5)
    xs = [place_x(cost(p)) for p in on_front]
    ys = [place_y(p[error]) for p in on_front]
    axes.step(xs, ys, where="post", color=FRONT_COLOUR, linewidth=1.1, zorder=2)
    for number, (x, y) in enumerate(zip(xs, ys), 1):
        axes.scatter([x], [y], s=90, facecolors="none", edgecolors=FRONT_COLOUR, linewidths=1.1, zorder=4)
        axes.annotate(str(number), (x, y), xytext=(6, 6), textcoords="offset points", fontsize=9,
                      fontweight="bold", color=FRONT_COLOUR, zorder=6)
    axes.set_xlabel(cost_label)
    axes.set_ylabel(METRICS[error] + " against the reference")
    axes.set_title(title)
    list_front(figure, axes, on_front, cost, error)
    save(figure, path)


def list_front(figure, axes, on_front, cost, error):
    """The front by its options, and what the marks mean, to the right of the chart."""
    wrapped = [textwrap.wrap(named(p), 44, break_long_words=False, break_on_hyphens=False) for p in on_front]
    left, line = 0.625, min(0.036, 0.55 / max(sum(map(len, wrapped)), 1))
    figure.text(left, 0.905, "Pareto front", fontweight="bold", color=FRONT_COLOUR)
    y = 0.905 - 0.036
    for number, lines in enumerate(wrapped, 1):
        figure.text(left, y, f"{number}", fontsize=8.8, fontweight="bold", color=FRONT_COLOUR)
        for part in lines:
            figure.text(left + 0.022, y, part, fontsize=8.8, color="#333333")
            y -= line
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower left", bbox_to_anchor=(left - 0.012, 0.02), fontsize=8.2, ncol=2,
                  frameon=False, handletextpad=0.2, columnspacing=0.8, labelspacing=0.35)


def axis_chart(path, points, axis, clock):
    """One axis: its values by time and FLIP, in their order."""
    mine = [p for p in points if p["axis"] == axis and p["flip"] is not None]
    figure, axes = plt.subplots(figsize=(4.7, 3.3))
    figure.subplots_adjust(left=0.175, right=0.955, top=0.9, bottom=0.15)
    grid(axes)
    place = LogScale([p["flip"] for p in mine], "exact")
    colour, marker = style(axis)
    xs, ys = [p["ratio"] for p in mine], [place(p["flip"]) for p in mine]
    if axis not in ("design", "combined", "exchange"):  # those have no order
        axes.plot(xs, ys, color=colour, linewidth=0.9, alpha=0.6)
    axes.plot(xs, ys, marker, color=colour, markersize=5.5, alpha=0.9)
    width = (max(xs) / min(xs)) if xs else 1
    axes.set_xscale("log")
    room = max(width ** 0.18, 1.25)
    low, high = min(xs) / 1.12, max(xs) * room
    axes.set_xlim(low, high)
    ticks = [m * 10.0 ** e for e in range(-3, 6) for m in ((1, 2, 5) if high / low > 4 else (1, 1.5, 2, 3, 4, 5, 6, 8))
             if low <= m * 10.0 ** e <= high]
    axes.xaxis.set_ticks(ticks)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    place.apply(axes, "y")
    if place.top / place.bottom < 1.2:  # equal errors: a line in the middle
        axes.set_ylim(place.bottom / 2, place.top * 2)
        axes.yaxis.set_ticks([place.bottom])
        axes.yaxis.set_major_formatter(FuncFormatter(lambda v, _: f"{v:.2g}"))
    taken = []
    for p, x, y in sorted(zip(mine, xs, ys), key=lambda item: item[1]):
        name = p["value"] + (" *" if not p["options"] else "")
        axes.annotate(name, (x, y), xytext=(5, free_offset(axes, x, y, taken)), textcoords="offset points",
                      fontsize=8.2, color="#333333")
    axes.set_title(AXES.get(axis, axis))
    axes.set_xlabel(f"{clock}, times raster-only")
    axes.set_ylabel("mean FLIP" + (" (area)" if mine and mine[0]["reference"] == "area" else ""))
    save(figure, path)


def free_offset(axes, x, y, taken):
    """Points above or below (x, y) where a label meets none of those set before."""
    px, py = axes.transData.transform((x, y)) / axes.figure.dpi * 72
    for offset in (4, -10, 14, -20, 24, -30, 34):
        if all(abs(px - tx) > 62 or abs(py + offset - ty) > 9 for tx, ty in taken):
            break
    taken.append((px, py + offset))
    return offset


def bytes_moved(point):
    return point["bytes_gpu_to_cpu"] + point["bytes_cpu_to_gpu"]


def ratio(point):
    return point["ratio"]


def draw_charts(folder, points, run):
    """The charts' files with their titles, in the page's order."""
    AXES.update(run["axes"])
    clock = CLOCKS[run["clock"]]
    charts = []
    exchanged = [p for p in points if bytes_moved(p) > 0]
    if charted(points):
        for error, label in METRICS.items():
            name = f"error-{error}.svg"
            front_chart(folder / name, points, error, ratio, f"{clock}, times raster-only in the same run",
                        error, f"{label} against {clock}", "")
            charts.append((name, f"{label} against {clock}, with the Pareto front"))
    if charted(exchanged):
        front_chart(folder / "error-bytes.svg", exchanged, "bytes", bytes_moved,
                    "bytes a frame, both ways", "flip", "mean FLIP against bytes exchanged", "none")
        charts.append(("error-bytes.svg", "mean FLIP against the bytes exchanged, with the Pareto front"))
    panels = []
    for axis in dict.fromkeys(p["axis"] for p in points):
        if any(p["axis"] == axis and p["flip"] is not None for p in points):
            axis_chart(folder / f"axis-{axis}.svg", points, axis, clock)
            panels.append((f"axis-{axis}.svg", AXES.get(axis, axis)))
    return charts, panels
