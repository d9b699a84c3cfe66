#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a hologram takes on a cluster, stage by stage: a model that is fitted to measured runs (measure.py) and to what machines
and prices are said to be. docs/cluster.md explains it.

usage: model.py [MEASURED.json] [--side M] [--pitch M] ... [--nodes 16,64,256]       --help lists the rest
"""
import argparse
import json
import math
import pathlib

HALF, COMPLEX_HALF = 2, 4       # bytes
BLOCK = 8 * 512, 8 * 384        # samples of which the narrow camera adds the light before it is sent
NUMBERS = 8                     # bytes of a complex number in a message or a plane
STREAM_BITS = 0.05              # of a sample in a stream at 35 dB, as measured


def fit(runs):
    """Seconds of a start and of a sample, by least squares of the relative error."""
    weights = [1 / run["seconds"]**2 for run in runs]
    total = sum(weights)
    mean_n = sum(w * run["samples"] for w, run in zip(weights, runs)) / total
    mean_s = sum(w * run["seconds"] for w, run in zip(weights, runs)) / total
    slope = (sum(w * (run["samples"] - mean_n) * (run["seconds"] - mean_s) for w, run in zip(weights, runs)) /
             sum(w * (run["samples"] - mean_n)**2 for w, run in zip(weights, runs)))
    return mean_s - slope * mean_n, slope


class Model:
    def __init__(self, measured):
        stages = {run["stage"] for run in measured["runs"]}
        self.rates = {stage: fit([run for run in measured["runs"] if run["stage"] == stage]) for stage in stages}

    def stages(self, o):
        """For each stage: processor seconds, bytes read and written, bytes of messages in all, and those through one rank."""
        hogels = (o.side / o.hogel)**2
        rays = 3 * hogels * o.directions**2
        samples = (o.side / o.pitch)**2
        field = o.colours * samples * COMPLEX_HALF
        per_sample = lambda stage, n: self.rates[stage][0] + self.rates[stage][1] * n
        # Of each block the narrow camera sends its part of the band, with the low-pass's 4.5 samples on each side. The band
        # passes a quarter of its sampling rate.
        half_band = 0.5 * o.pupil / (o.wavelength * o.distance)
        factor = max(1, math.floor(0.25 / (1.1 * half_band * o.pitch)))
        band = (BLOCK[0] / factor + 9) * (BLOCK[1] / factor + 9) * NUMBERS
        light = o.colours * samples / (BLOCK[0] * BLOCK[1]) * band
        lines = 2 * o.colours * samples * NUMBERS  # to columns and back
        return {
            "render": (per_sample("render", rays), rays * HALF, 0, 0),
            "compress": (per_sample("compress", rays), rays * HALF + rays * STREAM_BITS / 8, rays * STREAM_BITS / 8,
                         rays * STREAM_BITS / 8),
            "hologram": (o.colours * per_sample("hologram", samples), o.colours * rays / 3 * HALF + field, 0, 0),
            "photo": (o.colours * per_sample("photo", samples), field, light, light),
            # Nothing is stored: the scene is rendered and its hologram computed as the camera reads it.
            "streamed photo": (o.colours * per_sample("streamed photo", samples), 0, light, light),
            # n log n, of lines longer than those of the largest run.
            "propagate": (o.colours * per_sample("propagate", samples) * math.log(samples) / math.log(1e8), 2 * field, lines, 0),
        }


    def operations(self, o):
        """Floating-point operations a hogel, of the stages whose transforms are most of their work."""
        n, samples = o.hogel / o.pitch, (o.hogel / o.pitch)**2
        line = 5 * math.log2(o.side / o.pitch)
        return {"hologram": o.colours * 10 * samples * math.log2(n), "photo": o.colours * samples * (8 + 4 * 9),
                "streamed photo": o.colours * samples * (10 * math.log2(n) + 8 + 4 * 9),
                "propagate": o.colours * samples * (4 * line + 30)}


def seconds(stage, nodes, o):
    work, disk, messages, through_one = stage
    return {"processors": work / (nodes * o.cores), "disk": disk / o.disk,
            "network": messages * (1 - 1 / nodes) / (nodes * o.network), "first rank": through_one / o.merge}


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("measured", nargs="?", default=pathlib.Path(__file__).with_name("measured.json"))
    number = lambda name, value, text: parser.add_argument(name, type=float, default=value, help=f"{text} [{value:g}]")
    number("--side", 1, "of the hologram, m")
    number("--pitch", 1e-6, "of its samples, m")
    number("--hogel", 0.256e-3, "side of a hogel, m")
    number("--directions", 256, "across and down")
    number("--colours", 3, "wavelengths")
    number("--wavelength", 532e-9, "m")
    number("--pupil", 6e-3, "of the camera, m")
    number("--distance", 0.3, "of the camera, m")
    number("--cores", 64, "of a node")
    number("--disk", 10e9, "bytes a second of the file system that all nodes share")
    number("--network", 3e9, "bytes a second of a node")
    number("--merge", 1e9, "bytes a second that the first rank adds")
    number("--price", 3, "of a node and hour")
    parser.add_argument("--nodes", type=lambda text: [int(n) for n in text.split(",")], default=[16, 64, 256])
    return parser.parse_args()


def duration(s):
    return f"{s:.1f} s" if s < 100 else f"{s / 60:.1f} min" if s < 6000 else f"{s / 3600:.1f} h"


def main():
    o = options()
    measured = json.loads(pathlib.Path(o.measured).read_text())
    model = Model(measured)
    stages = model.stages(o)
    hogels = (o.side / o.hogel)**2
    operations = model.operations(o)
    print("| a hogel takes | processor time | operations | disk | messages |\n|---|---|---|---|---|")
    for name, (work, disk, messages, _) in stages.items():
        counted = f"{operations[name] / 1e6:.3g} million" if name in operations else ""
        print(f"| {name} | {1e3 * work / hogels:.3g} ms | {counted} | {disk / hogels / 1e3:.4g} kB | {messages / hogels / 1e3:.4g} kB |")
    print("\n| nodes | " + " | ".join(stages) + " | render, hologram and photo | price |\n|" + "---|" * (len(stages) + 3))
    for nodes in o.nodes:
        row, total = [], 0
        for name, stage in stages.items():
            times = seconds(stage, nodes, o)
            bottleneck = max(times, key=times.get)
            row.append(f"{duration(times[bottleneck])}, {bottleneck}")
            if name in ("render", "hologram", "photo"):
                total += times[bottleneck]
        print(f"| {nodes} | " + " | ".join(row) + f" | {duration(total)} | {total / 3600 * nodes * o.price:.0f} |")


if __name__ == "__main__":
    main()
