// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hogel::bench {

/// Curve of points (x, y). Coordinates must be positive on logarithmic axes.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
    bool dashed = false;  ///< for curves that are partly estimated
};

/// Text and axes of a plot. The x axis is logarithmic, with marks at powers of two.
struct PlotText {
    enum class Scale { logarithmic, linear };

    std::string title, subtitle, x_axis, y_axis;
    Scale y = Scale::logarithmic;
    std::vector<std::string> notes = {};                      ///< lines below the axis
    std::vector<std::pair<std::string, double>> levels = {};  ///< names and heights of horizontal lines
};

/// Returns an SVG picture of curves, each with its name at its end. At least one curve must have a point.
std::string plot_svg(const PlotText& text, const std::vector<Curve>& curves);

}  // namespace hogel::bench
