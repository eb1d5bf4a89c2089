// Elements of index.html by their id.
export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`index.html has no element ${id}`);
  return found as T;
}

export const input = (id: string) => element<HTMLInputElement>(id);
export const choice = (id: string) => element<HTMLSelectElement>(id);

/** Sets text only if it changed, so that nothing is laid out again. */
export function say(target: Element, text: string): void {
  if (target.textContent !== text) target.textContent = text;
}

/** Makes an element of a class, with text or elements in it. */
export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  name = "",
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const made = document.createElement(tag);
  made.className = name;
  made.append(...children);
  return made;
}

export function option(value: string, text = value): HTMLOptionElement {
  const made = make("option", "", text);
  made.value = value;
  return made;
}

/** Colour of the style sheet. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export const isPressed = (button: Element) => button.ariaPressed === "true";
export const press = (button: Element, pressed: boolean) => (button.ariaPressed = String(pressed));

/** Calls `act` with the key for each press that no form control needs. */
export function onKey(act: (key: string, event: KeyboardEvent) => void): void {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]") !== null) return;
    const focus = event.target instanceof HTMLElement ? event.target.tagName : "";
    if (focus === "SELECT" || (focus === "INPUT" && /^(Arrow|\d| )/.test(event.key))) return;
    if (event.key === " " && (focus === "BUTTON" || focus === "SUMMARY")) return;
    act(event.key.length === 1 ? event.key.toLowerCase() : event.key, event);
  });
  // A button that was clicked would take the next space bar.
  addEventListener("click", (event) => {
    if (event.detail > 0) (event.target as Element).closest<HTMLElement>("button, summary")?.blur();
  });
}
