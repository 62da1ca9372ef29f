// The line that says what was taken away, with a button that brings it back. The last one is offered first.
import { Answer } from "./messages";
import { element, say } from "./page";

const MAX_OFFERS = 20;
const DONE_MS = 8000; // what is done is said for so long
const OFFERED_MS = 60000; // an undo is offered for so long

interface Offer {
  text: string; // what was done: "Removed rain 3"
  restored: string; // what is said after the undo: "rain 3 is back"
  undo: () => Promise<Answer>;
}

export class UndoLine {
  private readonly offers: Offer[] = [];
  private clearing: ReturnType<typeof setTimeout> | undefined;
  private readonly button = element<HTMLButtonElement>("undo_button");

  constructor() {
    this.button.addEventListener("click", () => void this.undo());
    element("undo_close").addEventListener("click", () => this.forget());
    window.addEventListener("keydown", (event) => {
      // A field has an undo of its own.
      const types = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
      if (types || event.key.toLowerCase() !== "z" || !(event.ctrlKey || event.metaKey) || event.shiftKey ||
        this.offers.length === 0) return;
      event.preventDefault();
      void this.undo();
    });
  }

  // The button gets the focus, because the one that was pressed is often gone.
  offer(offer: Offer): void {
    this.offers.push(offer);
    if (this.offers.length > MAX_OFFERS) this.offers.shift();
    this.show(`${offer.text}.`);
    this.button.focus({ preventScroll: true });
  }

  forget(): void {
    this.offers.length = 0;
    this.show("");
  }

  private async undo(): Promise<void> {
    const offer = this.offers.pop();
    if (!offer) return;
    const { problem } = await offer.undo();
    if (problem !== null) this.offers.unshift(offer); // without radar-model, say: it is offered again, after the others
    const next = this.offers[this.offers.length - 1];
    const done = problem === null ? `${offer.restored}.` : "";
    this.show(next ? `${done} Before: ${next.text}.` : done);
  }

  private show(text: string): void {
    clearTimeout(this.clearing);
    const offers = this.offers.length > 0;
    if (text !== "") this.clearing = setTimeout(() => this.forget(), offers ? OFFERED_MS : DONE_MS);
    say("undo_text", text);
    this.button.hidden = !offers;
    element("undo_close").hidden = text === "";
    element("undo").classList.toggle("shown", text !== "");
  }
}
