// SPDX-License-Identifier: Apache-2.0
// Plot of the histogram of modulator levels.
import {svg} from "./finder.js";

const width = 280, height = 120, left = 8, right = 8, top = 8, bottom = 22;

export function histogram(told) {
  const most = Math.max(...told.counts, 1), all = told.width * told.height;
  const x = level => left + level / 256 * (width - left - right), y = count => height - bottom - count / most * (height - top - bottom);
  const outline = told.counts.flatMap((count, level) => [`${x(level).toFixed(1)},${y(count).toFixed(1)}`, `${x(level + 1).toFixed(1)},${y(count).toFixed(1)}`]);
  const used = told.counts.filter(count => count > 0).length, percent = value => `${(100 * value).toPrecision(2)} %`;
  const text = `${used} of 256 levels are used, one by ${percent(most / all)} of the pixels at most. Efficiency ${percent(told.efficiency)}.`;
  const picture = svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `Histogram of levels, ${told.encoding}. ${text}`});
  picture.append(svg("polygon", {points: `${x(0)},${y(0)} ${outline.join(" ")} ${x(256)},${y(0)}`, class: "bars"}),
    svg("line", {x1: left, x2: width - right, y1: height - bottom, y2: height - bottom, class: "axis"}),
    svg("text", {x: left, y: height - 6}, "level 0"), svg("text", {x: width - right, y: height - 6, "text-anchor": "end"}, "255"));
  return [picture, Object.assign(document.createElement("small"), {textContent: `${text} ${told.width} × ${told.height} samples in the middle of the first wavelength.`})];
}
