// SPDX-License-Identifier: Apache-2.0
// Focus finder: plot of the sharpness of a hologram over depth. A click focuses at a depth.

export const svg = (name, attributes, text) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text) element.textContent = text;
  return element;
};

const width = 280, height = 150, left = 8, right = 8, top = 10, bottom = 26;

// go(depth): focuses at a depth in millimetres.
export function plot(search, go) {
  const depths = search.depths_m.map(depth => 1e3 * depth), from = depths[0], to = depths.at(-1);
  const x = depth => left + (depth - from) / (to - from) * (width - left - right);
  const line = (values, name) => {
    const logs = values.map(value => Math.log(Math.max(value, 1e-12))), low = Math.min(...logs), range = Math.max(...logs) - low || 1;
    const points = logs.map((value, i) => `${x(depths[i]).toFixed(1)},${(height - bottom - (value - low) / range * (height - top - bottom)).toFixed(1)}`);
    return svg("polyline", {points: points.join(" "), class: name});
  };
  const found = search.planes.slice(0, 5).map(plane => 1e3 * plane.depth_m);
  const words = depth => `${+depth.toFixed(Math.abs(depth) < 10 ? 2 : 1)} mm`;
  const picture = svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img",
    "aria-label": `Contrast against depth from ${words(from)} to ${words(to)}. ${found.length ? `In focus at ${found.map(words).join(", ")}.` : "No depth stands out."}`});
  picture.append(svg("line", {x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, class: "axis"}),
    line(search.edges, "edges"), line(search.squares, "squares"),
    ...found.map(depth => svg("line", {x1: x(depth), x2: x(depth), y1: top, y2: height - bottom, class: "found"})),
    svg("text", {x: left, y: height - 8}, words(from)), svg("text", {x: width - right, y: height - 8, "text-anchor": "end"}, words(to)));
  picture.addEventListener("click", event => {
    const box = picture.getBoundingClientRect(), at = (event.clientX - box.left) / box.width * width;
    const depth = from + Math.min(Math.max((at - left) / (width - left - right), 0), 1) * (to - from);
    const near = found.find(plane => Math.abs(x(plane) - at) < 6);
    go(near ?? depth);
  });
  const planes = document.createElement("div");
  planes.className = "planes";
  for (const depth of found) {
    const button = Object.assign(document.createElement("button"), {type: "button", textContent: words(depth)});
    button.addEventListener("click", () => go(depth));
    planes.append(button);
  }
  return [picture, planes];
}
