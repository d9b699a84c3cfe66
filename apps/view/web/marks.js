// SPDX-License-Identifier: Apache-2.0
// Marks the controls of the parameters that an error names; a control's data-parameter says which one it sets.

const text = Object.assign(document.createElement("small"), {id: "wrong", className: "wrong"});

// Marks the controls of these parameters and no others, with the message under the first one that is visible.
export function mark(parameters, message) {
  text.remove();
  text.textContent = message;
  for (const control of document.querySelectorAll("[data-parameter]")) {
    const wrong = parameters.includes(control.dataset.parameter);
    set(control, "aria-invalid", wrong && "true");
    set(control, "aria-errormessage", wrong && text.id);
    if (wrong && !text.isConnected && control.checkVisibility()) control.closest(".control").append(text);
  }
}

const set = (element, name, value) => value ? element.setAttribute(name, value) : element.removeAttribute(name);
