// SPDX-License-Identifier: GPL-3.0-or-later

// Smaller areas have lost digits.
const LEAST_AREA = 1e-290;

const twoDigits = (value) => Number(value.toExponential(1));

/** 1/30 of the side of a square of this area, rounded to two digits; 1 where the area is none. */
export function spacingFor(area) {
  return Number.isFinite(area) && area > LEAST_AREA ? twoDigits(Math.sqrt(area) / 30) : 1;
}
