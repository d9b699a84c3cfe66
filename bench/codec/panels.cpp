// SPDX-License-Identifier: Apache-2.0
#include "bench/codec/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

#include "bench/temporary_folder.h"
#include "hogel/image.h"

namespace hogel::bench {
namespace {

// In pixels.
constexpr double panel_width = 345, panel_height = 300, left = 46, right = 92, top = 34, bottom = 44, head = 58;
constexpr double label_distance = 15;

// Colours that are legible on white and on black, and distinguishable with red-green colour blindness.
constexpr std::array colours{"#2f81f7", "#e5534b", "#2da44e", "#a371f7", "#bf8700", "#1b9aaa", "#d664a8"};

const char* const style = R"(<style>
  text { font: 12px system-ui, 'Liberation Sans', Helvetica, sans-serif; fill: #24292f }
  .head { font-size: 17px; font-weight: 600 } .title { font-weight: 600 } .mute { fill: #57606a }
  .paper { fill: #ffffff } .grid { stroke: #d8dee4 } .other { stroke: #d0d7de; fill: none }
  .hole { fill: #ffffff }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6edf3 } .mute { fill: #9ba7b4 } .paper { fill: #0d1117 } .hole { fill: #0d1117 }
    .grid { stroke: #262c34 } .other { stroke: #3a424c }
  }
</style>
)";

struct Frame {
    PanelAxes axes;
    double x0, y0;  // top left corner of the panel

    double column(double x) const {
        return x0 + left +
               std::log2(x / axes.min_x) / std::log2(axes.max_x / axes.min_x) * (panel_width - left - right);
    }
    double row(double y) const {
        const double part = axes.y_logarithmic ? std::log(y / axes.min_y) / std::log(axes.max_y / axes.min_y)
                                               : (y - axes.min_y) / (axes.max_y - axes.min_y);
        return y0 + panel_height - bottom - part * (panel_height - top - bottom);
    }
    bool holds(const std::pair<double, double>& point) const {
        return point.first >= axes.min_x && point.first <= axes.max_x && point.second >= axes.min_y &&
               point.second <= axes.max_y;
    }
    std::pair<double, double> position(const std::pair<double, double>& point) const {
        return {column(point.first), row(point.second)};
    }
    std::vector<std::pair<double, double>> markers(const Curve& curve) const {
        std::vector<std::pair<double, double>> positions;
        for (const auto& point : curve.points)
            if (holds(point)) positions.push_back(position(point));
        return positions;
    }
    // Returns the part of a curve within the axes, cut where it leaves them between two points.
    std::vector<std::pair<double, double>> line(const Curve& curve) const {
        std::vector<std::pair<double, double>> points = curve.points, positions;
        std::ranges::sort(points);
        constexpr int parts = 64;
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
            for (int part = 0; part <= parts; ++part) {
                const double weight = static_cast<double>(part) / parts;
                const std::pair<double, double> between{
                    points[k].first * std::pow(points[k + 1].first / points[k].first, weight),
                    points[k].second + weight * (points[k + 1].second - points[k].second)};
                const bool edge = part == 0 || part == parts, inside = holds(between);
                const bool next_to_end = !edge && inside && (!holds(points[k]) || !holds(points[k + 1]));
                if (inside && (edge || next_to_end)) positions.push_back(position(between));
            }
        return positions;
    }
};

std::string polyline(const std::vector<std::pair<double, double>>& points, const std::string& attributes) {
    std::string line;
    for (const auto& [x, y] : points) line += fmt::format("{:.1f},{:.1f} ", x, y);
    return fmt::format("<polyline points=\"{}\" {}/>\n", line, attributes);
}

// Markers differ in shape, so that curves can be distinguished without colours.
std::string marker(std::size_t number, double x, double y) {
    const char* colour = colours[number % colours.size()];
    switch (number % colours.size()) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" fill=\"{}\"/>\n", x, y, colour);
        case 1:
            return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"{}\"/>\n", x - 3, y - 3,
                               colour);
        case 2:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4 7h-8z\" fill=\"{}\"/>\n", x, y - 4.2, colour);
        case 3:
            return fmt::format("<path d=\"M{:.1f} {:.1f}l4.2 4.2l-4.2 4.2l-4.2 -4.2z\" fill=\"{}\"/>\n", x, y - 4.2,
                               colour);
        case 4:
            return fmt::format(
                "<path d=\"M{:.1f} {:.1f}l7 7m-7 0l7 -7\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n",
                x - 3.5, y - 3.5, colour);
        case 5:
            return fmt::format(
                "<path d=\"M{:.1f} {:.1f}h8m-4 -4v8\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", x - 4, y,
                colour);
        default:
            return fmt::format(
                "<circle class=\"hole\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\" stroke=\"{}\" stroke-width=\"1.6\"/>\n",
                x, y, colour);
    }
}

std::string grid_svg(const Frame& frame) {
    const PanelAxes& axes = frame.axes;
    std::string svg;
    for (double y = axes.min_y; y <= axes.max_y * (1 + 1e-9); axes.y_logarithmic ? y *= 10 : y += axes.y_step) {
        svg += fmt::format("<line class=\"grid\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                           frame.column(axes.min_x), frame.row(y), frame.column(axes.max_x), frame.row(y));
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n",
                           frame.column(axes.min_x) - 6, frame.row(y) + 4, y);
    }
    for (double x = axes.min_x; x <= axes.max_x; x *= 2) {
        svg += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\"/>\n",
                           frame.column(x), frame.row(axes.min_y), frame.row(axes.max_y));
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:g}</text>\n", frame.column(x),
                           frame.row(axes.min_y) + 16, x);
    }
    return svg;
}

// Returns the rows of names at the right ends of curves, moved apart where they would overlap.
std::vector<double> name_rows(const Frame& frame, const std::vector<std::vector<std::pair<double, double>>>& lines) {
    std::vector<double> rows(lines.size(), frame.row(frame.axes.min_y));
    std::vector<std::size_t> order(lines.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (!lines[i].empty()) rows[i] = lines[i].back().second;
    std::ranges::sort(order, {}, [&](std::size_t i) { return rows[i]; });
    for (std::size_t i = 1; i < order.size(); ++i)
        rows[order[i]] = std::max(rows[order[i]], rows[order[i - 1]] + label_distance);
    double lowest = frame.row(frame.axes.min_y);
    for (std::size_t i = order.size(); i-- > 0; lowest = rows[order[i]] - label_distance)
        rows[order[i]] = std::min(rows[order[i]], lowest);
    return rows;
}

std::string panel_svg(const Frame& frame, const Panel& panel, const std::vector<Panel>& all) {
    std::string svg = grid_svg(frame);
    svg += fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", frame.x0 + left,
                       frame.y0 + top - 12, panel.title);
    for (const Panel& other : all)
        if (&other != &panel && !panel.axes && !other.axes)
            for (const Curve& curve : other.curves)
                svg += polyline(frame.line(curve), "class=\"other\" stroke-width=\"1\"");
    std::vector<std::vector<std::pair<double, double>>> lines;
    for (const Curve& curve : panel.curves) lines.push_back(frame.line(curve));
    const std::vector<double> rows = name_rows(frame, lines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].empty()) continue;
        const char* colour = colours[i % colours.size()];
        const double name_x = frame.x0 + panel_width - right + 12;
        svg += polyline(lines[i], fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}", colour,
                                              panel.curves[i].dashed ? " stroke-dasharray=\"6 4\"" : ""));
        for (const auto& [x, y] : frame.markers(panel.curves[i])) svg += marker(i, x, y);
        svg +=
            polyline({lines[i].back(), {name_x - 6, rows[i]}},
                     fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"0.7\" stroke-dasharray=\"2 2\"", colour));
        svg += marker(i, name_x, rows[i]);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"fill:{};font-weight:600\">{}</text>\n", name_x + 7,
                           rows[i] + 4, colour, panel.curves[i].name);
    }
    return svg;
}

std::string base64(const std::vector<char>& bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace

std::string panels_svg(const std::string& title, const std::string& subtitle, const PanelAxes& axes,
                       const std::vector<Panel>& panels, std::size_t panels_in_a_row) {
    const std::size_t columns = std::min(panels_in_a_row, panels.size()),
                      rows = (panels.size() + columns - 1) / columns;
    const double width = panel_width * static_cast<double>(columns),
                 height = head + panel_height * static_cast<double>(rows);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\">\n{2}"
        "<rect class=\"paper\" width=\"{0:g}\" height=\"{1:g}\"/>\n<text class=\"head\" x=\"16\" y=\"27\">{3}</text>\n"
        "<text class=\"mute\" x=\"16\" y=\"47\">{4}</text>\n",
        width, height, style, title, subtitle);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const PanelAxes& panel_axes = panels[i].axes ? *panels[i].axes : axes;
        const Frame frame{panel_axes, panel_width * static_cast<double>(i % columns),
                          head + panel_height * static_cast<double>(i / columns)};
        svg += panel_svg(frame, panels[i], panels);
        if (i + columns >= panels.size())
            svg += fmt::format("<text class=\"mute\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                               frame.x0 + (left + panel_width - right) / 2, frame.y0 + panel_height - 10,
                               panel_axes.x_name);
        // Names a panel's y axis unless the panel to its left has the same name.
        if (i % columns == 0 ||
            (panels[i].axes && panel_axes.y_name != (panels[i - 1].axes ? *panels[i - 1].axes : axes).y_name)) {
            const double middle = frame.y0 + (top + panel_height - bottom) / 2;
            svg += fmt::format(
                "<text class=\"mute\" x=\"{2:.1f}\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 "
                "{2:.1f} "
                "{0:.1f})\">{1}</text>\n",
                middle, panel_axes.y_name, frame.x0 + 13);
        }
    }
    return svg + "</svg>\n";
}

std::string sheet_svg(const std::string& title, std::size_t width, std::size_t height, std::size_t columns,
                      const std::vector<SheetPicture>& pictures) {
    constexpr std::size_t gap = 10, caption = 36, title_height = 40;
    const std::size_t rows = (pictures.size() + columns - 1) / columns;
    const std::size_t sheet_width = columns * (width + gap) + gap,
                      sheet_height = title_height + rows * (height + caption + gap);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n{2}"
        "<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n<text class=\"head\" x=\"{3}\" y=\"26\">{4}</text>\n",
        sheet_width, sheet_height, style, gap, title);
    const TemporaryFolder folder;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const SheetPicture& picture = pictures[i];
        Array<std::uint8_t, 3> levels({height, width, 1});
        std::ranges::transform(picture.values, levels.elements().begin(), [](float value) {
            return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
        });
        const std::filesystem::path file = folder.path() / "a.png";
        write_raw_pixels(file, levels.view());
        std::ifstream in(file, std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
        const std::size_t x = gap + i % columns * (width + gap),
                          y = title_height + i / columns * (height + caption + gap);
        svg += fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>\n",
                           x, y, width, height, base64(bytes));
        svg += fmt::format(
            "<text class=\"title\" x=\"{0}\" y=\"{1}\">{2}</text>\n<text class=\"mute\" x=\"{0}\" "
            "y=\"{3}\">{4}</text>\n",
            x, y + height + 15, picture.name, y + height + 30, picture.note);
    }
    return svg + "</svg>\n";
}

}  // namespace hogel::bench
