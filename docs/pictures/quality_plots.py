# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the plots of docs/quality.md: where the presets are uneven, and by how much.

    bash docs/pictures/make.sh quality

Needs numpy, matplotlib (Debian: python3-matplotlib) and the built library, no Blender. Figures are
the library's own medial radii on a square of 30 x 30 spacings; strands within 2.5 r of its boundary
are left out, since beyond the boundary there is nothing to keep the spacing from.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "addon"))
sys.path.insert(0, str(REPOSITORY / "docs" / "pictures"))
from draw_terms import sheet  # noqa: E402
from meander import core  # noqa: E402

RADIUS = 1 / 60
PRESETS = ("paper", "even", "finest")
COLOURS = ("0.6", "tab:blue", "tab:red")


def main(folder: Path) -> None:
    vertices, faces = sheet()
    figure, axes = plt.subplots(1, 4, figsize=(12, 3.2), layout="constrained")
    for preset, colour, axis in zip(PRESETS, COLOURS, axes, strict=False):
        options = core.default_options(preset)
        options.radius = RADIUS
        flow = core.Flow(core.Surface(vertices, faces), options)
        flow.run()
        flow.statistics()  # brings the radii up to date
        nodes = flow.nodes()
        corners = vertices[faces[nodes.faces]]
        at = np.einsum("nk,nkd->nd", nodes.barycentrics, corners)[:, :2]
        radii = nodes.radii / RADIUS
        inner = np.minimum(at, 1 - at).min(axis=1) > 2.5 * RADIUS
        curve = flow.polylines()
        for strand, closed in enumerate(curve.closed):
            line = curve.positions[curve.offsets[strand] : curve.offsets[strand + 1], :2]
            if closed:
                line = np.vstack([line, line[:1]])
            axis.plot(line[:, 0], line[:, 1], color="0.55", linewidth=0.7)
        for wrong, mark in (
            ((radii < 0.8).any(axis=1), "tab:blue"),
            ((radii > 1.2).any(axis=1), "tab:red"),
        ):
            axis.plot(*at[inner & wrong].T, ".", color=mark, markersize=1.6)
        near = (np.abs(radii[inner] - 1) < 0.2).mean()
        axis.set_title(f"{preset}: {near:.2f} within 20 % of r", fontsize=9)
        axis.set_aspect("equal")
        axis.axis("off")
        axes[3].hist(
            radii[inner].ravel(),
            bins=np.arange(0.4, 1.8, 0.025),
            density=True,
            histtype="step",
            color=colour,
            label=preset,
        )
        print(f"{preset}: {len(radii)} nodes, near {near:.3f}")
    axes[3].set_xlabel("medial radius in r", fontsize=9)
    axes[3].set_yticks([])
    axes[3].tick_params(labelsize=8)
    axes[3].legend(fontsize=8, frameon=False)
    figure.savefig(folder / "quality_presets.png", dpi=72)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
