// Numbers of one robot: speeds, reward terms and a joint.
import uPlot from "uplot";
import { axes } from "./charts";
import { choice, colour, element, make, option, say } from "./dom";
import type { PageFrame, PageRobot } from "./generated/page_pb";
import type { Timeline } from "./timeline";

const ERROR_S = 2;
const PLOT_S = 5;
const PLOT_HEIGHT = 84;
/** The full length of a bar is the largest term of late: it fades by this factor at each update. */
const LARGEST_FADE = 0.99;
/** Unit of the reward's terms. */
const REWARD = 1e-3;

type Values = (number | null)[];

/** Curves of the last seconds, one in each colour, with a line at each finite limit. */
function limited(target: HTMLElement, limits: number[], colours: string[]): (times: number[], ...curves: Values[]) => void {
  target.replaceChildren();
  const lines = limits.filter(Number.isFinite);
  const line = { width: 1.5, points: { show: false } };
  const dashed = { ...line, stroke: () => colour("red"), width: 1, dash: [4, 4] };
  const options: uPlot.Options = {
    ...{ width: target.clientWidth || 260, height: PLOT_HEIGHT, padding: [5, 8, 0, 0], cursor: { show: false } },
    scales: { x: { time: false, range: [-PLOT_S, 0] } },
    axes: axes((value) => `${value} s`, 20),
    series: [{}, ...colours.map((name) => ({ ...line, stroke: () => colour(name) })), ...lines.map(() => dashed)],
  };
  const plot = new uPlot(options, [[], ...[...colours, ...lines].map(() => [])], target);
  return (times, ...curves) => {
    const width = target.clientWidth;
    if (width !== plot.width && width > 0) plot.setSize({ width, height: PLOT_HEIGHT });
    plot.setData([times, ...curves, ...lines.map((limit) => times.map(() => limit))]);
  };
}

export class Panels {
  private robot = 0;
  private robots: readonly PageRobot[] = [];
  private terms: { value: Element; bar: HTMLElement }[] = [];
  private largest = 0;
  /** Plots of the angle with its servo's target, and of the torque. */
  private plots: ReturnType<typeof limited>[] = [];

  constructor(private readonly timeline: Timeline) {
    choice("robot").addEventListener("change", () => this.choose(Number(choice("robot").value)));
    choice("hinge").addEventListener("change", () => this.chooseHinge());
  }

  setRobots(robots: readonly PageRobot[]): void {
    this.robots = robots;
    choice("robot").replaceChildren(...robots.map((robot, index) => option(String(index), robot.name)));
    choice("robot").hidden = robots.length < 2;
    this.choose(0);
  }

  private choose(index: number): void {
    this.robot = index;
    const { rewardTerms = [], hinges = [] } = this.robots[index] ?? {};
    this.largest = 0;
    element("rewards").replaceChildren();
    this.terms = rewardTerms.map((name) => {
      const [bar, value] = [make("i"), make("output")];
      element("rewards").append(make("div", "term", bar, make("span", "", name), value));
      return { value, bar };
    });
    element("rewards-head").hidden = rewardTerms.length === 0;
    choice("hinge").replaceChildren(...hinges.map((hinge, at) => option(String(at), hinge.name)));
    element("hinges").hidden = hinges.length === 0;
    this.chooseHinge();
  }

  private chooseHinge(): void {
    const hinge = this.robots[this.robot]?.hinges[Number(choice("hinge").value)];
    // Without a motor there is no largest torque.
    const effort_nm = hinge?.effortNm || Infinity;
    if (hinge === undefined) return;
    const angle = limited(element("angle-plot"), [hinge.lowRad, hinge.highRad], ["blue", "yellow"]);
    this.plots = [angle, limited(element("torque-plot"), [-effort_nm, effort_nm], ["blue"])];
  }

  /** Shows the moment of the timeline. */
  update(): void {
    const frame = this.timeline.sample(this.robot)?.before.frame;
    if (frame === undefined || element("numbers-body").clientWidth === 0) return;
    say(element("time"), `${frame.timeS.toFixed(2)} s`);
    say(element("episode"), String(frame.episode));
    say(element("distance"), `${frame.distanceM.toFixed(2)} m`);
    this.velocities(frame);
    this.largest = Math.max(1e-3, LARGEST_FADE * this.largest, ...frame.rewardsE3.map((term) => Math.abs(term) * REWARD));
    for (const [index, { value, bar }] of this.terms.entries()) {
      const reward = (frame.rewardsE3[index] ?? 0) * REWARD;
      say(value, reward.toFixed(3));
      bar.style.transform = `scaleX(${reward / this.largest})`;
      bar.className = reward < 0 ? "negative" : "";
    }
    this.joint(frame);
  }

  private velocities({ episode, command, velocity }: PageFrame): void {
    element("velocities").hidden = velocity.length === 0;
    const errors = [0, 0, 0];
    let count = 0;
    this.timeline.visit(this.robot, ERROR_S, ({ frame }) => {
      if (frame.episode !== episode || frame.command.length < 3 || frame.velocity.length < 3) return;
      count += 1;
      for (let axis = 0; axis < 3; axis += 1) errors[axis]! += Math.abs(frame.command[axis]! - frame.velocity[axis]!);
    });
    for (const [axis, row] of [...element<HTMLTableElement>("velocities").tBodies[0]!.rows].entries()) {
      const numbers = [command[axis], velocity[axis], count > 0 ? errors[axis]! / count : undefined];
      for (const [column, number] of numbers.entries()) say(row.cells[column + 1]!, number?.toFixed(2) ?? "–");
    }
  }

  private joint(now: PageFrame): void {
    const at = Number(choice("hinge").value);
    const { isServo = false } = this.robots[this.robot]?.hinges[at] ?? {};
    const of = (numbers: readonly number[], units: number) => (at in numbers ? numbers[at]! / units : null);
    const angle_rad = ({ anglesMrad }: PageFrame) => of(anglesMrad, 1000);
    const control_of = ({ controlsE2 }: PageFrame) => of(controlsE2, 100);
    const torque_nm = (frame: PageFrame) => (frame.torquesCnm[at] ?? 0) / 100;
    const [times, angles, targets, torques]: [number[], Values, Values, number[]] = [[], [], [], []];
    this.timeline.visit(this.robot, PLOT_S, ({ shown_s, frame }) => {
      times.push(shown_s - this.timeline.time_s);
      angles.push(angle_rad(frame));
      targets.push(isServo ? control_of(frame) : null);
      torques.push(torque_nm(frame));
    });
    this.plots[0]?.(times, angles, targets);
    this.plots[1]?.(times, torques);
    const control = control_of(now)?.toFixed(2) ?? "–";
    say(element("angle"), angle_rad(now)?.toFixed(3) ?? "–");
    say(element("target"), isServo ? `target ${control}` : "");
    say(element("torque"), torque_nm(now).toFixed(2));
    say(element("control"), isServo ? "" : `action ${control}`);
  }
}
