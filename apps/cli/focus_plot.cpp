// SPDX-License-Identifier: Apache-2.0
#include "focus_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hogel/error.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"

namespace hogel::cli {
namespace {

// Size of the drawing and its margins, in points.
constexpr double width = 900, height = 500, left = 70, right = 20, top = 80, bottom = 50;
constexpr std::array<const char*, 5> colours{"#1f5fa8", "#c8501e", "#3b8a3e", "#7a4fa3", "#666666"};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += static_cast<unsigned char>(c) < ' ' && c != '\n' ? ' ' : c;
        }
    return result;
}

// Returns a tick step of 1, 2 or 5 times a power of ten, for about ten ticks in the range.
double round_step(double range) {
    const double power = std::pow(10, std::floor(std::log10(range / 10)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (range / (factor * power) <= 12) return factor * power;
    return 10 * power;
}

class Plot {
  public:
    explicit Plot(const FocusSearch& search) : search_(search) {
        low_ = high_ = std::log10(floor_of(search.contrasts.front()[0]));
        for (const auto& row : search.contrasts)
            for (const double contrast : row) {
                low_ = std::min(low_, std::log10(floor_of(contrast)));
                high_ = std::max(high_, std::log10(floor_of(contrast)));
            }
        if (high_ - low_ < 0.1) high_ = low_ + 0.1;
    }

    std::string drawn(const std::string& title, const Metadata& metadata) const {
        std::string svg = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" font-family=\"sans-serif\" "
            "font-size=\"13\">\n<desc>",
            width, height);
        for (const auto& [key, text] : metadata) svg += escaped(fmt::format("{}: {}\n", key, text));
        svg += fmt::format("</desc>\n<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"white\"/>\n", width, height);
        svg += fmt::format("<text x=\"{:.0f}\" y=\"22\" font-size=\"15\">{}</text>\n", left, escaped(title));
        return svg + planes() + axes() + curves() + "</svg>\n";
    }

  private:
    static double floor_of(double contrast) { return std::max(contrast, 1e-4); }
    double x(double depth) const {
        const double first = search_.depths.front(), last = search_.depths.back();
        return left + (width - left - right) * (depth - first) / (last - first);
    }
    double y(double logarithm) const { return top + (height - top - bottom) * (high_ - logarithm) / (high_ - low_); }

    std::string planes() const {
        std::string svg;
        for (const FocusPlane& plane : search_.planes)
            svg += fmt::format(
                "<line x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.0f}\" y2=\"{2:.0f}\" stroke=\"#999\" "
                "stroke-dasharray=\"4 3\"/>\n<text x=\"{0:.2f}\" y=\"{3:.0f}\" text-anchor=\"middle\">{4}</text>\n",
                x(plane.depth), top, height - bottom, top - 6, format_length(plane.depth));
        return svg;
    }

    std::string axes() const {
        std::string svg = fmt::format(
            "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"none\" stroke=\"black\"/>\n",
            left, top, width - left - right, height - top - bottom);
        const double first = search_.depths.front() * 1e3, last = search_.depths.back() * 1e3,
                     step = round_step(last - first);
        for (double tick = std::ceil(first / step) * step; tick <= last + 1e-9 * step; tick += step)
            svg += fmt::format(
                "<line x1=\"{0:.2f}\" x2=\"{0:.2f}\" y1=\"{1:.0f}\" y2=\"{2:.0f}\" stroke=\"black\"/>\n"
                "<text x=\"{0:.2f}\" y=\"{3:.0f}\" text-anchor=\"middle\">{4:.4g}</text>\n",
                x(tick * 1e-3), height - bottom, height - bottom + 5, height - bottom + 19,
                std::abs(tick) < 1e-9 * step ? 0.0 : tick);
        svg +=
            fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">depth behind the hologram, mm</text>\n",
                        (left + width - right) / 2, height - 10);
        const double gap = round_step(2 * (high_ - low_));
        for (double tick = std::ceil(low_ / gap) * gap; tick <= high_ + 1e-9; tick += gap)
            svg += fmt::format(
                "<line x1=\"{0:.0f}\" x2=\"{1:.0f}\" y1=\"{2:.2f}\" y2=\"{2:.2f}\" stroke=\"black\"/>\n"
                "<text x=\"{3:.0f}\" y=\"{4:.2f}\" text-anchor=\"end\">{5:.3g}</text>\n",
                left - 5, left, y(tick), left - 9, y(tick) + 4, std::pow(10, tick));
        return svg + fmt::format(
                         "<text transform=\"translate(18 {:.0f}) rotate(-90)\" text-anchor=\"middle\">contrast of "
                         "intensity</text>\n",
                         (top + height - bottom) / 2);
    }

    std::string curves() const {
        std::string svg;
        for (std::size_t s = 0; s < colours.size(); ++s) {
            svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", colours[s]);
            for (std::size_t i = 0; i < search_.depths.size(); ++i)
                svg += fmt::format("{:.2f},{:.2f} ", x(search_.depths[i]),
                                   y(std::log10(floor_of(search_.contrasts[i][s]))));
            const std::size_t cell = s == FocusSearch::edges ? 0 : FocusSearch::cells[s];
            svg += fmt::format("\"/>\n<text x=\"{:.0f}\" y=\"44\" fill=\"{}\">{}</text>\n",
                               left + 85 * static_cast<double>(s), colours[s],
                               cell == 0   ? std::string("edges")
                               : cell == 1 ? std::string("samples")
                                           : fmt::format("{0} x {0}", cell));
        }
        return svg;
    }

    const FocusSearch& search_;
    double low_ = 0, high_ = 0;
};

}  // namespace

void require_plot_name(const std::filesystem::path& path) {
    if (path.extension() == ".svg" || path.extension() == ".SVG") return;
    throw Error(ErrorCode::usage, fmt::format("'{}': expected a plot name that ends in .svg", path.string()));
}

void write_focus_plot(const std::filesystem::path& path, const FocusSearch& search, const std::string& title,
                      const Metadata& metadata) {
    write_text(path, Plot(search).drawn(title, metadata));
}

}  // namespace hogel::cli
