// SPDX-License-Identifier: GPL-3.0-or-later
import { MeanderError } from "./errors.mjs";

/** Values as an array of the given type, which holds rows of `width` numbers. */
export function checkedArray(what, values, Type, width = 1) {
  if (values == null || typeof values.length !== "number") {
    throw new MeanderError(`${what} must be an array of numbers`);
  }
  const flat = ArrayBuffer.isView(values) ? values : Array.from(values).flat();
  if (flat.length % width !== 0) {
    throw new MeanderError(`${what} must have ${width} numbers for each row, and has ${flat.length} in all`);
  }
  if (flat instanceof Type) return flat;
  const array = new Type(flat.length);
  for (let i = 0; i < array.length; ++i) {
    const value = Number(flat[i]);
    array[i] = value;
    if (Type !== Float64Array && array[i] !== value) {
      throw new MeanderError(`${what} must be whole numbers from 0 on; number ${i} is ${flat[i]}`);
    }
  }
  return array;
}

/** The same, one for each of `count` elements. */
export function oneForEach(what, values, Type, count, elements, width = 1) {
  const array = checkedArray(what, values, Type, width);
  if (array.length !== width * count) {
    throw new MeanderError(
      `${what} must have one value for each of the ${count} ${elements}, not ${array.length / width}`,
    );
  }
  return array;
}
