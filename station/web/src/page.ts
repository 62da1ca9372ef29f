// Parts of all pages.
import { Right } from "./messages";
import { Field } from "./values";

export function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`expected the element ${id}`);
  return found as T;
}

// Sets the text, if it is another one: screen readers say what changes.
export function say(id: string, text: string): void {
  const shown = element(id);
  if (shown.textContent !== text) shown.textContent = text;
}

// Says that a page of a viewer changes nothing.
export function sayRight(right: Right): void {
  say("right", right === "viewer" ? "You only look: to act, open the instructor's address with its token." : "");
}

// Address of another page, of the same session.
export const addressOfPage = (page: string, session: string): string => (session ? `${page}?session=${session}` : page);

// Leads the links to the other pages to the session of this one.
export function keepSession(session: string): void {
  for (const link of document.querySelectorAll<HTMLAnchorElement>(".page_link"))
    link.href = addressOfPage(link.getAttribute("href") ?? "", session);
}

// Gives an input the limits and the purpose of a value.
export function limit(made: HTMLInputElement, { min, max, purpose }: Field): void {
  Object.assign(made, { type: "number", step: "any", min: String(min), max: String(max), title: purpose });
}

export function button(text: string, act: () => void): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  made.addEventListener("click", act);
  return made;
}

// Replaces the children of a list, if its content has changed.
export function fill(id: string, mark: string, children: () => Node[]): void {
  const list = element(id);
  if (list.dataset.mark === mark) return;
  list.dataset.mark = mark;
  list.replaceChildren(...children());
}

export function onClick(id: string, act: () => void): void {
  element(id).addEventListener("click", act);
}

export function onSubmit(id: string, act: () => void): void {
  element<HTMLFormElement>(id).addEventListener("submit", (event) => {
    event.preventDefault();
    act();
  });
}
