// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a tab has room for, and how much of it a file needs, before the file is read as a whole.

export const MOST_FACES = 2e6;
const MOST_BYTES = 250e6; // of a file: its text and its numbers are in memory together

const PIECE = 1 << 20;
const HEAD = 65536;
const HEAD_OF_STL = 84;
const TRIANGLE_OF_STL = 50;
const [LINE_FEED, SPACE, TAB] = [10, 32, 9];

const count = (number) => Math.round(number).toLocaleString("en");
const latin = (bytes) => new TextDecoder("latin1").decode(bytes);

/** How many lines begin with this word and a space; infinitely many where there are more than `most`. */
function linesWith(word, size, read, most) {
  const letters = Array.from(word, (letter) => letter.charCodeAt(0));
  const isSpace = (byte) => byte === SPACE || byte === TAB;
  let [found, matched] = [0, 0]; // letters of the word at the beginning of this line; -1: another word is there
  for (let begin = 0; begin < size && found <= most; begin += PIECE) {
    for (const byte of read(begin, Math.min(begin + PIECE, size))) {
      if (byte === LINE_FEED) matched = 0;
      else if (matched === letters.length) {
        if (isSpace(byte)) ++found;
        matched = -1;
      } else if (byte === letters[matched]) ++matched;
      else if (matched !== 0 || !isSpace(byte)) matched = -1;
    }
  }
  return found > most ? Infinity : found;
}

function facesOfStl(size, read, most) {
  const head = read(0, Math.min(HEAD_OF_STL, size));
  const number = head.length < HEAD_OF_STL ? 0 : new DataView(head.buffer, head.byteOffset).getUint32(80, true);
  return size === HEAD_OF_STL + TRIANGLE_OF_STL * number ? number : linesWith("facet", size, read, most);
}

/** Triangles of a binary glTF file: how many its parts have, each counted once. */
function facesOfGlb(size, read) {
  const head = read(0, Math.min(20, size));
  if (head.length < 20 || latin(head.subarray(0, 4)) !== "glTF") return 0;
  try {
    const length = new DataView(head.buffer, head.byteOffset).getUint32(12, true);
    const { meshes = [], accessors = [] } = JSON.parse(new TextDecoder().decode(read(20, Math.min(20 + length, size))));
    const parts = meshes.flatMap(({ primitives }) => primitives);
    const corners = parts.map(({ indices, attributes }) => accessors[indices ?? attributes.POSITION].count);
    return corners.reduce((sum, number) => sum + number / 3, 0);
  } catch {
    return 0; // its reader says what is wrong
  }
}

const COUNTS = {
  obj: (size, read, most) => linesWith("f", size, read, most),
  ply: (size, read) => Number(/^element face (\d+)/m.exec(latin(read(0, Math.min(HEAD, size))))?.[1] ?? 0),
  stl: facesOfStl,
  glb: facesOfGlb,
};

/**
 * Why a file is too large for a tab, as a sentence; null: it is not.
 *
 * `read(begin, end)` gives bytes of the file. Of what has a header that is enough; lines are counted in a text, a
 * piece of a megabyte at a time.
 */
export function tooLarge(name, size, read) {
  const suffix = /\.(\w+)$/.exec(name)?.[1].toLowerCase();
  if (size > MOST_BYTES) {
    return `${name} has ${count(size / 1e6)} MB, more than a tab has room for (${count(MOST_BYTES / 1e6)}); give a coarser mesh, or fill it by the command.`;
  }
  const faces = COUNTS[suffix]?.(size, read, MOST_FACES) ?? 0;
  return faces > MOST_FACES ? tooManyFaces(name, faces) : null;
}

/** The same of a mesh with so many faces; infinitely many: nobody counted them all. */
export function tooManyFaces(name, faces) {
  const most = count(MOST_FACES);
  const number = Number.isFinite(faces) ? `${count(faces)} faces, more than a tab has room for (${most})` : `more than ${most} faces, for which a tab has no room`;
  return `${name} has ${number}; give a coarser mesh, or fill it by the command.`;
}
