// Bundles the page into dist/: the same bytes each time, so that what is checked in can be compared.
import { build } from "esbuild";
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";

const read = (path) => readFileSync(path, "utf8");

mkdirSync("dist", { recursive: true });

const result = await build({
  entryPoints: ["src/main.ts"],
  outfile: "dist/page.js",
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  loader: { ".glsl": "text" },
  legalComments: "none",
  metafile: true,
});

copyFileSync("src/index.html", "dist/index.html");
writeFileSync("dist/style.css", read("node_modules/uplot/dist/uPlot.min.css") + "\n" + read("src/style.css"));

// The package of @bufbuild/protobuf has no licence file; its text lies in licences/.
const licences = {
  three: () => read("node_modules/three/LICENSE"),
  uplot: () => read("node_modules/uplot/LICENSE"),
  "@bufbuild/protobuf": () => read("licences/protobuf.txt") + "\n" + read("../LICENSE-APACHE"),
};
const bundled = Object.keys(result.metafile.inputs)
  .map((path) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1])
  .filter((name) => name !== undefined);
const texts = [...new Set(bundled)].sort().map((name) => {
  if (!(name in licences)) throw new Error(`${name} is bundled, but its licence is not listed`);
  const { version } = JSON.parse(read(`node_modules/${name}/package.json`));
  return `${"=".repeat(80)}\n${name} ${version}\n${"=".repeat(80)}\n\n${licences[name]().trim()}\n`;
});
writeFileSync("dist/licences.txt", "Page of Treadmill: licences of the packages in page.js.\n\n" + texts.join("\n"));
