/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Browsers start no worker from a file on the disk, and the search of the site is one. Opened from
 * the disk, its script runs in a hidden frame instead, which answers as a worker does.
 * Material's offline plugin would load such a script from the web if this one had another name.
 */
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
      this.inside.then((inside) => inside.dispatchEvent(new MessageEvent("message", { data })));
    }
  };
}
