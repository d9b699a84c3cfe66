// SPDX-License-Identifier: Apache-2.0
// WebSocket to the server; reconnects when the connection is lost.

export class Link {
  constructor({onText, onPicture, onLost, onOpen}) {
    Object.assign(this, {onText, onPicture, onLost, onOpen});
    this.wait = 500;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}/live${location.search}`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => { this.wait = 500; this.onOpen(); };
    socket.onmessage = event => {
      if (typeof event.data === "string") return this.onText(JSON.parse(event.data));
      const bytes = new Uint8Array(event.data), end = bytes.indexOf(10);
      const about = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
      this.onPicture(about, new Blob([bytes.subarray(end + 1)], {type: `image/${about.format}`}));
    };
    socket.onclose = () => {
      this.onLost();
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(2 * this.wait, 5000);
    };
    this.socket = socket;
  }

  // Queues nothing: the page repeats its request when the socket opens.
  send(text) { if (this.socket.readyState === WebSocket.OPEN) this.socket.send(text); }
}
