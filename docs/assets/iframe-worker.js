/* Search without a server: browsers run no workers on pages that were opened as files. Where the page is a file, this
   stands in for `Worker` with a hidden frame of the same page that runs the script and passes messages. */
if (location.protocol === "file:") {
  window.IFrameWorker = class extends EventTarget {
    constructor(url) {
      super();
      const waiting = [];
      const frame = document.createElement("iframe");
      frame.hidden = true;
      frame.setAttribute("aria-hidden", "true");
      document.body.appendChild(frame);
      const inside = frame.contentWindow;
      const deliver = (target, data) => target.dispatchEvent(new MessageEvent("message", { data }));
      inside.postMessage = (data) => deliver(this, data);
      this.postMessage = (data) => waiting.push(data);
      const script = inside.document.createElement("script");
      script.src = new URL(url, location.href).href;
      script.onload = () => {
        this.postMessage = (data) => deliver(inside, data);
        waiting.forEach(this.postMessage);
      };
      this.terminate = () => frame.remove();
      inside.document.head.appendChild(script);
    }
  };
  window.Worker = window.IFrameWorker;
}
