// SPDX-License-Identifier: GPL-3.0-or-later
//
// node scripts/web/sizes.mjs FILE...: what is sent of a file by a server that compresses by brotli.
import fs from "node:fs";
import { brotliCompressSync, constants } from "node:zlib";

for (const file of process.argv.slice(2)) {
  const bytes = fs.readFileSync(file);
  const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24 };
  console.log(`${file}  ${bytes.length} bytes, ${brotliCompressSync(bytes, { params }).length} by brotli`);
}
