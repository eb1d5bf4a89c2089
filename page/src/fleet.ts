// Runs that train: their progress, the part that limits each, their actors and alarms.
import { duration, short } from "./charts";
import { element, make, say } from "./dom";
import { Phase, type ActorStatus, type RunStatus } from "./generated/control_pb";
import type { PageStatus } from "./generated/page_pb";

const OLD_S = 10;
const ROWS_MAX = 50;
/** Ages are written anew this often. */
const REDRAW_MS = 1000;

type Received = { status: RunStatus; actors: number; alive: number; arrived_ms: number };

const age_s = ({ arrived_ms }: Received, now_ms: number) => Math.max(0, now_ms - arrived_ms) / 1000;

const percent = (share: number) => `${Math.round(100 * share)} %`;

/** Duration in whole minutes where it is long. */
function seconds(time_s: number): string {
  if (time_s < 10) return `${time_s.toFixed(1)} s`;
  const unit_s = time_s < 120 ? 1 : 60;
  return duration(unit_s * Math.round(time_s / unit_s));
}

/** Sets what stands between backticks as code. */
const prose = (text: string) => text.split("`").map((part, index) => (index % 2 === 1 ? make("code", "", part) : part));

/** Name, host and state of an actor, and its numbers. */
function row({ name, alive, quarantined, stats, lagVersions, sinceContactS }: ActorStatus): HTMLElement {
  const state = alive ? "alive" : "silent";
  const who = make("th", "", name, make("span", "", stats?.host ?? ""));
  [who.scope, who.title] = ["row", `${name} ${stats?.host ?? ""}`];
  if (quarantined) who.append(make("b", "", "quarantined"));
  const numbers = [
    stats && short(stats.envStepsPerS),
    lagVersions?.toString(),
    sinceContactS === undefined ? undefined : seconds(sinceContactS),
  ];
  return make("tr", "", who, make("td", state, state), ...numbers.map((text) => make("td", "", text ?? "–")));
}

/** Table of the actors in the order of the server. */
function table({ status, actors, alive }: Received): HTMLElement[] {
  if (actors === 0) return [make("h3", "", "No actors")];
  const heads = ["actor", "state", "steps/s", "lag", "contact"].map((text) => make("th", "", text));
  const rows = status.actors.slice(0, ROWS_MAX).map(row);
  const more = actors - rows.length;
  return [
    make("h3", "", `Actors: ${alive} of ${actors} alive, slowest first`),
    make(
      "table",
      "actors",
      make("thead", "", make("tr", "", ...heads)),
      make("tbody", "", ...rows),
    ),
    ...(more > 0 ? [make("p", "caption", `and ${more} more`)] : []),
  ];
}

/** Share of each part in the time of a round. */
function parts({ parts, limit, limitHelp }: RunStatus): HTMLElement[] {
  if (parts.length === 0) return [];
  const bars = parts.map(({ name, share }) => {
    const bar = make("i");
    bar.style.transform = `scaleX(${Math.min(1, share)})`;
    const text = name === limit ? `${name} (the limit)` : name;
    const value = make("output", "", percent(share));
    return make("div", name === limit ? "term limit" : "term", bar, make("span", "", text), value);
  });
  const help = limitHelp === "" ? [] : [make("p", "help", "To speed up: ", ...prose(limitHelp))];
  return [make("h3", "", "Time of a round"), make("div", "parts", ...bars), ...help];
}

function section(received: Received, now_ms: number): HTMLElement {
  const { status } = received;
  const old_s = age_s(received, now_ms);
  const isOld = old_s > OLD_S;
  const state = isOld ? `status is ${seconds(old_s)} old` : (Phase[status.phase] ?? "").toLowerCase();
  const [steps, wanted] = [Number(status.envSteps), Number(status.envStepsWanted)];
  const progress = make("progress");
  [progress.max, progress.value, progress.ariaLabel] = [Math.max(1, wanted), steps, "Steps of the run"];
  const left_s = (wanted - steps) / status.envStepsPerS;
  const left = left_s > 0 && Number.isFinite(left_s) ? `, ${seconds(left_s)} left` : "";
  const facts: [string, string][] = [
    ["steps/s", short(status.envStepsPerS)],
    ["policy lag", status.policyLagMean.toFixed(2)],
    ["used share", status.usedShare === undefined ? "–" : percent(status.usedShare)],
    ["updated", `${seconds(status.sinceUpdateS)} ago`],
  ];
  return make(
    "section",
    isOld ? "run old" : "run",
    make("h2", "", make("b", "", status.run), make("span", "", state)),
    progress,
    make("p", "caption", `${short(steps)} of ${short(wanted)} steps${left}`),
    make("dl", "facts", ...facts.flatMap(([name, text]) => [make("dt", "", name), make("dd", "", text)])),
    ...parts(status),
    ...table(received),
  );
}

export class Fleet {
  private readonly runs = new Map<string, Received>();
  private readonly alarms = element<HTMLDetailsElement>("alarms");
  private alarmCount = 0;
  private drawn_ms = -Infinity;

  /** Forgets all, as a server that is connected again sends every status. */
  restart(): void {
    this.runs.clear();
    this.drawn_ms = -Infinity;
  }

  add({ status, actors, alive }: PageStatus): void {
    if (status === undefined) return;
    const before = this.runs.get(status.run);
    // A status that comes again is not newer.
    if (status.timeUnixS > 0 && before?.status.timeUnixS === status.timeUnixS) return;
    this.runs.set(status.run, { status, actors, alive, arrived_ms: performance.now() });
    this.drawn_ms = -Infinity;
  }

  /** Draws what is new. Returns whether there is a status. */
  update(now_ms: number): boolean {
    if (now_ms - this.drawn_ms < REDRAW_MS || this.isSelected()) return this.runs.size > 0;
    this.drawn_ms = now_ms;
    const runs = [...this.runs.values()];
    element("fleet-body").replaceChildren(...runs.map((run) => section(run, now_ms)));
    // What a run that ended had to say says nothing of now.
    this.showAlarms(runs.filter((run) => age_s(run, now_ms) <= OLD_S).map(({ status }) => status));
    return runs.length > 0;
  }

  /** Numbers of what is shown, for tests. */
  get counts(): { runs: number; actors: number; alarms: number } {
    const count = (rows: string) => document.querySelectorAll(rows).length;
    return { runs: count("#fleet .run"), actors: count(".actors tbody tr"), alarms: count("#alarms li") };
  }

  /** Whether the user selected text, as to copy a remedy: it would be lost. */
  private isSelected(): boolean {
    const selection = getSelection();
    if (selection === null || selection.isCollapsed) return false;
    return [this.alarms, element("fleet-body")].some((shown) => selection.containsNode(shown, true));
  }

  private showAlarms(runs: readonly RunStatus[]): void {
    const names = (run: string) => (runs.length > 1 ? [make("b", "", run)] : []);
    const items = runs.flatMap(({ run, alarms }) => alarms.map((text) => make("li", "", ...names(run), ...prose(text))));
    // A list that was folded opens when there are more alarms.
    if (items.length > this.alarmCount) this.alarms.open = true;
    this.alarmCount = items.length;
    this.alarms.hidden = items.length === 0;
    say(element("alarm-count"), items.length === 1 ? "1 alarm" : `${items.length} alarms`);
    element("alarm-list").replaceChildren(...items);
  }
}
