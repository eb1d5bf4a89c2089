// Page of Treadmill: takes messages of the server and draws the robots.
import { equals } from "@bufbuild/protobuf";
import type { Vector3 } from "three";
import { Charts } from "./charts";
import { Connection } from "./connection";
import { MARKINGS } from "./arrows";
import { element, input, onKey, say } from "./dom";
import { PageRobotSchema, type PageRobot, type PageScene, type ToPage } from "./generated/page_pb";
import { Fleet } from "./fleet";
import { Panels } from "./panels";
import { Steering } from "./steering";
import { Timeline } from "./timeline";
import { Transport } from "./transport";
import { View } from "./view";

const PANELS_MS = 80;
/** Durations of frames that are kept for tests. */
const FRAME_TIMES = 240;

const timeline = new Timeline();
const view = new View(element<HTMLCanvasElement>("view"));
const transport = new Transport(timeline, view);
const panels = new Panels(timeline);
const charts = new Charts();
const fleet = new Fleet();
/** Why the server has ended, if it said so. */
let ended = "";
const connection = new Connection(receive, (connected, reason) => {
  // The reason stays while further attempts fail.
  if (reason !== "" || connected) ended = reason;
  say(element("banner"), ended || "Connection lost; trying again");
  element("banner").hidden = connected;
  document.body.classList.toggle("lost", !connected);
  if (!connected) return;
  charts.restart();
  fleet.restart();
  steering.reconnect();
});
const steering = new Steering(connection);

let robots: readonly PageRobot[] = [];

function receive({ kind }: ToPage): void {
  if (kind.case === "scene") setScene(kind.value);
  else if (kind.case === "frame") timeline.add(kind.value);
  else if (kind.case === "curves") charts.add(kind.value);
  else if (kind.case === "notice") say(element("notice"), kind.value);
  else if (kind.case === "status") fleet.add(kind.value);
  else if (kind.case === "steerer") steering.setSteerer(kind.value);
}

function setScene(scene: PageScene): void {
  document.title = scene.title || "Treadmill";
  say(element("title"), document.title);
  // Frames of the same robots stay, as after a short loss of the connection.
  const kept = (robot: PageRobot, index: number) => equals(PageRobotSchema, robot, robots[index]!);
  if (robots.length !== scene.robots.length || !scene.robots.every(kept)) {
    robots = scene.robots;
    timeline.clear();
    view.setRobots(robots);
    panels.setRobots(robots);
  }
  view.setGround(scene.ground);
  steering.setScene(scene);
}

/** Passes the borders that panels cover on to the view. */
function cover(): void {
  const box = (id: string) => element(id).getBoundingClientRect();
  const narrow = getComputedStyle(element("tabs")).display !== "none";
  const [left, right] = narrow ? [0, 0] : [box("steer").right, innerWidth - box("numbers").left];
  const top = Math.max(box("title").bottom, box("alarms").bottom);
  view.cover(left, right, top, innerHeight - box("transport").top);
}

for (const marking of MARKINGS) {
  const box = input(marking === "left" || marking === "right" ? "show-feet" : `show-${marking}`);
  const show = () => (view.arrows.rods[marking].group.visible = box.checked);
  box.addEventListener("change", show);
  show();
}
input("follow").addEventListener("change", () => (view.following = input("follow").checked));
const help = element<HTMLDialogElement>("help");
element("help-open").addEventListener("click", () => help.showModal());
onKey((key) => {
  if (key === "?") help.showModal();
  if (key === "f") input("follow").click();
});
for (const head of document.querySelectorAll(".head")) {
  head.addEventListener("click", () => (head.ariaExpanded = String(head.ariaExpanded !== "true")));
}
const sizes = new ResizeObserver(cover);
for (const id of ["view", "steer", "numbers", "curves", "fleet", "alarms", "transport"]) sizes.observe(element(id));

let before_ms = performance.now();
let panels_ms = 0;
/** Times of the last pictures, and from a pose to its picture. */
const frames_ms: number[] = [];
const ages_ms: number[] = [];
function keep(times_ms: number[], time_ms: number): void {
  if (times_ms.push(time_ms) > FRAME_TIMES) times_ms.shift();
}

function draw(now_ms: number): void {
  requestAnimationFrame(draw);
  const wall_s = Math.max(0, now_ms - before_ms) / 1000;
  before_ms = now_ms;
  keep(frames_ms, 1000 * wall_s);
  timeline.advance(Math.min(wall_s, 0.5));
  view.draw(timeline, wall_s);
  keep(ages_ms, 1000 * timeline.age_s);
  steering.poll(now_ms);
  if (now_ms - panels_ms < PANELS_MS) return;
  panels_ms = now_ms;
  transport.update();
  panels.update();
  steering.update(timeline.sample(0)?.before.frame ?? timeline.newest(0));
  const curves = charts.update();
  element("curves").hidden = element("tab-curves").hidden = !curves;
  const status = fleet.update(now_ms);
  element("fleet").hidden = element("tab-fleet").hidden = !status;
}
requestAnimationFrame(draw);

/** The frame of robot 0 that is drawn now. */
function shown() {
  const sample = timeline.sample(0);
  const robot = view.robots[0];
  if (sample === undefined || robot === undefined) return undefined;
  const { episode, timeS: time_s, command, velocity, anglesMrad } = (sample.mix < 0.5 ? sample.before : sample.after).frame;
  const inWorld = ({ x, y, z }: Vector3) => [x, y - robot.offset_m, z];
  return {
    ...{ robot: 0, episode: Number(episode), time_s, shown_s: timeline.time_s, command, velocity },
    base_m: inWorld(robot.base),
    bodies_m: robot.bodies.map((body) => inWorld(body.position.clone().add(robot.base))),
    angles_rad: anglesMrad.map((angle_mrad) => angle_mrad / 1000),
    centre_of_mass_m: robot.hasCentre ? inWorld(robot.centre) : undefined,
  };
}

// For tests of the page in a browser.
const treadmill = {
  shown,
  frames: () => timeline.received,
  robots: () => view.robots.length,
  bodies: () => view.robots.map(({ bodies }) => bodies.filter(({ children }) => children.length > 0).length),
  ghosts: () => view.robots.filter(({ ghost }) => ghost.visible).length,
  connected: () => connection.connected,
  steers: () => steering.steers,
  othersSteer: () => steering.othersSteer,
  fleet: () => fleet.counts,
  bands: () => charts.bands,
  frameTimes: () => [...frames_ms],
  latencies: () => [...ages_ms],
};
Object.assign(window, { treadmill });
