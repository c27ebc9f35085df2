// Makes the page: one file that needs no network, not even from file://.
//
//     node build.mjs MODULE PAGE     the folder of the JavaScript module, and the file to write
import { build } from "esbuild";
import { mkdir, readFile, rename, writeFile } from "node:fs/promises";
import path from "node:path";

const [module, page] = process.argv.slice(2).map((each) => path.resolve(each));
const here = import.meta.dirname;
const live = path.join(here, "../../python/forgetting/stream/live");

const bundled = await build({
  entryPoints: [path.join(here, "src/main.js")],
  bundle: true,
  write: false,
  format: "esm",
  minify: true,
  target: ["es2022"],
  charset: "utf8",
  loader: { ".wasm": "binary", ".csv": "text" },
  alias: { forgetting: module },
  // the module's own way to its other file, which is in here instead
  define: { "import.meta.url": JSON.stringify("file:///") },
});

const text = (file) => readFile(file, "utf8");
const parts = {
  "/* style */": (await Promise.all([`${live}/uplot/uPlot.min.css`, `${live}/page.css`, `${here}/page.css`].map(text))).join("\n"),
  "/* uplot */": await text(`${live}/uplot/uPlot.iife.min.js`),
  "/* script */": bundled.outputFiles[0].text.replaceAll("</script", "<\\/script"),
};
let made = await text(path.join(here, "index.html"));
for (const [place, part] of Object.entries(parts)) {
  if (!made.includes(place)) throw new Error(`index.html has no ${place}`);
  made = made.replace(place, () => part);
}
await mkdir(path.dirname(page), { recursive: true });
await writeFile(`${page}.new`, made);
await rename(`${page}.new`, page);
console.log(`${page}: ${Math.round(made.length / 1024)} kB`);
