// SPDX-License-Identifier: Apache-2.0
#include "bench/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hogel::bench {
namespace {

// In pixels.
constexpr double width = 760, height = 480, left = 74, right = 130, top = 66, bottom = 56, note_height = 18;
constexpr double label_distance = 15;  // between the names of two curves

// Distinguishable also with red-green colour blindness.
constexpr std::array colours{"#1f6feb", "#d1242f", "#1a7f37", "#8250df", "#bf8700", "#0e8a8a", "#57606a", "#bc4c00"};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else
            result += c;
    }
    return result;
}

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

struct Axes {
    PlotText::Scale scale;
    Range x, y;  // log2; log10 or tens

    double column(double value) const {
        return left + (std::log2(value) - x.low) / (x.high - x.low) * (width - left - right);
    }
    double row(double value) const {
        return height - bottom - (on_scale(value) - y.low) / (y.high - y.low) * (height - top - bottom);
    }
    double on_scale(double value) const {
        return scale == PlotText::Scale::logarithmic ? std::log10(value) : value / 10;
    }
    double value_at(double position) const {
        return scale == PlotText::Scale::logarithmic ? std::pow(10, position) : 10 * position;
    }
};

Axes axes_of(const PlotText& text, const std::vector<Curve>& curves) {
    Axes axes{text.y, {}, {}};
    for (const auto& [name, level] : text.levels) axes.y.include(axes.on_scale(level));
    for (const Curve& curve : curves)
        for (const auto& [x, y] : curve.points) {
            axes.x.include(std::log2(x));
            axes.y.include(axes.on_scale(y));
        }
    axes.x = {std::floor(axes.x.low), std::max(std::ceil(axes.x.high), std::floor(axes.x.low) + 1)};
    axes.y = {std::floor(axes.y.low), std::max(std::ceil(axes.y.high), std::floor(axes.y.low) + 1)};
    return axes;
}

std::string text_at(double x, double y, const std::string& text, const std::string& style) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, escaped(text));
}

std::string grid_lines(const Axes& axes) {
    std::string svg;
    for (double power = axes.y.low; power <= axes.y.high; ++power) {
        const double y = axes.row(axes.value_at(power));
        svg += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#d0d7de\"/>\n", left, y,
                           width - right, y);
        svg += text_at(left - 9, y + 4, fmt::format("{:g}", axes.value_at(power)), "text-anchor=\"end\"");
        if (power == axes.y.high) break;
        const bool linear = axes.scale == PlotText::Scale::linear;
        for (const double part : {linear ? 0.25 : 0.30103, linear ? 0.5 : 0.69897, linear ? 0.75 : 0.69897}) {
            const double between = axes.row(axes.value_at(power + part));
            svg += fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#eef1f4\"/>\n", left,
                               between, width - right, between);
        }
    }
    for (double power = axes.x.low; power <= axes.x.high; ++power) {
        const double x = axes.column(std::exp2(power));
        svg += fmt::format("<line x1=\"{:.1f}\" y1=\"{}\" x2=\"{:.1f}\" y2=\"{}\" stroke=\"#eef1f4\"/>\n", x, top, x,
                           height - bottom);
        svg += text_at(x, height - bottom + 19, fmt::format("{:g}", std::exp2(power)), "text-anchor=\"middle\"");
    }
    return svg;
}

// Returns the rows of the curves' names, moved apart where they would overlap.
std::vector<double> label_rows(const Axes& axes, const std::vector<Curve>& curves) {
    std::vector<double> rows(curves.size(), 0);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (!curves[i].points.empty()) {
            rows[i] = axes.row(curves[i].points.back().second);
            order.push_back(i);
        }
    std::ranges::sort(order, {}, [&](std::size_t i) { return rows[i]; });
    for (std::size_t i = 1; i < order.size(); ++i)
        rows[order[i]] = std::max(rows[order[i]], rows[order[i - 1]] + label_distance);
    for (std::size_t i = order.size(); i-- > 0;) {
        const double lowest = i + 1 < order.size() ? rows[order[i + 1]] - label_distance : height - bottom;
        rows[order[i]] = std::min(rows[order[i]], lowest);
    }
    return rows;
}

// Returns the dash pattern that distinguishes curves of the same colour.
std::string dashes_of(const Curve& curve, std::size_t number) {
    constexpr std::array patterns{"", "2 3", "10 3 2 3"};
    const char* pattern = curve.dashed ? "6 4" : patterns[number / colours.size() % patterns.size()];
    return *pattern == '\0' ? "" : fmt::format(" stroke-dasharray=\"{}\"", pattern);
}

std::string curve_svg(const Axes& axes, const Curve& curve, std::size_t number, double label_row) {
    if (curve.points.empty()) return "";
    const char* colour = colours[number % colours.size()];
    std::string line, dots;
    for (const auto& [x, y] : curve.points) {
        line += fmt::format("{:.1f},{:.1f} ", axes.column(x), axes.row(y));
        dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", axes.column(x), axes.row(y),
                            colour);
    }
    line.pop_back();
    std::string svg = fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linejoin=\"round\"{}/>\n{}",
        line, colour, dashes_of(curve, number), dots);
    const double end_x = axes.column(curve.points.back().first), end_y = axes.row(curve.points.back().second);
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"0.7\" "
        "stroke-dasharray=\"2 3\"/>\n",
        end_x + 5, end_y, width - right + 6, label_row, colour);
    return svg + text_at(width - right + 10, label_row + 4, curve.name,
                         fmt::format("fill=\"{}\" font-weight=\"600\"", colour));
}

std::string level_svg(const Axes& axes, const std::string& name, double level) {
    const double y = axes.row(level);
    return fmt::format(
               "<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#57606a\" "
               "stroke-dasharray=\"8 5\"/>\n",
               left, y, width - right, y) +
           text_at(left + 8, y - 5, name, "fill=\"#57606a\" font-style=\"italic\"");
}

}  // namespace

std::string plot_svg(const PlotText& text, const std::vector<Curve>& curves) {
    const Axes axes = axes_of(text, curves);
    const double full_height = height + note_height * static_cast<double>(text.notes.size());
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12.5\" fill=\"#24292f\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        width, full_height);
    svg += text_at(left, 27, text.title, "font-size=\"17\" font-weight=\"600\"");
    svg += text_at(left, 47, text.subtitle, "fill=\"#57606a\"");
    svg += grid_lines(axes);
    svg += text_at((left + width - right) / 2, height - 14, text.x_axis, "text-anchor=\"middle\"");
    for (std::size_t i = 0; i < text.notes.size(); ++i)
        svg += text_at(left, height + note_height * static_cast<double>(i) + 4, text.notes[i],
                       "fill=\"#57606a\" font-size=\"11.5\"");
    for (const auto& [name, level] : text.levels) svg += level_svg(axes, name, level);
    const double middle = (top + height - bottom) / 2;
    svg += text_at(18, middle, text.y_axis,
                   fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 18 {:.1f})\"", middle));
    const std::vector<double> rows = label_rows(axes, curves);
    for (std::size_t i = 0; i < curves.size(); ++i) svg += curve_svg(axes, curves[i], i, rows[i]);
    return svg + "</svg>\n";
}

}  // namespace hogel::bench
