#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hogel::cli {

/// A curve: points (x, y), both positive.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points;
};

/// What stands beside the curves; both axes are logarithmic, x with marks at powers of two.
struct PlotText {
    std::string title, subtitle, x_axis, y_axis;
};

/// Curves as a picture in SVG, each with its name at its end. At least one of them must have a point.
std::string plot_svg(const PlotText& text, const std::vector<Curve>& curves);

}  // namespace hogel::cli
