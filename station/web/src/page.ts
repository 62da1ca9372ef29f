// Parts of all pages.
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
