// Commands, pushes and worlds that the user asks for: keys, sliders and a gamepad.
import type { Connection } from "./connection";
import { element, input, onKey, press, say } from "./dom";
import { PageSteerer, type PageFrame, type PageScene } from "./generated/page_pb";

const AXES = ["forward", "left", "turn"] as const;
const UNITS = ["m/s", "m/s", "rad/s"] as const;
/** Keys that raise and lower the command of each axis. */
const KEYS = ["ws", "ad", "qe"] as const;
const KEY_STEP = 0.1;
const STICK_MIN = 0.15;
const STICK_MS = 50;

/** Shows the value of a slider beside it and calls `act` when the user moves it. */
function slider(id: string, text: (value: number) => string, act?: (value: number) => void): (value: number) => void {
  const range = input(id);
  const output = range.nextElementSibling!;
  const show = (value: number) => say(output, text(value));
  range.addEventListener("input", () => {
    show(range.valueAsNumber);
    act?.(range.valueAsNumber);
  });
  show(range.valueAsNumber);
  return (value) => show((range.valueAsNumber = value));
}

const times = (value: number) => `× ${value.toFixed(2)}`;

/** Sliders of a world: their ids, fields of PageWorld, nominal values and texts. */
const WORLD = [
  ["mass", "massScale", 1, times],
  ["friction", "frictionScale", 1, times],
  ["motor", "motorScale", 1, times],
  ["delay", "actionDelaySteps", 0, (value: number) => `${value} ${value === 1 ? "step" : "steps"}`],
  ["level", "groundLevel", 0, (value: number) => `level ${value}`],
] as const;

export class Steering {
  steers = false;
  /** Whether robots obey commands. */
  private commands = false;
  /** Whether robots follow the command of this page, else their own ones. */
  private follows = false;
  private readonly command = [0, 0, 0];
  private low: readonly number[] = [];
  private high: readonly number[] = [];
  private readonly sliders = AXES.map((id, axis) =>
    slider(id, (value) => `${value.toFixed(2)} ${UNITS[axis]}`, (value) => this.set(axis, value)),
  );
  private readonly world = WORLD.map(([id, , , text]) => slider(id, text));
  private stickUsed = false;
  /** Whether all sticks were at rest since another page steered: an axis that rests elsewhere must not steer. */
  private stickRested = false;
  private stick_ms = 0;
  private others = false;
  /** Whether the server did not say yet whose command counts on this connection. */
  private isNew = true;

  constructor(private readonly connection: Connection) {
    onKey((key) => {
      if (!this.commands) return;
      if (key === "x" || key === "0") this.setAll([0, 0, 0]);
      const axis = KEYS.findIndex((keys) => keys.includes(key));
      if (axis < 0) return;
      // A key that takes over begins from rest, so that `w` leads straight ahead.
      const from = this.follows ? this.command : [0, 0, 0];
      const steps = Math.round(from[axis]! / KEY_STEP) + (KEYS[axis]![0] === key ? 1 : -1);
      this.setAll(from.map((old, other) => (other === axis ? steps * KEY_STEP : old)));
    });
    element("stop").addEventListener("click", () => this.setAll([0, 0, 0]));
    element("own").addEventListener("click", () => {
      this.follows = this.others = false;
      this.send();
    });
    slider("strength", (value) => `${value.toFixed(2)} m/s`);
    for (const button of document.querySelectorAll<HTMLElement>("[data-push]")) {
      button.addEventListener("click", () => {
        const strength_mps = input("strength").valueAsNumber;
        const [forwardMps, leftMps] = button.dataset["push"]!.split(" ").map((share) => Number(share) * strength_mps);
        this.connection.send({ case: "push", value: { forwardMps, leftMps } });
      });
    }
    element("apply").addEventListener("click", () => {
      const value = Object.fromEntries(WORLD.map(([id, field]) => [field, input(id).valueAsNumber]));
      this.connection.send({ case: "world", value });
    });
  }

  /** Takes what the scene allows. */
  setScene(scene: PageScene): void {
    this.steers = scene.steers;
    [this.low, this.high] = [scene.commandLow, scene.commandHigh];
    this.commands = this.steers && this.low.length === 3 && this.high.length === 3;
    element("read-only").hidden = scene.steers;
    element("push").hidden = element("world").hidden = !scene.steers;
    element("commands").hidden = !this.commands;
    element("level-row").hidden = scene.groundLevels === 0;
    input("level").max = String(Math.max(1, scene.groundLevels) - 1);
    for (const [axis, id] of AXES.entries()) {
      [input(id).min, input(id).max] = [String(this.low[axis] ?? 0), String(this.high[axis] ?? 0)];
    }
    for (const [at, [, field, nominal]] of WORLD.entries()) this.world[at]!(scene.world?.[field] ?? nominal);
  }

  /** Whether robots follow another page. */
  get othersSteer(): boolean {
    return this.others;
  }

  /** A connection was made anew. */
  reconnect(): void {
    this.isNew = true;
  }

  /** Takes whose command the robots follow. */
  setSteerer(steerer: PageSteerer): void {
    const wasLost = this.isNew && this.follows && steerer === PageSteerer.FREE;
    this.isNew = false;
    // A server that was started anew does not know the command of before.
    if (wasLost) return this.send();
    this.follows = steerer === PageSteerer.YOU;
    this.others = steerer === PageSteerer.ANOTHER;
    if (this.others) this.stickUsed = this.stickRested = false;
  }

  /** Shows the command of the robots or of another page while this page gives none. */
  update(frame: PageFrame | undefined): void {
    if (!this.commands) return;
    say(element("followed"), this.follows ? "(yours)" : this.others ? "another page steers" : "(the robot's own)");
    element("followed").classList.toggle("others", this.others);
    press(element("own"), !this.follows && !this.others);
    if (this.follows || frame?.command.length !== 3) return;
    for (const [axis, show] of this.sliders.entries()) show((this.command[axis] = frame.command[axis]!));
  }

  /** Reads the sticks of the first gamepad: the left one moves, the right one turns. */
  poll(now_ms: number): void {
    if (!this.commands || now_ms - this.stick_ms < STICK_MS) return;
    this.stick_ms = now_ms;
    const pads = (navigator.getGamepads?.() ?? []).filter((one) => one?.connected && one.axes.length >= 3);
    const pad = pads.find((one) => one?.mapping === "standard") ?? pads[0];
    const dead = (stick: number) => Math.sign(stick) * Math.max(0, Math.abs(stick) - STICK_MIN) / (1 - STICK_MIN);
    // A gamepad that is unplugged while it steers has let go.
    const sticks = [1, 0, 2].map((axis) => dead(-(pad?.axes[axis] ?? 0)));
    const used = sticks.some((stick) => stick !== 0);
    this.stickRested ||= !used && pad !== undefined;
    // A stick that is let go stops the robot once; then keys count again.
    if (!this.stickRested || (!used && !this.stickUsed)) return;
    this.stickUsed = used;
    const range = (stick: number, axis: number) => (stick > 0 ? this.high[axis]! : -this.low[axis]!);
    const next = sticks.map((stick, axis) => this.clamp(axis, stick * range(stick, axis)));
    if (next.some((value, axis) => Math.abs(value - this.command[axis]!) > 0.01)) this.setAll(next);
  }

  private clamp(axis: number, value: number): number {
    return Math.max(this.low[axis]!, Math.min(this.high[axis]!, value));
  }

  private set(axis: number, value: number): void {
    this.setAll(this.command.map((old, other) => (other === axis ? value : old)));
  }

  private setAll(values: readonly number[]): void {
    [this.follows, this.others] = [true, false];
    for (const [axis, show] of this.sliders.entries()) {
      show((this.command[axis] = this.clamp(axis, values[axis]!)));
    }
    this.send();
  }

  private send(): void {
    const [forwardMps, leftMps, yawRadps] = this.command as [number, number, number];
    this.connection.send({ case: "command", value: { follows: this.follows, forwardMps, leftMps, yawRadps } });
  }
}
