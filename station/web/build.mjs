// Builds the pages into dist/: npm run build. With an argument, into that folder (a test compares it with dist/).
import { build } from "esbuild";
import { copyFile, mkdir } from "node:fs/promises";

const out = process.argv[2] ?? "dist";
await mkdir(out, { recursive: true });
await build({
  entryPoints: ["src/display.ts", "src/instructor.ts", "src/beside.ts"], bundle: true, minify: true,
  target: ["es2020"], format: "iife", charset: "utf8", legalComments: "none", outdir: out,
});
for (const file of ["display.html", "instructor.html", "beside.html", "icon.svg", "favicon.ico", "station.css"])
  await copyFile(`src/${file}`, `${out}/${file}`);
