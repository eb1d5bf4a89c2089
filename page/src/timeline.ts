// Frames of the last minute and the clock that says which moment of them is shown.
import type { PageFrame } from "./generated/page_pb";

const KEPT_S = 60;
/** Frames further apart than this are not joined: messages in between were lost. */
const GAP_S = 0.5;
/** Late enough that the next frame has come, so that there is something to interpolate. */
const DELAY_S = 0.12;
/** Farther from the newest frame, the clock jumps. */
const JUMP_S = 1;
const PACE_MAX = 4;

/** A frame with its packed numbers, see PageFrame. */
export type Moment = { frame: PageFrame; shown_s: number; bodies: Int16Array; contacts: Int16Array };

/** What a robot shows at a time: `mix` 0 is `before`, 1 is `after`. */
export type Sample = { before: Moment; after: Moment; mix: number };

const clamp = (value: number, low: number, high: number) => Math.max(low, Math.min(high, value));
// A copy, as bytes of a message may begin at an odd address.
const unpack = (bytes: Uint8Array) => new Int16Array(bytes.slice(0, bytes.length & ~1).buffer);

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
    const track = (this.tracks[robot] ??= []);
    track.push({ frame, shown_s, bodies: unpack(frame.bodies), contacts: unpack(frame.contacts) });
    // Removed in lumps, as each removal moves the whole array.
    const old = find(track, shown_s - KEPT_S);
    if (old >= 64) track.splice(0, old);
    this.newest_s = Math.max(this.newest_s, shown_s);
  }

  get oldest_s(): number {
    return Math.min(this.newest_s, ...Array.from(this.tracks, (track) => track?.[0]?.shown_s ?? Infinity));
  }

  /** Moves the clock by `wall_s` of wall time. */
  advance(wall_s: number): void {
    const target_s = this.newest_s - DELAY_S;
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
