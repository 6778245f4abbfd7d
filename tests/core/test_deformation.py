# SPDX-License-Identifier: GPL-3.0-or-later
"""A moving surface whose prepared part alone is filled."""

import geometry
import numpy as np
import pytest
from flows import flow_on
from meander import core


def test_a_prepared_part_of_a_mesh_follows_the_whole_mesh():
    vertices, faces = geometry.tube(28, 22, 5.0)
    heights = vertices[:, 2].copy()
    preparation = core.SurfaceOptions(vertex_mask=5.0 - heights, mask_threshold=1.9)
    with flow_on((vertices, faces), preparation=preparation, radius=0.3) as flow:
        flow.run()
        for stretch in (1.2, 1.4):
            moved = vertices * [1.0, 1.0, stretch]
            flow.set_vertices(moved)
            flow.step()
            flow.step()
            curve, data = flow.polylines(), flow.point_data()
            rebuilt = np.einsum("nk,nkj->nj", data.barycentrics, moved[faces[data.faces]])
            assert np.allclose(rebuilt, curve.positions, atol=1e-9)
            # The mask's edge runs through faces, and rides with them.
            assert 2.7 * stretch < curve.positions[:, 2].max() < 3.1001 * stretch
            assert flow.statistics()["crossings"] == 0
        with pytest.raises(core.MeanderError, match="vertices now and had"):
            flow.set_vertices(moved[:-1])
