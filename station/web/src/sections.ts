// The links to the sections of a long page: each opens its section, shows it below the links and moves the focus there.
import { element } from "./page";

export function listenToSections(): void {
  for (const link of document.querySelectorAll<HTMLAnchorElement>("#sections a")) {
    const section = element(link.hash.slice(1));
    link.addEventListener("click", (event) => {
      event.preventDefault();
      if (section instanceof HTMLDetailsElement) section.open = true;
      section.scrollIntoView();
      const first = section.querySelector<HTMLElement>("summary, canvas");
      first?.focus({ preventScroll: true });
    });
  }
}
