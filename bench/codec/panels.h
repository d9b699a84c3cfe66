// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/plot.h"

namespace hogel::bench {

/// The axes of a panel: x logarithmic to base 2, y linear or logarithmic with a line at each power of ten.
struct PanelAxes {
    std::string x_name, y_name;
    double min_x, max_x, min_y, max_y, y_step;
    bool y_logarithmic = false;
};

/// One of several small plots.
struct Panel {
    std::string title;
    std::vector<Curve> curves;
    std::optional<PanelAxes> axes = {};  ///< none: those that panels share
};

/// An SVG picture of panels in rows. Every curve has a marker of its own and its name at its end; behind panels with
/// shared axes the curves of the others stand in grey. Points beyond the axes are left out. Light or dark as the page
/// that shows it.
std::string panels_svg(const std::string& title, const std::string& subtitle, const PanelAxes& axes,
                       const std::vector<Panel>& panels, std::size_t panels_in_a_row = 3);

/// A picture of named pictures of grey levels, all of the same size, as SVG with the names as text.
struct SheetPicture {
    std::string name, note;
    std::vector<float> values;  ///< display values, 0 to 1, row by row
};
std::string sheet_svg(const std::string& title, std::size_t width, std::size_t height, std::size_t columns,
                      const std::vector<SheetPicture>& pictures);

}  // namespace hogel::bench
