// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/plot.h"

namespace hogel::bench {

/// One of several small plots with the same axes.
struct Panel {
    std::string title;
    std::vector<Curve> curves;
};

/// The axes that all panels share: x logarithmic to base 2, y linear.
struct PanelAxes {
    std::string x_name, y_name;
    double min_x, max_x, min_y, max_y, y_step;
};

/// An SVG picture of panels, three to a row. Every curve has a marker of its own and its name at its end; the curves of
/// the other panels stand behind in grey. Points beyond the axes are left out. Light or dark as the page that shows it.
std::string panels_svg(const std::string& title, const std::string& subtitle, const PanelAxes& axes,
                       const std::vector<Panel>& panels);

/// A picture of named pictures of grey levels, all of the same size, as SVG with the names as text.
struct SheetPicture {
    std::string name, note;
    std::vector<float> values;  ///< display values, 0 to 1, row by row
};
std::string sheet_svg(const std::string& title, std::size_t width, std::size_t height, std::size_t columns,
                      const std::vector<SheetPicture>& pictures);

}  // namespace hogel::bench
