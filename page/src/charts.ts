// Learning curves: points of each tag and run, and their charts.
import uPlot from "uplot";
import { choice, colour, element, isPressed, option, press, say } from "./dom";
import type { PageCurves } from "./generated/page_pb";

/** Curves that are shown if they exist, in this order: distances say little of robots that obey commands. */
const COMMON = ["rollout/fall_fraction", "rollout/ep_len_mean", "time/fps"];
const OF_WALKERS = ["rollout/ep_rew_mean", "rollout/distance_mean_m", "eval/distance_mean_m", ...COMMON];
const OF_COMMANDED = ["rollout/ep_rew_mean", "eval/velocity_error", "eval/yaw_rate_error", ...COMMON];
const MARK_OF_COMMANDED = "rewards/track_linear_velocity";
const COLOURS = ["#2f7bf6", "#f2762e", "#2bb24c", "#b455e0", "#e5383b", "#18a5b5", "#e5a900", "#e0529c"];
const HEIGHT = 110;
const POINTS_MAX = 3000;

type Points = { steps: number[]; wall_s: number[]; values: (number | null)[] };
type Chart = { plot: uPlot; box: HTMLElement; value: HTMLElement };

/** Drops every second of the older points where there are too many. */
function thin(points: Points): void {
  if (points.values.length < POINTS_MAX) return;
  const isKept = (_: unknown, index: number) => index % 2 === 0 || index > POINTS_MAX - 200;
  points.steps = points.steps.filter(isKept);
  points.wall_s = points.wall_s.filter(isKept);
  points.values = points.values.filter(isKept);
}

/** Number with few digits: 1.2M. */
function short(value: number): string {
  const units = [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"]] as const;
  const [size, unit] = units.find(([least]) => Math.abs(value) >= least) ?? [1, ""];
  return `${Number((value / size).toPrecision(3))}${unit}`;
}

function duration(seconds: number): string {
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
  private runs: string[] = [];
  private readonly added: string[] = [];
  private changed = false;

  constructor() {
    choice("tag").addEventListener("change", () => {
      this.added.push(choice("tag").value);
      this.changed = true;
    });
    element("axis").addEventListener("click", () => {
      press(element("axis"), !isPressed(element("axis")));
      this.clear();
    });
  }

  /** Forgets all, as curves of a new connection are whole. */
  restart(): void {
    this.curves.clear();
    this.runs = [];
  }

  add(message: PageCurves): void {
    for (const { run, tag, steps, wallS, values } of message.curves) {
      if (!this.runs.includes(run)) {
        this.runs.push(run);
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
    const wanted = this.curves.has(MARK_OF_COMMANDED) ? OF_COMMANDED : OF_WALKERS;
    const known = wanted.filter((tag) => this.curves.has(tag));
    const first = known.length > 0 ? known : all.slice(0, wanted.length);
    const tags = [...new Set([...first, ...this.added])].filter((tag) => this.curves.has(tag));
    const others = all.filter((tag) => !tags.includes(tag)).sort();
    // An open list stays as it is unless tags came or went.
    if (choice("tag").options.length !== others.length + 1) {
      choice("tag").replaceChildren(option("", "Add a curve …"), ...others.map((tag) => option(tag)));
      choice("tag").options[0]!.disabled = true;
    }
    const names = this.runs.map((run, index) => {
      const [name, mark] = [document.createElement("span"), document.createElement("i")];
      mark.style.background = COLOURS[index % COLOURS.length]!;
      name.append(mark, run);
      return name;
    });
    element("runs").replaceChildren(...names);
    for (const tag of tags) this.fill(tag);
  }

  private fill(tag: string): void {
    const time = isPressed(element("axis"));
    const runs = this.runs.map((run) => this.curves.get(tag)!.get(run));
    const data = uPlot.join(runs.map((run) => [(time ? run?.wall_s : run?.steps) ?? [], run?.values ?? []]));
    const { plot, box, value } = this.charts.get(tag) ?? this.make(tag, time ? duration : short);
    if (box.clientWidth > 0) plot.setSize({ width: box.clientWidth, height: HEIGHT });
    plot.setData(data);
    const newest = runs.map((points) => points?.values.findLast((one) => one !== null) ?? undefined);
    say(value, newest.map((one) => (one === undefined ? "–" : short(one))).join(" · "));
  }

  private make(tag: string, text: (value: number) => string): Chart {
    const [box, caption, value] = ["div", "p", "b"].map((name) => document.createElement(name)) as HTMLElement[];
    box!.className = "plot";
    caption!.className = "caption";
    caption!.append(`${tag} `, value!);
    box!.append(caption!);
    element("charts").append(box!);
    const look = { width: 1.5, spanGaps: true, points: { show: false } };
    const lines = this.runs.map((_, index) => ({ ...look, stroke: COLOURS[index % COLOURS.length]! }));
    const options: uPlot.Options = {
      ...{ width: box!.clientWidth || 240, height: HEIGHT, padding: [6, 10, 0, 0], axes: axes(text, 22) },
      cursor: { y: false, drag: { x: false, y: false } },
      scales: { x: { time: false } },
      series: [{}, ...lines],
    };
    const chart = { plot: new uPlot(options, [[], ...lines.map(() => [])], box!), box: box!, value: value! };
    this.charts.set(tag, chart);
    return chart;
  }
}
