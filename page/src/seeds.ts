// Mean and band of runs that differ only in their seeds.

/** Values at ordered steps or times; null where a value is not finite. */
export type Curve = [x: number[], values: (number | null)[]];

/** Values of `curve` at `xs`, which are ordered; undefined outside its own range. */
function interpolated([x, values]: Curve, xs: readonly number[]): (number | undefined)[] {
  const known = x.flatMap((at, index) => (values[index] == null ? [] : { at, value: values[index] }));
  let next = 0;
  return xs.map((at) => {
    while (next < known.length && known[next]!.at < at) next += 1;
    const [before, after] = [known[next - 1], known[next]];
    if (after?.at === at) return after.value;
    if (before === undefined || after === undefined) return undefined;
    return before.value + ((at - before.at) / (after.at - before.at)) * (after.value - before.value);
  });
}

/** Mean, highest and lowest value of all curves at each x that any of them has. */
export function spread(curves: readonly Curve[]): [xs: number[], mean: number[], high: number[], low: number[]] {
  const xs = [...new Set(curves.flatMap(([x, values]) => x.filter((_, index) => values[index] != null)))];
  xs.sort((a, b) => a - b);
  const lines = curves.map((curve) => interpolated(curve, xs));
  const columns = xs.map((_, index) => lines.flatMap((line) => line[index] ?? []));
  const mean = (column: number[]) => column.reduce((sum, value) => sum + value, 0) / column.length;
  const ends = [(column: number[]) => Math.max(...column), (column: number[]) => Math.min(...column)] as const;
  return [xs, columns.map(mean), columns.map(ends[0]), columns.map(ends[1])];
}

/** Longest common beginning of names without separators at its end. */
export function commonName(names: readonly string[]): string {
  const [first = "", ...others] = names;
  let length = first.length;
  while (!others.every((name) => name.startsWith(first.slice(0, length)))) length -= 1;
  return first.slice(0, length).replace(/[-_.,:/\s]+$/, "") || first;
}
