// SPDX-License-Identifier: GPL-3.0-or-later
//
// The worker as the page has it. While the library computes a step or reads a mesh it hears no message; one that does
// not hear in time is ended, and another takes its place with the same mesh.

const PATIENCE = 400; // milliseconds: longer than all steps but the first of a full start of many thousand nodes
const LATE = 60; // for what it has said in the meantime, which may still wait

const pause = (time) => new Promise((resolve) => setTimeout(resolve, time));

export class Library {
  /** `text` of the worker's script; `answer` takes what it says; `mesh()`: the one that it works with, or null. */
  constructor(text, { answer, failed, mesh }) {
    Object.assign(this, { answer, failed, mesh });
    this.address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    this.begin();
  }

  begin() {
    this.told = this.heard = 0; // messages
    this.worker = new Worker(this.address);
    this.worker.onmessage = ({ data }) => {
      if (data.kind === "heard") ++this.heard;
      else this.answer(data);
    };
    this.worker.onerror = (event) => this.failed(event.message);
  }

  tell(message) {
    ++this.told;
    this.worker.postMessage(message);
  }

  /** Another worker in place of this one, whatever that is about. */
  replace() {
    this.worker.terminate();
    this.begin();
    const mesh = this.mesh();
    if (mesh) this.tell({ kind: "keep", ...mesh });
  }

  /**
   * Says something that ends what is going on. Where the worker has to be replaced for it, the new one is told the last
   * of such messages, unless `replaced()` gives false.
   */
  async end(message, replaced = () => true) {
    const { worker } = this;
    this.latest = { message, replaced };
    this.tell(message);
    const mine = this.told;
    for (;;) {
      await pause(PATIENCE);
      await pause(LATE);
      if (this.worker !== worker || this.heard >= mine) return;
      if (this.heard > 0) break; // or else it is only just beginning
    }
    this.replace();
    if (this.latest.replaced()) this.tell(this.latest.message);
  }
}
