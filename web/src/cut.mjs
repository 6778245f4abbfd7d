// SPDX-License-Identifier: GPL-3.0-or-later
import * as abi from "meander:abi";
import { calling } from "./calls.mjs";
import { native } from "./module.mjs";

/** A mesh of the shape of a flow's surface that has the flow's present curve among its edges. */
export function cutSurface(flow, detail = 0, middleLines = false) {
  return calling((call) => {
    const found = call.result(abi.CutRecord, native.meander_cut_init);
    call.check(
      native.meander_flow_cut_surface(flow.address, detail, middleLines ? 1 : 0, found.address, 0, call.error.address),
    );
    const [vertices, faces] = [found.get("vertex_count"), found.get("face_count")];
    const [points, strands] = [found.get("point_count"), found.get("strand_count")];
    return {
      positions: found.array("positions", 3 * vertices),
      distances: found.array("distances", vertices),
      vertexFaces: found.array("vertex_faces", vertices),
      vertexWeights: found.array("vertex_weights", 3 * vertices),
      faces: found.array("faces", 3 * faces),
      origins: found.array("origins", faces),
      strands: found.array("strands", faces),
      regions: found.array("regions", faces),
      sides: found.array("sides", faces),
      nearestSides: found.array("nearest_sides", faces),
      along: found.array("along", 3 * faces),
      faceDistances: found.array("face_distances", 3 * faces),
      cornerWeights: found.array("corner_weights", 9 * faces),
      lineVertices: found.array("line_vertices", points),
      arcLengths: found.array("arc_lengths", points),
      offsets: found.array("offsets", strands + 1),
      lineStrands: found.array("line_strands", strands),
      closed: found.array("closed", strands),
      lengths: found.array("lengths", strands),
    };
  });
}
