// SPDX-License-Identifier: Apache-2.0
// Marks the controls of the parameters named by an error; data-parameter is the name of a control's parameter.

const text = Object.assign(document.createElement("small"), {id: "wrong", className: "wrong"});

// Marks only the controls of these parameters; puts the message under the first visible one.
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
