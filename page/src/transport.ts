// Bar at the bottom: playback, picture, film and full screen.
import { choice, element, input, onKey, press, say } from "./dom";
import type { Timeline } from "./timeline";
import type { View } from "./view";

const FILM_FPS = 60;
const FILM_BITS_PER_S = 12_000_000;

function download(blob: Blob, extension: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = `treadmill-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}.${extension}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export class Transport {
  private readonly play = element("play");
  private readonly speed = choice("speed");
  private readonly scrub = input("scrub");
  private readonly film = element("film");
  private recorder: MediaRecorder | undefined;

  constructor(private readonly timeline: Timeline, private readonly view: View) {
    const actions: Record<string, [id: string, act: () => void]> = {
      " ": ["play", () => timeline.pause(!timeline.paused)],
      ArrowLeft: ["back", () => timeline.step(-1)],
      ArrowRight: ["forth", () => timeline.step(1)],
      l: ["live", () => timeline.goLive()],
      p: ["picture", () => void view.picture(timeline).then((blob) => blob && download(blob, "png"))],
      v: ["film", () => this.record()],
    };
    for (const [id, act] of Object.values(actions)) element(id).addEventListener("click", act);
    onKey((key, event) => {
      if (!(key in actions)) return;
      event.preventDefault();
      actions[key]![1]();
    });
    this.speed.addEventListener("change", () => timeline.setSpeed(Number(this.speed.value)));
    this.scrub.addEventListener("input", () => {
      if (Number(this.scrub.value) === 0) timeline.goLive();
      else timeline.scrub(timeline.newest_s + Number(this.scrub.value));
    });
    element("full").addEventListener("click", () => {
      const { fullscreenElement, documentElement } = document;
      const asked = fullscreenElement === null ? documentElement.requestFullscreen() : document.exitFullscreen();
      // The browser may refuse, as in a frame; the button then shows that nothing changed.
      asked.catch(() => undefined);
    });
    document.addEventListener("fullscreenchange", () => press(element("full"), document.fullscreenElement !== null));
    element("full").hidden = !document.fullscreenEnabled;
    this.film.hidden = typeof MediaRecorder === "undefined";
  }

  /** Shows the state of the timeline. */
  update(): void {
    const { timeline } = this;
    this.play.classList.toggle("paused", timeline.paused);
    this.play.ariaLabel = timeline.paused ? "Play" : "Pause";
    element("live").classList.toggle("on", timeline.live);
    this.speed.value = String(timeline.speed);
    const behind_s = timeline.live ? 0 : timeline.newest_s - timeline.time_s;
    this.scrub.min = String(-Math.max(1, timeline.newest_s - timeline.oldest_s));
    this.scrub.value = String(-behind_s);
    say(element("behind"), timeline.live ? "" : `−${behind_s.toFixed(2)} s`);
  }

  private record(): void {
    if (this.recorder !== undefined) return this.recorder.stop();
    const types = ["video/webm;codecs=vp9", "video/webm", "video/mp4"];
    const mimeType = types.find((type) => MediaRecorder.isTypeSupported(type)) ?? "";
    const stream = this.view.canvas.captureStream(FILM_FPS);
    const recorder = new MediaRecorder(stream, { mimeType, videoBitsPerSecond: FILM_BITS_PER_S });
    const parts: Blob[] = [];
    recorder.ondataavailable = (event) => parts.push(event.data);
    recorder.onstop = () => {
      this.recorder = undefined;
      press(this.film, false);
      const { mimeType: type } = recorder;
      download(new Blob(parts, { type }), type.includes("mp4") ? "mp4" : "webm");
    };
    recorder.start(1000);
    this.recorder = recorder;
    press(this.film, true);
  }
}
