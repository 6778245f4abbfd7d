// SPDX-License-Identifier: GPL-3.0-or-later

// What a string between quotes, or a script in a page, cannot hold, and the rarest bytes of a module, whose characters
// stand for it; web/src/module.mjs reads them.
const STAND_INS = new Map([[0, "Y"], [10, "["], [13, "^"], [34, "W"], [92, "Q"]]);
const STANDING_IN = new Set([...STAND_INS.values()].map((letter) => letter.charCodeAt(0)));
const [LESS, SLASH, EXCLAMATION] = [60, 47, 33];

/**
 * The bytes of a module as characters: a stand-in, or else the byte is the low byte of the character.
 *
 * Brotli makes 425,000 bytes of it where base64 would be 573,000, since a byte stays a byte.
 */
export function moduleText(bytes) {
  let text = "";
  for (let i = 0; i < bytes.length; ++i) {
    const byte = bytes[i];
    const ends = byte === LESS && (bytes[i + 1] === SLASH || bytes[i + 1] === EXCLAMATION); // </script, <!--
    text += STAND_INS.get(byte) ?? String.fromCharCode(STANDING_IN.has(byte) || ends ? 256 + byte : byte);
  }
  return text;
}
