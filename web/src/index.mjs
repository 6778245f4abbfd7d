// SPDX-License-Identifier: GPL-3.0-or-later
//
// What programs import; web/meander.d.ts describes it.
export { ABI_VERSION, VERSION } from "meander:abi";
export { MeanderError } from "./errors.mjs";
export { ready } from "./module.mjs";
export { defaultOptions, estimateCost, optionWarnings, PRESETS } from "./options.mjs";
export { CURVATURES, DIRECTIONS, FAULTS, findClosest, findFaults, Surface } from "./surface.mjs";
export { ALIGNMENTS, Flow, PHASES, STOP_REASONS } from "./flow.mjs";
export { cutSurface } from "./cut.mjs";
export { automaticSpacing, fill, safeRepairs } from "./fill.mjs";
export { readMesh, triangulated } from "./files.mjs";
export { structLayout, memoryInUse } from "./inspection.mjs";
