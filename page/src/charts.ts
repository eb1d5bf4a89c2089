// Learning curves: points of each tag and run, and their charts.
import uPlot from "uplot";
import { choice, colour, element, isPressed, make, option, press, say } from "./dom";
import type { PageCurves } from "./generated/page_pb";
import { commonName, spread, type Curve } from "./seeds";

/** Curves that are shown if they exist, in this order: distances say little of robots that obey commands. */
const COMMON = ["rollout/fall_fraction", "rollout/ep_len_mean", "time/fps"];
const OF_WALKERS = ["rollout/ep_rew_mean", "rollout/distance_mean_m", ...COMMON];
const OF_COMMANDED = ["rollout/ep_rew_mean", "eval/velocity_error", "eval/yaw_rate_error", ...COMMON];
const OF_IMITATORS = ["rollout/ep_rew_mean", "eval/done_share", "eval/body_error", ...COMMON];
/** Tags by which the curves of a task are known; first those that match. */
const OF_TASKS = new Map([
  ["rewards/track_linear_velocity", OF_COMMANDED],
  ["rewards/motion_body_pos", OF_IMITATORS],
]);
/** Evaluations that are points on the curve of the same quantity. */
const EVALUATED = new Map([
  ["rollout/ep_rew_mean", "eval/mean_reward"],
  ["rollout/distance_mean_m", "eval/distance_mean_m"],
]);
/** Counts how often a run was resumed. */
const RESUMES = "time/resumes";
const COLOURS = ["#2f7bf6", "#f2762e", "#2bb24c", "#b455e0", "#e5383b", "#18a5b5", "#e5a900", "#e0529c"];
const HEIGHT = 110;
const POINTS_MAX = 3000;

type Points = { steps: number[]; wall_s: number[]; values: (number | null)[] };
/** One run, or the seeds of one experiment. */
type Line = { name: string; runs: string[]; colour: string };
type Mark = { x: number; colour: string };
type Chart = { plot: uPlot; box: HTMLElement; value: HTMLElement; resumes: Mark[] };

/** Drops every second of the older points where there are too many. */
function thin(points: Points): void {
  if (points.values.length < POINTS_MAX) return;
  const isKept = (_: unknown, index: number) => index % 2 === 0 || index > POINTS_MAX - 200;
  points.steps = points.steps.filter(isKept);
  points.wall_s = points.wall_s.filter(isKept);
  points.values = points.values.filter(isKept);
}

/** Number with few digits: 1.2M. */
export function short(value: number): string {
  const units = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"]] as const;
  const [size, unit] = units.find(([least]) => Math.abs(value) >= least) ?? [1, ""];
  return `${Number((value / size).toPrecision(3))}${unit}`;
}

export function duration(seconds: number): string {
  if (seconds < 120) return `${short(seconds)} s`;
  return seconds < 7200 ? `${short(seconds / 60)} min` : `${short(seconds / 3600)} h`;
}

/** Axes in the colours of the page. */
export function axes(text: (value: number) => string, space: number): uPlot.Axis[] {
  const grid = { stroke: () => colour("border"), width: 1 };
  const look = { stroke: () => colour("faint"), grid, ticks: { show: false }, font: "10px system-ui", gap: 3 };
  return [
    { ...look, size: 18, space: 56, values: (_, splits) => splits.map(text) },
    { ...look, size: 38, space, values: (_, splits) => splits.map(short) },
  ];
}

export class Charts {
  /** Points by tag and run. */
  private readonly curves = new Map<string, Map<string, Points>>();
  private readonly charts = new Map<string, Chart>();
  /** Group of each run. */
  private readonly runs = new Map<string, string>();
  private readonly added: string[] = [];
  private changed = false;

  constructor() {
    choice("tag").addEventListener("change", () => {
      this.added.push(choice("tag").value);
      this.changed = true;
    });
    for (const button of [element("axis"), element("seeds")]) {
      button.addEventListener("click", () => {
        press(button, !isPressed(button));
        this.clear();
      });
    }
  }

  /** Forgets all, as curves of a new connection are whole. */
  restart(): void {
    this.curves.clear();
    this.runs.clear();
  }

  /** Number of bands that are drawn. */
  get bands(): number {
    return this.charts.size * this.lines().filter(({ runs }) => runs.length > 1).length;
  }

  /** Newest value of a run's curve. */
  private newest(run: string, tag: string): number | undefined {
    return this.curves.get(tag)?.get(run)?.values.findLast((value) => value !== null) ?? undefined;
  }

  add(message: PageCurves): void {
    for (const { run, group, tag, steps, wallS, values } of message.curves) {
      if (this.runs.get(run) !== group) {
        this.runs.set(run, group);
        // The number of lines of a plot is fixed.
        this.clear();
      }
      const runs = this.curves.get(tag) ?? new Map<string, Points>();
      const points = runs.get(run) ?? { steps: [], wall_s: [], values: [] };
      for (const [at, value] of values.entries()) {
        points.steps.push(steps[at]!);
        points.wall_s.push(wallS[at]!);
        points.values.push(Number.isFinite(value) ? value : null);
      }
      thin(points);
      if (points.values.length > 0) this.curves.set(tag, runs.set(run, points));
    }
    this.changed = true;
  }

  /** Draws what is new. Returns whether there are curves. */
  update(): boolean {
    const resized = ({ plot, box }: Chart) => box.clientWidth > 0 && box.clientWidth !== plot.width;
    if (this.changed || [...this.charts.values()].some(resized)) this.layOut();
    this.changed = false;
    return this.curves.size > 0;
  }

  /** Removes the charts; the next update makes them anew. */
  private clear(): void {
    for (const { plot } of this.charts.values()) plot.destroy();
    element("charts").replaceChildren();
    this.charts.clear();
    this.changed = true;
  }

  private layOut(): void {
    const all = [...this.curves.keys()];
    const [, wanted] = [...OF_TASKS].find(([mark]) => this.curves.has(mark)) ?? ["", OF_WALKERS];
    const known = wanted.filter((tag) => this.curves.has(tag));
    const first = known.length > 0 ? known : all.slice(0, wanted.length);
    const tags = [...new Set([...first, ...this.added])].filter((tag) => this.curves.has(tag));
    const others = all.filter((tag) => !tags.includes(tag)).sort();
    // An open list stays as it is unless tags came or went.
    if (choice("tag").options.length !== others.length + 1) {
      choice("tag").replaceChildren(option("", "Add a curve …"), ...others.map((tag) => option(tag)));
      choice("tag").options[0]!.disabled = true;
    }
    const groups = [...this.runs.values()].filter((group) => group !== "");
    element("seeds").hidden = new Set(groups).size === groups.length;
    const names = this.lines().map(({ name, runs, colour: background }) => {
      const mark = make("i", runs.length > 1 ? "wide" : "");
      mark.style.background = background;
      return make("span", "", mark, name);
    });
    element("runs").replaceChildren(...names);
    for (const tag of tags) this.fill(tag);
  }

  /** Lines of each chart, in the order of the runs. */
  private lines(): Line[] {
    const lines = new Map<string, Line>();
    for (const [index, [run, group]] of [...this.runs].entries()) {
      const isJoined = group !== "" && isPressed(element("seeds"));
      const key = isJoined ? `group ${group}` : `run ${run}`;
      const line = lines.get(key) ?? { name: run, runs: [], colour: COLOURS[index % COLOURS.length]! };
      line.runs.push(run);
      if (line.runs.length > 1) line.name = `${commonName(line.runs)} · ${line.runs.length} seeds`;
      lines.set(key, line);
    }
    return [...lines.values()];
  }

  /** Curve over steps or wall time; empty if the run has none. */
  private curve(run: string, tag = ""): Curve {
    const points = this.curves.get(tag)?.get(run);
    return [(isPressed(element("axis")) ? points?.wall_s : points?.steps) ?? [], points?.values ?? []];
  }

  private fill(tag: string): void {
    const lines = this.lines();
    const chart = this.charts.get(tag) ?? this.make(tag, lines);
    const { plot, box, value, resumes } = chart;
    const evaluated = EVALUATED.get(tag);
    const tables: uPlot.AlignedData[] = [];
    const newest: string[] = [];
    resumes.length = 0;
    for (const { runs, colour: line } of lines) {
      const own = runs.map((run) => this.curve(run, tag));
      const table = runs.length > 1 ? spread(own) : own[0]!;
      tables.push(table);
      const last = table[1].findLast((one) => one !== null);
      newest.push(last == null ? "–" : short(last));
      for (const run of runs) {
        if (evaluated !== undefined) tables.push(this.curve(run, evaluated));
        const [steps, counts] = this.curve(run, RESUMES);
        const isResume = (_: number, at: number) => at > 0 && (counts[at] ?? 0) > (counts[at - 1] ?? 0);
        resumes.push(...steps.filter(isResume).map((at) => ({ x: at, colour: line })));
      }
    }
    if (box.clientWidth > 0) plot.setSize({ width: box.clientWidth, height: HEIGHT });
    plot.setData(uPlot.join(tables));
    const evaluations = lines.map(({ runs }) => {
      const known = runs.flatMap((run) => this.newest(run, evaluated ?? "") ?? []);
      return known.length === 0 ? "–" : short(known.reduce((sum, one) => sum + one) / known.length);
    });
    const isKnown = evaluations.some((text) => text !== "–");
    say(value, newest.join(" · ") + (isKnown ? `, evaluated ● ${evaluations.join(" · ")}` : ""));
  }

  private make(tag: string, lines: readonly Line[]): Chart {
    const value = make("b");
    const box = make("div", "plot", make("p", "caption", `${tag} `, value));
    element("charts").append(box);
    const resumes: Mark[] = [];
    const series: uPlot.Series[] = [{}];
    const bands: uPlot.Band[] = [];
    for (const { runs, colour: stroke } of lines) {
      const line = { stroke, spanGaps: true, points: { show: false } };
      series.push({ ...line, width: runs.length > 1 ? 2.5 : 1.5 });
      if (runs.length > 1) {
        bands.push({ series: [series.length, series.length + 1], fill: `${stroke}55` });
        series.push({ ...line, width: 0 }, { ...line, width: 0 });
      }
      const points = { stroke, paths: () => null, points: { show: true, size: 6, fill: stroke } };
      if (EVALUATED.has(tag)) series.push(...runs.map(() => points));
    }
    const options: uPlot.Options = {
      ...{ width: box.clientWidth || 240, height: HEIGHT, padding: [6, 10, 0, 0], series, bands },
      axes: axes(isPressed(element("axis")) ? duration : short, 22),
      cursor: { y: false, drag: { x: false, y: false } },
      scales: { x: { time: false } },
      hooks: { drawAxes: [(plot) => drawResumes(plot, resumes)] },
    };
    const chart = { plot: new uPlot(options, [[], ...series.slice(1).map(() => [])], box), box, value, resumes };
    this.charts.set(tag, chart);
    return chart;
  }
}

/** Draws a thin dashed line where a run was resumed. */
function drawResumes({ ctx, bbox, valToPos }: uPlot, resumes: readonly Mark[]): void {
  ctx.save();
  ctx.lineWidth = devicePixelRatio;
  ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
  for (const { x, colour: stroke } of resumes) {
    const at = valToPos(x, "x", true);
    if (at < bbox.left || at > bbox.left + bbox.width) continue;
    ctx.strokeStyle = stroke;
    ctx.beginPath();
    ctx.moveTo(at, bbox.top);
    ctx.lineTo(at, bbox.top + bbox.height);
    ctx.stroke();
  }
  ctx.restore();
}
