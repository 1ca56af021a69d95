/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The search takes a word that begins with a minus for one that must not be there, and two of them
 * for an error, so that no option of a command could be found: what is asked loses them.
 *
 * Browsers start no worker from a file on the disk, and the search of the site is one. Opened from
 * the disk, its script runs in a hidden frame instead, which answers as a worker does.
 * Material's offline plugin would load such a script from the web if this one had another name.
 */
const asked = (message) =>
  typeof message.data === "string"
    ? { ...message, data: message.data.replace(/(^|\s)-+(?=\w)/g, "$1") }
    : message;

if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(address) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      frame.srcdoc = `<script src="${new URL(address, location)}"></script>`;
      this.inside = new Promise((resolve) => {
        frame.onload = () => resolve(frame.contentWindow);
      });
      this.inside.then((inside) => {
        inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      });
      document.body.append(frame);
    }

    postMessage(data) {
      this.inside.then((inside) => inside.dispatchEvent(new MessageEvent("message", { data: asked(data) })));
    }
  };
} else {
  window.Worker = class extends Worker {
    postMessage(data) {
      super.postMessage(asked(data));
    }
  };
}
