// SPDX-License-Identifier: GPL-3.0-or-later
import * as abi from "meander:abi";
import { checkedArray } from "./arrays.mjs";
import { MeanderError } from "./errors.mjs";
import { native } from "./module.mjs";

const refuse = (sentence) => {
  throw new MeanderError(sentence, "invalid_seed");
};

/** Offsets of rows in `count` points, as the library takes them. */
export function wideOffsets(what, offsets, count) {
  const narrow = checkedArray(`${what}'s offsets`, offsets, Uint32Array);
  const falls = narrow.findIndex((offset, i) => i > 0 && offset < narrow[i - 1]);
  if (narrow.length < 2 || narrow[0] !== 0 || narrow[narrow.length - 1] !== count || falls >= 0) {
    refuse(`${what}'s offsets must rise from 0 to the number of its points, ${count}`);
  }
  return BigUint64Array.from(narrow, BigInt);
}

/** The struct of a seed; 0 of none. */
export function seedStruct(call, seed) {
  if (seed == null) return 0;
  const points = checkedArray("the seed's points", seed.points, Float64Array, 3);
  const count = points.length / 3;
  const offsets = wideOffsets("the seed", seed.offsets ?? [0, count], count);
  const strands = offsets.length - 1;
  const flags = (name, values, length, elements) => {
    const array = checkedArray(`the seed's ${name}`, values, Uint8Array);
    if (array.length !== length) refuse(`the seed needs one value of ${name} for each of its ${length} ${elements}, not ${array.length}`);
    return call.copy(array);
  };
  const record = call.struct(abi.SeedRecord, native.meander_seed_init);
  record.set("point_count", count);
  record.set("strand_count", strands);
  record.set("points", call.copy(points));
  record.set("offsets", call.copy(offsets));
  record.set("closed", flags("closed", seed.closed ?? new Uint8Array(strands), strands, "strands"));
  if (seed.fixed != null) record.set("fixed", flags("fixed", seed.fixed, count, "points"));
  if (seed.guides != null) record.set("guides", flags("guides", seed.guides, strands, "strands"));
  record.set("fill_regions", seed.loops ? 1 : 0);
  record.set("max_distance", seed.maxDistance ?? 0);
  return record.address;
}
