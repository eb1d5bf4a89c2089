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

export function option(value: string, text = value): HTMLOptionElement {
  const made = document.createElement("option");
  [made.value, made.textContent] = [value, text];
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
