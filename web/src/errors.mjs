// SPDX-License-Identifier: GPL-3.0-or-later

/** Something that a person can put right: `message` is one sentence that says how. */
export class MeanderError extends Error {
  constructor(message, status = "invalid_argument", elementKind = null, elements = []) {
    super(message);
    this.name = "MeanderError";
    this.status = status;
    this.elementKind = elementKind;
    this.elements = elements;
  }
}
