// code.mjs FILES.json SITE MODULE-FOLDER: the page puts together the files that tools/dropin.py writes.
import { readFile } from "node:fs/promises";
import { gunzipSync } from "node:zlib";
import { resolve } from "node:path";

const [files, site, modules] = process.argv.slice(2);
const { assemble } = await import(resolve(modules, "dropin.mjs"));
const pieces = JSON.parse(gunzipSync(await readFile(`${site}/kernels.gz`)));
const wanted = Object.entries(JSON.parse(await readFile(files)));
const differ = wanted.filter(([name, text]) => assemble(pieces, ...name.split(" ")) !== text);
console.log(`code: ${wanted.length} files, ${differ.length} differ`, ...differ.map(([name]) => name));
process.exit(differ.length === 0 && wanted.length > 0 ? 0 : 1);
