// The picture: a canvas with the pixels of the published frame. Where a pixel covers a whole number of the screen's
// pixels they stay sharp; else the browser smooths them.
import { FrameMessage } from "./messages";

export class Picture {
  private readonly context: CanvasRenderingContext2D;
  private drawn = 0n; // id of the frame on the canvas
  private queue: Promise<void> = Promise.resolve();

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d", { alpha: false });
    if (!context) throw new Error("expected a browser with canvas, found one without");
    this.context = context;
    new ResizeObserver(() => this.fit()).observe(canvas);
  }

  private fit(): void {
    const scale = (this.canvas.getBoundingClientRect().width * devicePixelRatio) / this.canvas.width;
    this.canvas.classList.toggle("whole", scale >= 0.99 && Math.abs(scale - Math.round(scale)) < 0.01);
  }

  // Draws frames in the order in which they come, whatever the decoding of each takes.
  show(frame: FrameMessage): void {
    const decoded = createImageBitmap(frame.png, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    this.queue = this.queue.then(async () => {
      const bitmap = await decoded;
      this.draw(frame, bitmap);
      bitmap.close();
    }).catch(() => undefined); // a damaged picture: the next whole one replaces it
  }

  private draw(frame: FrameMessage, bitmap: ImageBitmap): void {
    if (frame.base !== 0n && frame.base !== this.drawn) return;
    if (this.canvas.width !== frame.width || this.canvas.height !== frame.height) {
      this.canvas.width = frame.width;
      this.canvas.height = frame.height;
      this.fit();
    }
    this.context.drawImage(bitmap, frame.x, frame.y);
    this.drawn = frame.id;
    this.canvas.dataset.frame = String(frame.id);
    this.canvas.dataset.simTime = String(frame.simTime_s);
  }
}
