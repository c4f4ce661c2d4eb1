#!/usr/bin/env python3
"""Measures `hikage sdf bake` against a script on OpenCV: whole processes, PNG to PNG.

    sdf-bench.py HIKAGE_BINARY [--sets 2048x8,4096x16,hard4096x2] [--runs 3] [--work DIR]
    sdf-bench.py --baseline-only

Needs numpy and opencv-python. Both programs read the same masks (SIZExKEYS) and run by turns, so that what else the
machine does hits both. Figures are medians: CPU seconds (user and system, all threads) and the peak of the resident
memory. Seconds differ from machine to machine; what is asked of hikage is therefore a ratio to OpenCV's CPU time.

Exit status: 0 all bars held, 1 a bar was missed or a program failed, 2 wrong usage.
"""

# numpy and cv2 are imported in children only: Linux counts what a process held before exec, its parent's memory at the
# fork, as part of its peak.
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

# CPU seconds of other tools on one machine, measured once: this script's baseline, the core of QuickSDFBlender,
# akasaki1211's sdf_shadow_threshold_map.
OTHERS = {
    "2048x8": (1.89, 2.88, 6.04),
    "2048x16": (3.47, 4.92, 10.4),
    "4096x8": (8.72, 9.45, 24.0),
    "4096x16": (15.1, 18.3, 48.7),
    "hard4096x2": (2.87, 3.20, None),
}
# Codes of 65535 by which the two pictures may differ.
MOST_CODES = 2


def cpu_bar(name):
    """Most CPU time, as a share of OpenCV's; None where no figures are known."""
    if name not in OTHERS:
        return None
    cv2, quick, akasaki = OTHERS[name]
    if name.startswith("hard"):
        return quick / 4 / cv2
    return min(quick / 10, akasaki / 20) / cv2


def memory_bar(size):
    """Most MiB of resident memory."""
    return 10 * size * size / 2**20 + 20


def angles(keys):
    return [180 * k / (keys - 1) for k in range(keys)]


def parse(name):
    match = re.fullmatch(r"(hard)?(\d+)x(\d+)", name)
    if not match:
        sys.exit(f"{name}: expected SIZExKEYS or hardSIZEx2")
    hard, size, keys = bool(match[1]), int(match[2]), int(match[3])
    if not 512 <= size <= 32768 or not 2 <= keys <= 64 or (hard and keys != 2):
        sys.exit(f"{name}: sizes are 512 to 32768, keys 2 to 64 (2 of a hard set)")
    return hard, size, keys


# What the children do.


def make(name, folder):
    """Writes the masks of a set."""
    import cv2
    import numpy as np

    hard, size, keys = parse(name)
    y, x = np.ogrid[:size, :size]

    def disc(centre_x, centre_y):
        return (x - centre_x) ** 2 + (y - centre_y) ** 2 <= 100**2

    def face(u):
        """Lit part of a face, light from the right of the picture (u 0) to behind (1)."""
        v, w = (y + 0.5) / size, (x + 0.5) / size
        # The terminator. Its bends turn with u, far slower than it moves to the right.
        bend = 0.035 * np.sin(np.pi * u) * np.sin(5.0 * v + 0.6) + 0.008 * np.sin(11.0 * v + 4.0 * u)
        lit = w >= 0.02 + 0.955 * u + bend
        # A light on the cheek that stays after the terminator went by, and dwindles.
        cheek = 1.0 - u / 0.7
        if cheek > 0:
            lit |= ((w - 0.28) / (0.085 * cheek)) ** 2 + ((v - 0.53) / (0.12 * cheek)) ** 2 <= 1.0
        # The shadow of the nose, a triangle from its tip to the dark side.
        nose = min(u / 0.5, 1.0)
        run = (0.5 - w) / (0.02 + 0.13 * nose)
        lit &= ~((run >= 0.0) & (run <= 1.0) & (np.abs(v - 0.56 - 0.03 * run) <= (0.01 + 0.035 * nose) * (1.0 - run)))
        return lit

    lit = None
    for k in range(keys):
        if hard:
            now = ~disc(160, 160) if k == 0 else disc(size - 161, size - 161)
        else:
            now = face(k / (keys - 1))
        if lit is not None:
            changed = np.count_nonzero(now & ~lit)
            now = np.logical_and(now, lit)
            assert changed < size, f"{name}: key {k} lights up {changed} pixels again"
            assert (now != lit).any(), f"{name}: key {k} is as the one before"
        lit = now
        assert lit.any() and not lit.all(), f"{name}: key {k} has one colour only"
        if not cv2.imwrite(f"{folder}/{k:02}.png", lit.astype(np.uint8) * 255):
            sys.exit(f"cannot write {folder}/{k:02}.png")


def baseline(folder, keys, out):
    """What a careful script on OpenCV does: signed distances of each key, two keys at a time, one thread."""
    import cv2
    import numpy as np

    cv2.setNumThreads(1)

    def signed(k):
        """Distance to the border, over 0 where lit, and what is lit. The border lies half a pixel off the centres."""
        picture = cv2.imread(f"{folder}/{k:02}.png", cv2.IMREAD_GRAYSCALE)
        lit = cv2.threshold(picture, 127, 255, cv2.THRESH_BINARY)[1]
        distance = cv2.distanceTransform(lit, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        distance -= cv2.distanceTransform(255 - lit, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
        return distance, lit > 0

    share = [np.float32(angle / 180) for angle in angles(keys)]
    half = np.float32(0.5)
    before, lit_before = signed(0)
    codes = np.zeros(lit_before.shape, np.uint16)
    for k in range(1, keys):
        now, lit_now = signed(k)
        band = lit_before & ~lit_now
        inside = before[band] - half
        outside = -now[band] - half
        tau = share[k - 1] + (share[k] - share[k - 1]) * inside / (inside + outside)
        codes[band] = np.rint(tau * np.float32(65535))
        before, lit_before = now, lit_now
    codes[lit_before] = 65535
    if not cv2.imwrite(out, codes):
        sys.exit(f"cannot write {out}")


def compare(one, other):
    """Prints how far two pictures are apart."""
    import cv2
    import numpy as np

    pictures = [cv2.imread(path, cv2.IMREAD_UNCHANGED) for path in (one, other)]
    for i, picture in enumerate(pictures):
        if picture is None or picture.dtype != np.uint16:
            sys.exit(f"{(one, other)[i]}: no PNG of 16 bits")
        if picture.ndim == 3:
            print(f"{(one, other)[i]}: {picture.shape[2]} channels; expected one grey one", file=sys.stderr)
            pictures[i] = picture[:, :, min(2, picture.shape[2] - 1)]
    if pictures[0].shape != pictures[1].shape:
        sys.exit(f"sizes differ: {pictures[0].shape} and {pictures[1].shape}")
    apart = np.abs(pictures[0].astype(np.int32) - pictures[1].astype(np.int32))
    print(json.dumps({"max": int(apart.max()), "mean": float(apart.mean()), "over": int((apart > MOST_CODES).sum())}))


def about():
    """Prints the versions."""
    import cv2
    import numpy as np

    print(f"OpenCV {cv2.__version__}, numpy {np.__version__}")


# The parent.


def me(*arguments):
    return [sys.executable, os.path.abspath(__file__), *map(str, arguments)]


def ask(*arguments):
    """Runs a child for what it prints."""
    done = subprocess.run(me(*arguments), stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{arguments[0]} failed")
    return done.stdout


def measure(command, folder):
    """Runs a program: CPU seconds, wall seconds, peak MiB; None where it failed, with what it said printed."""
    one_thread = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    with open(f"{folder}/log.txt", "w+") as log:
        start = time.monotonic()
        child = subprocess.Popen(command, stdout=log, stderr=log, env={**os.environ, **one_thread})
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.monotonic() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            log.seek(0)
            print(f"{command[0]} ended with {child.returncode}: {log.read(2000).strip()}", file=sys.stderr)
            return None
    unit = 2**20 if sys.platform == "darwin" else 2**10
    return usage.ru_utime + usage.ru_stime, wall, usage.ru_maxrss / unit


def run_set(name, options, folder):
    """Measures one set and prints its row; whether all bars held."""
    _, size, keys = parse(name)
    os.makedirs(folder, exist_ok=True)
    ask("--make", name, folder)
    ours, theirs = f"{folder}/hikage.png", f"{folder}/cv2.png"
    commands = {"cv2": me("--baseline", folder, keys, theirs)}
    if not options.baseline_only:
        given = [f"{angle:.9g}={folder}/{k:02}.png" for k, angle in enumerate(angles(keys))]
        command = [options.hikage, "sdf", "bake", *(part for key in given for part in ("--key", key)), "-o", ours]
        command += ["--bits", "16", "--layout", "single", "--profile", "linear", "--mirror"]
        commands = {"hikage": command, **commands}
    figures = {program: [] for program in commands}
    for _ in range(options.runs):
        for program, command in commands.items():
            result = measure(command, folder)
            if result is None:
                print(f"{name:<12}{program} failed")
                return False
            figures[program].append(result)
    median = {program: [statistics.median(column) for column in zip(*rows)] for program, rows in figures.items()}
    cpu, wall, peak = median["cv2"]
    if options.baseline_only:
        known = f"{OTHERS[name][0]:.2f}" if name in OTHERS else "-"
        print(f"{name:<12}{cpu:>10.2f}{wall:>10.2f}{peak:>10.0f}{known:>12}", flush=True)
        return True
    own_cpu, own_wall, own_peak = median["hikage"]
    apart = json.loads(ask("--compare", ours, theirs))
    ratio, bar, room = own_cpu / cpu, cpu_bar(name), memory_bar(size)
    missed = [
        what
        for what, bad in (
            ("CPU", bar is not None and ratio > bar),
            ("memory", own_peak > room),
            (f"{apart['over']} pixels", apart["max"] > MOST_CODES),
        )
        if bad
    ]
    print(
        f"{name:<12}{own_cpu:>10.3f}{own_wall:>10.3f}{own_peak:>10.0f}{room:>10.0f}{cpu:>10.2f}{peak:>10.0f}{ratio:>9.4f}"
        f"{'-' if bar is None else format(bar, '.4f'):>9}{apart['max']:>7}{apart['mean']:>9.5f}"
        f"  {'MISSED: ' + ', '.join(missed) if missed else 'held'}",
        flush=True,
    )
    return not missed


def main():
    hidden = {"--make": make, "--baseline": lambda f, k, o: baseline(f, int(k), o), "--compare": compare, "--about": about}
    if sys.argv[1:] and sys.argv[1] in hidden:
        hidden[sys.argv[1]](*sys.argv[2:])
        return 0
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hikage", nargs="?", help="the program to measure")
    parser.add_argument("--sets", default="2048x8,2048x16,4096x8,4096x16,hard4096x2,1024x8", help="which masks")
    parser.add_argument("--runs", type=int, default=3, help="runs of each program; the median counts")
    parser.add_argument("--work", help="where masks and pictures go, and stay; else a folder that is removed")
    parser.add_argument("--baseline-only", action="store_true", help="measure OpenCV alone")
    options = parser.parse_args()
    if options.runs < 1 or (options.hikage is None and not options.baseline_only):
        parser.error("expected a program to measure and at least one run")
    sets = options.sets.split(",")
    for name in sets:
        parse(name)
    if options.hikage:
        options.hikage = os.path.abspath(options.hikage)

    print(f"{os.cpu_count()} cores, {ask('--about').strip()}; medians of {options.runs}; hikage {options.hikage or '-'}")
    if options.baseline_only:
        print(f"{'set':<12}{'CPU s':>10}{'wall s':>10}{'peak MiB':>10}{'known CPU s':>12}", flush=True)
    else:
        print(
            f"{'set':<12}{'CPU s':>10}{'wall s':>10}{'peak MiB':>10}{'bar MiB':>10}{'cv2 CPU':>10}{'cv2 MiB':>10}{'ratio':>9}"
            f"{'bar':>9}{'codes':>7}{'mean':>9}  bars",
            flush=True,
        )
    with tempfile.TemporaryDirectory(prefix="sdf-bench-") as temporary:
        held = [run_set(name, options, os.path.join(options.work or temporary, name)) for name in sets]
    return 0 if all(held) else 1


if __name__ == "__main__":
    sys.exit(main())
