// Frames of the last minute and the clock that says which moment of them is shown.
import type { PageFrame } from "./generated/page_pb";

const KEPT_S = 60;
/** Frames further apart than this are not joined: messages in between were lost. */
const GAP_S = 0.5;
/** Pauses between frames are forgotten by this factor at each frame. */
const PAUSE_KEPT = 0.98;
/** The picture is so much later than the longest pause, so that the next frame has come and can be interpolated. */
const DELAY_SHARE = 1.15;
const DELAY_S_MIN = 0.02;
const DELAY_S_MAX = 0.25;
/** Farther from the newest frame, the clock jumps. */
const JUMP_S = 1;
const PACE_MAX = 4;

/** Units of packed positions and rotations, see PageFrame. */
export const POSITION_M = 1e-4;
const ROTATION_RAD = 1e-4;
/** Numbers of a body in Moment.bodies: position x, y, z from the base (m), and rotation x, y, z, w. */
export const BODY_NUMBERS = 7;
const NO_BYTES = new Uint8Array();

/** A frame, whose packed numbers are here instead. */
export type Moment = {
  frame: PageFrame;
  shown_s: number;
  bodies: Float32Array;
  contacts: Int16Array;
  /** Bodies of the motion that the robot imitates, from its own base; empty without one. */
  ghost: Float32Array;
};

/** What a robot shows at a time: `mix` 0 is `before`, 1 is `after`. */
export type Sample = { before: Moment; after: Moment; mix: number };

const clamp = (value: number, low: number, high: number) => Math.max(low, Math.min(high, value));
// A copy, as bytes of a message may begin at an odd address.
const unpack = (bytes: Uint8Array) => new Int16Array(bytes.slice(0, bytes.length & ~1).buffer);

/** Makes a quaternion of each rotation vector once, as a frame is drawn many times. */
function unpackBodies(bytes: Uint8Array): Float32Array {
  const packed = unpack(bytes);
  const bodies = new Float32Array(BODY_NUMBERS * Math.floor(packed.length / 6));
  for (let from = 0, to = 0; to < bodies.length; from += 6, to += BODY_NUMBERS) {
    const [x, y, z] = [packed[from + 3]!, packed[from + 4]!, packed[from + 5]!];
    const length = Math.hypot(x, y, z);
    const half_rad = (length * ROTATION_RAD) / 2;
    const share = length > 0 ? Math.sin(half_rad) / length : 0;
    for (let axis = 0; axis < 3; axis += 1) bodies[to + axis] = packed[from + axis]! * POSITION_M;
    bodies.set([x * share, y * share, z * share, Math.cos(half_rad)], to + 3);
  }
  return bodies;
}

/** Index of the last moment at or before `time_s`; -1 if all moments are later. */
function find(track: readonly Moment[], time_s: number): number {
  let [low, high] = [0, track.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (track[middle]!.shown_s <= time_s) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

export class Timeline {
  /** Moment that is shown, in seconds of PageFrame.shown_s. */
  time_s = 0;
  newest_s = 0;
  /** Whether the clock follows the newest frame. */
  live = true;
  paused = false;
  speed = 1;
  received = 0;
  private tracks: Moment[][] = [];
  private readonly samples: Sample[] = [];
  /** Simulated seconds for each second of wall time. */
  private pace = 1;
  /** When the newest frame came, and the longest pause between frames of late (s of wall time). */
  private arrived_s = 0;
  private pause_s = 0.1;

  /** Forgets all frames, as those of another server. */
  clear(): void {
    this.tracks = [];
    this.time_s = this.newest_s = 0;
    this.pace = 1;
    this.goLive();
  }

  add(frame: PageFrame): void {
    this.received += 1;
    const { robot, shownS: shown_s } = frame;
    const last_s = this.tracks[robot]?.at(-1)?.shown_s ?? -1;
    if (shown_s === last_s) return;
    // The time falls only when the server was started anew.
    if (shown_s < last_s) this.clear();
    if (shown_s > this.newest_s) this.arrive(performance.now() / 1000);
    const track = (this.tracks[robot] ??= []);
    const [bodies, ghost] = [unpackBodies(frame.bodies), unpackBodies(frame.ghost)];
    track.push({ frame, shown_s, bodies, contacts: unpack(frame.contacts), ghost });
    // They would keep the whole message in memory.
    frame.bodies = frame.contacts = frame.ghost = NO_BYTES;
    // Removed in lumps, as each removal moves the whole array.
    const old = find(track, shown_s - KEPT_S);
    if (old >= 64) track.splice(0, old);
    this.newest_s = Math.max(this.newest_s, shown_s);
  }

  private arrive(now_s: number): void {
    const pause_s = Math.min(DELAY_S_MAX, now_s - this.arrived_s);
    this.pause_s = Math.max(pause_s, PAUSE_KEPT * this.pause_s);
    this.arrived_s = now_s;
  }

  /** Time since the server simulated what is shown, on a connection without delay (s). */
  get age_s(): number {
    return this.newest_s - this.time_s + performance.now() / 1000 - this.arrived_s;
  }

  get oldest_s(): number {
    return Math.min(this.newest_s, ...Array.from(this.tracks, (track) => track?.[0]?.shown_s ?? Infinity));
  }

  /** Moves the clock by `wall_s` of wall time. */
  advance(wall_s: number): void {
    const target_s = this.newest_s - clamp(DELAY_SHARE * this.pause_s, DELAY_S_MIN, DELAY_S_MAX);
    const error_s = target_s - this.time_s;
    if (this.live && Math.abs(error_s) > JUMP_S) this.time_s = target_s;
    else if (this.live) {
      // Frames arrive in bursts and at any pace: a slow control loop finds the pace.
      this.time_s += Math.max(0, wall_s * (this.pace + 3 * error_s));
      this.pace = clamp(this.pace + wall_s * error_s, 0, PACE_MAX);
    } else if (!this.paused) {
      this.time_s += wall_s * this.speed;
      this.live = this.speed === 1 && this.time_s >= target_s;
    }
    this.time_s = clamp(this.time_s, this.oldest_s, this.newest_s);
  }

  goLive(): void {
    [this.live, this.paused, this.speed] = [true, false, 1];
  }

  pause(paused: boolean): void {
    [this.live, this.paused] = [false, paused];
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.live &&= speed === 1;
  }

  scrub(time_s: number): void {
    this.live = false;
    this.time_s = clamp(time_s, this.oldest_s, this.newest_s);
  }

  /** Pauses at the next (1) or previous (-1) frame. */
  step(direction: 1 | -1): void {
    this.pause(true);
    const track = this.tracks.find((one) => one?.length > 0) ?? [];
    const at = find(track, this.time_s);
    const between = at >= 0 && track[at]!.shown_s < this.time_s;
    const next = direction === 1 ? at + 1 : between ? at : at - 1;
    this.time_s = track[clamp(next, 0, track.length - 1)]?.shown_s ?? this.time_s;
  }

  /** What `robot` shows now. The object is reused by the next call for this robot. */
  sample(robot: number): Sample | undefined {
    const track = this.tracks[robot] ?? [];
    const at = Math.max(0, find(track, this.time_s));
    const before = track[at];
    if (before === undefined) return undefined;
    let after = track[at + 1] ?? before;
    const gap_s = after.shown_s - before.shown_s;
    if (after.frame.episode !== before.frame.episode || gap_s > GAP_S) after = before;
    const mix = after === before ? 0 : clamp((this.time_s - before.shown_s) / gap_s, 0, 1);
    return Object.assign((this.samples[robot] ??= { before, after, mix }), { before, after, mix });
  }

  /** Calls `visit` for the moments of `robot` in the last `span_s` up to now, oldest first. */
  visit(robot: number, span_s: number, visit: (moment: Moment) => void): void {
    const track = this.tracks[robot] ?? [];
    const last = find(track, this.time_s);
    for (let at = Math.max(0, find(track, this.time_s - span_s)); at <= last; at += 1) visit(track[at]!);
  }

  /** Newest frame of `robot`, even if an older one is shown. */
  newest(robot: number): PageFrame | undefined {
    return this.tracks[robot]?.at(-1)?.frame;
  }
}
