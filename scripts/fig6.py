#!/usr/bin/env python3
"""Fig. 6 outside liftsim, as a start for one's own analysis.

Loads a result with pandas, draws it again with matplotlib, and recomputes one trial with NumPy: from the record that
`liftsim replay` prints, the filter, the whitened samples, their ranks, W, T and the decision.

usage: scripts/fig6.py [RESULT] [FIGURE.png] [LIFTSIM]    by default results/fig6, fig6.png, liftsim
"""

import io
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy
import pandas

matplotlib.use("Agg")
from matplotlib import pyplot


def draw(points, path):
    """The power of each curve against the acceleration, with the interval of each point."""
    figure, axes = pyplot.subplots(figsize=(5.5, 4))
    for label, curve in points[points.hypothesis == "H1"].groupby("label"):
        line = axes.plot(curve.delta, curve.rate, label=f"{label}: ν = {curve.nu.iloc[0]}, θ = {curve.theta.iloc[0]}")
        axes.fill_between(curve.delta, curve.low, curve.high, alpha=0.2, color=line[0].get_color())
    axes.set(xlabel="Δ/σ_ξ", ylabel="D", ylim=(0, 1))
    axes.legend()
    figure.savefig(path, dpi=150)


def replay(liftsim, config, point, trial):
    """The stages of one trial: a table of stage, sample, index, value."""
    command = [liftsim, "replay", config, "--point", str(point), "--trial", str(trial)]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return pandas.read_csv(io.StringIO(text), keep_default_na=False)


def recompute(stages):
    """The coefficients of the filter, W, T and the decision, from the record alone."""
    record = stages[stages.stage == "record"]
    observed, sample = record.value.to_numpy(float), record["sample"].to_numpy()
    training = observed[sample == "training"]
    centred = training - training.mean()
    past = numpy.column_stack([centred[1:-1], centred[:-2]])
    filter_, *_ = numpy.linalg.lstsq(past, centred[2:], rcond=None)
    white = observed.copy()
    white[2:] -= filter_[0] * observed[1:-1] + filter_[1] * observed[:-2]
    x, y1, y2 = (white[sample == name] for name in ("reference", "shift", "scale"))
    pooled = numpy.concatenate([x, y1, y2])
    ranks = pooled.argsort().argsort() + 1
    rank_sum = int(ranks[len(x) : len(x) + len(y1)].sum())
    exceedances = int(((y2 < x.min()) | (y2 > x.max())).sum())
    critical = stages[stages.stage == "critical"].value.astype(int)
    return filter_, rank_sum, exceedances, bool((rank_sum >= critical).any())


def main(result="results/fig6", figure="fig6.png", liftsim="liftsim"):
    points = pandas.read_csv(Path(result) / "points.csv")
    draw(points, figure)
    print(f"{figure}  {len(points)} points of {points.trials.max()} trials")

    for point, trial in [(12, 0), (12, 1), (50, 7), (140, 4711)]:
        stages = replay(liftsim, "fig6", point, trial)
        filter_, rank_sum, exceedances, h1 = recompute(stages)
        said = {stage: rows.value.astype(float).to_numpy() for stage, rows in stages.groupby("stage")}
        of_scale = stages[(stages.stage == "exceedances") & (stages["sample"] == "scale")]
        assert numpy.allclose(filter_, said["coefficient"], rtol=1e-9)
        assert rank_sum == said["rank_sum"][0] and exceedances == int(of_scale.value.iloc[0])
        assert h1 == bool(said["h1"][0])
        print(f"point {point}, trial {trial}: W = {rank_sum}, T = {exceedances}, {'H1' if h1 else 'H0'}, as liftsim says")


if __name__ == "__main__":
    main(*sys.argv[1:])
