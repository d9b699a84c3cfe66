// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hogel::cli {

/// A curve: points (x, y), positive where their axis is logarithmic.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
    bool dashed = false;  ///< what was not measured point by point
};

/// What stands beside the curves. The x axis is logarithmic, with marks at powers of two.
struct PlotText {
    enum class Scale { logarithmic, linear };

    std::string title, subtitle, x_axis, y_axis;
    Scale y = Scale::logarithmic;
    std::vector<std::string> notes = {};                      ///< lines below the axis
    std::vector<std::pair<std::string, double>> levels = {};  ///< names and heights of horizontal lines
};

/// Curves as a picture in SVG, each with its name at its end. At least one of them must have a point.
std::string plot_svg(const PlotText& text, const std::vector<Curve>& curves);

}  // namespace hogel::cli
