// WebSocket to the server: binary protobuf messages, connected again after each loss.
import { create, fromBinary, toBinary, type MessageInitShape } from "@bufbuild/protobuf";
import { FromPageSchema, ToPageSchema, type ToPage } from "./generated/page_pb";

const PAUSE_MS_MIN = 200;
const PAUSE_MS_MAX = 2000;
/** A connection that lasted this long makes the pause short again. */
const LASTED_MS = 2000;
/** Code of a server that ends. */
const AWAY = 1001;

/** Any message to the server, as an initialiser. */
export type Request = NonNullable<MessageInitShape<typeof FromPageSchema>["kind"]>;

export class Connection {
  connected = false;
  private socket: WebSocket | undefined;
  private pause_ms = PAUSE_MS_MIN;

  constructor(
    private readonly received: (message: ToPage) => void,
    private readonly changed: (connected: boolean, reason: string) => void,
  ) {
    this.open();
  }

  /** Sends a message, or drops it while the connection is lost. */
  send(kind: Request): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    this.socket.send(toBinary(FromPageSchema, create(FromPageSchema, { kind })));
  }

  private open(): void {
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/socket${location.search}`);
    socket.binaryType = "arraybuffer";
    let opened_ms = Infinity;
    socket.onopen = () => {
      opened_ms = performance.now();
      this.changed((this.connected = true), "");
    };
    socket.onmessage = (event) => {
      if (event.data instanceof ArrayBuffer) this.received(fromBinary(ToPageSchema, new Uint8Array(event.data)));
    };
    socket.onclose = ({ code, reason }) => {
      this.changed((this.connected = false), code === AWAY ? reason : "");
      if (performance.now() - opened_ms > LASTED_MS) this.pause_ms = PAUSE_MS_MIN;
      setTimeout(() => this.open(), this.pause_ms);
      this.pause_ms = Math.min(2 * this.pause_ms, PAUSE_MS_MAX);
    };
    this.socket = socket;
  }
}
