// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/plot.h"

namespace hogel::bench {

/// Axes of a panel: x logarithmic to base 2, y linear or logarithmic with a line at each power of ten.
struct PanelAxes {
    std::string x_name, y_name;
    double min_x, max_x, min_y, max_y, y_step;
    bool y_logarithmic = false;
};

struct Panel {
    std::string title;
    std::vector<Curve> curves;
    std::optional<PanelAxes> axes = {};  ///< none: the shared axes
};

/// Returns an SVG picture of panels in rows, light or dark as the page. Every curve has a marker, and its name at its
/// end. Panels with shared axes show the curves of the others in grey. Points beyond the axes are left out.
std::string panels_svg(const std::string& title, const std::string& subtitle, const PanelAxes& axes,
                       const std::vector<Panel>& panels, std::size_t panels_in_a_row = 3);

/// Named picture of grey levels.
struct SheetPicture {
    std::string name, note;
    std::vector<float> values;  ///< display values, 0 to 1, row-major
};
std::string sheet_svg(const std::string& title, std::size_t width, std::size_t height, std::size_t columns,
                      const std::vector<SheetPicture>& pictures);

}  // namespace hogel::bench
