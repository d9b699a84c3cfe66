// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/codec/codec.h"
#include "bench/codec/panels.h"
#include "bench/codec/thesis_curves.h"
#include "hogel/error.h"
#include "hogel/image.h"

namespace hogel::bench {
namespace {

constexpr double table_rates[] = {1, 2, 4, 8, 16, 32, 64, 128};

// Returns the mean of the colours of a scene's light field, or its square root, called L in [K] 3.7.2.
LightFieldBuffer lumigraph_of(const Session& session, const std::string& scene, const ThesisOptions& options) {
    const auto source = open_or_render(session, scene, options.light_field);
    LightFieldBuffer field(source->grid());
    copy(*source, field, until_interrupted());
    LightFieldGrid grid = field.grid();
    const std::size_t channels = grid.channels;
    grid.channels = 1;
    LightFieldBuffer result(grid);
    const std::size_t count = result.radiance.size();
    for (std::size_t i = 0; i < count; ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < channels; ++c) sum += field.radiance.data()[c * count + i];
        const float mean = sum / static_cast<float>(channels);
        result.radiance.data()[i] = options.radiance ? mean : std::sqrt(mean);
    }
    return result;
}

const ThesisCurve* find(const std::vector<ThesisCurve>& curves, std::string_view transform) {
    const auto found = std::ranges::find(curves, transform, &ThesisCurve::transform);
    return found == curves.end() ? nullptr : &*found;
}

Curve drawn(const ThesisCurve& curve, const std::string& name) {
    Curve result{name, {}};
    for (const ThesisPoint& point : curve.points) result.points.emplace_back(point.pixels_per_bit, point.sqnr);
    return result;
}

const PanelAxes axes{"Compression (pixels per bit)", "SQNR (dB)", 1, 128, 20, 50, 5};

// Draws fig. 4.19 and 4.20: the families of fig. 4.5 to 4.9, each in a panel.
std::vector<Panel> families(const std::vector<ThesisCurve>& curves) {
    const std::pair<const char*, std::vector<const char*>> groups[] = {
        {"Daubechies", {"haar", "d4", "d6"}},
        {"Average-interpolating", {"ai13", "ai31", "ai33"}},
        {"Interpolating", {"i22", "i24", "i42", "i44"}},
        {"Cohen, Daubechies, Feauveau", {"cdf31", "cdf33", "cdf42", "cdf44"}},
        {"(9,7) and cosine transform", {"cdf97", "dct8-jpeg", "dct8-own"}},
        {"Beside the coder hogel", {"hogel", "ai33", "dct8-jpeg"}}};
    std::vector<Panel> panels;
    for (const auto& [title, names] : groups) {
        Panel& panel = panels.emplace_back(Panel{title, {}});
        for (const char* const name : names)
            if (const ThesisCurve* curve = find(curves, name)) panel.curves.push_back(drawn(*curve, curve->label));
    }
    return panels;
}

// Draws fig. 4.18: EZW and three passes.
std::vector<Panel> ezw_panels(const std::vector<ThesisCurve>& curves) {
    std::vector<Panel> panels;
    for (const auto& [name, title] : {std::pair{"haar", "(a) Haar"}, {"d6", "(b) D6"}}) {
        Panel& panel = panels.emplace_back(Panel{title, {}});
        if (const ThesisCurve* curve = find(curves, std::string("ezw-") + name))
            panel.curves.push_back(drawn(*curve, "EZW"));
        if (const ThesisCurve* curve = find(curves, name)) panel.curves.push_back(drawn(*curve, "3-pass"));
    }
    return panels;
}

double variance(std::span<const float> values) {
    double sum = 0, squares = 0;
    for (const float value : values) {
        sum += value;
        squares += static_cast<double>(value) * value;
    }
    const auto count = static_cast<double>(values.size());
    return squares / count - sum / count * (sum / count);
}

// Returns the hogel with the most contrast, for showing its slices.
std::size_t lively_hogel(const LightFieldBuffer& field) {
    const std::size_t size = field.grid().directions();
    std::size_t best = 0;
    double most = -1;
    for (std::size_t hogel = 0; hogel < field.grid().hogels(); ++hogel) {
        const double contrast = variance(field.radiance.elements().subspan(hogel * size, size));
        if (contrast > most) {
            most = contrast;
            best = hogel;
        }
    }
    return best;
}

// Square of directions of a hogel.
struct Window {
    std::size_t u0 = 0, v0 = 0, side;

    std::vector<float> of(std::span<const float> slice, const LightFieldGrid& grid) const {
        std::vector<float> values;
        for (std::size_t v = v0; v < v0 + side; ++v)
            for (std::size_t u = u0; u < u0 + side; ++u) values.push_back(slice[v * grid.directions_u + u]);
        return values;
    }
};

// Finds the part of a slice with the most contrast, in steps of a quarter of its side.
Window lively_window(std::span<const float> slice, const LightFieldGrid& grid, std::size_t side) {
    Window best{0, 0, side};
    double most = -1;
    const std::size_t step = std::max<std::size_t>(side / 4, 1);
    for (std::size_t v = 0; v + side <= grid.directions_v; v += step)
        for (std::size_t u = 0; u + side <= grid.directions_u; u += step) {
            const Window window{u, v, side};
            const double contrast = variance(window.of(slice, grid));
            if (contrast > most) {
                most = contrast;
                best = window;
            }
        }
    return best;
}

std::vector<float> display(std::vector<float> values, double white, bool radiance) {
    for (float& value : values) {
        const double part = std::max(value, 0.0f) / white;
        value = srgb_encode(static_cast<float>(radiance ? part : part * part));
    }
    return values;
}

// Writes the pictures of fig. 4.21 to 4.28 (all transforms at about 8 pixels per bit) or 4.29 ((3,3) at six rates).
void write_sheet(const std::filesystem::path& file, const std::string& title, const LightFieldBuffer& original,
                 const std::vector<std::pair<const ThesisCurve*, std::size_t>>& shown, const ThesisOptions& options) {
    const LightFieldGrid& grid = original.grid();
    const std::size_t side = std::min({options.crop, grid.directions_u, grid.directions_v});
    const auto slice =
        original.radiance.elements().subspan(lively_hogel(original) * grid.directions(), grid.directions());
    std::vector<float> sorted(slice.begin(), slice.end());
    std::ranges::sort(sorted);
    const double white = std::max(sorted[(sorted.size() - 1) * 995 / 1000], 1e-9f);
    const Window window = lively_window(slice, grid, side);
    const auto picture = [&](std::span<const float> values) {
        return display(window.of(values, grid), white, options.radiance);
    };
    std::vector<SheetPicture> pictures{{"original", "", picture(slice)}};
    for (const auto& [curve, at] : shown) {
        if (curve->points.empty()) continue;
        pictures.push_back(
            {curve->label,
             fmt::format("{:.1f} ppb, {:.1f} dB", curve->points[at].pixels_per_bit, curve->points[at].sqnr),
             picture(curve->slices[at])});
    }
    write_text(file, sheet_svg(title, side, side, options.columns, pictures));
}

void print_table(const std::string& scene, const std::vector<ThesisCurve>& curves) {
    for (const ThesisCurve& curve : curves) {
        std::string line = fmt::format("{} {} {}", scene, curve.coder, curve.transform);
        for (const double rate : table_rates) line += fmt::format(" {:.2f}", curve.at(rate));
        fmt::print("{}\n", line);
    }
}

// Prints the c that meets each rate, and the overhead of the alphabets.
void print_overheads(const std::string& scene, const std::vector<ThesisCurve>& curves) {
    for (const ThesisCurve& curve : curves) {
        if (curve.coder != "threepass") continue;
        std::string line = fmt::format("# c {} {}", scene, curve.transform), alphabets;
        for (const ThesisPoint& point : curve.points) {
            line += fmt::format(" {:.2f}@{:.2f}", *point.overhead, point.pixels_per_bit);
            if (point.alphabets)
                alphabets += fmt::format(" {:.3f} ({:.2f})", *point.alphabets, *point.alphabet_overhead);
        }
        fmt::print("{}\n", line);
        if (!alphabets.empty()) fmt::print("# alphabets {} {}{}\n", scene, curve.transform, alphabets);
    }
}

void write_figures(const std::string& scene, const LightFieldBuffer& field, const std::vector<ThesisCurve>& curves,
                   const ThesisOptions& options) {
    const std::filesystem::path folder(options.output);
    const LightFieldGrid& grid = field.grid();
    const std::string size = fmt::format("{}, {} of {} hogels across the hologram, {} x {} directions, {}", scene,
                                         grid.hogels_s, options.light_field.across, grid.directions_u,
                                         grid.directions_v, options.radiance ? "radiance" : "square root of radiance");
    write_text(folder / fmt::format("thesis_ezw_{}.svg", scene),
               panels_svg("EZW and three passes", size, axes, ezw_panels(curves)));
    write_text(folder / fmt::format("thesis_rates_{}.svg", scene),
               panels_svg("Quality against compression", size, axes, families(curves)));
    std::vector<std::pair<const ThesisCurve*, std::size_t>> all, rates;
    for (const ThesisCurve& curve : curves)
        if (curve.coder != "ezw") all.emplace_back(&curve, curve.nearest(8));
    if (const ThesisCurve* curve = find(curves, "ai33"))
        for (const double rate : {0.8, 2.5, 5.5, 16.0, 50.0, 147.0}) rates.emplace_back(curve, curve->nearest(rate));
    write_sheet(folder / fmt::format("thesis_transforms_{}.svg", scene),
                "All transforms at about 8 pixels per bit: " + scene, field, all, options);
    write_sheet(folder / fmt::format("thesis_degrees_{}.svg", scene),
                "(3,3) average-interpolating at six rates: " + scene, field, rates, options);
}

}  // namespace

void redraw_thesis(const ThesisOptions& options, const Session& session) {
    if (!options.output.empty()) create_folder(options.output);
    fmt::print("# SQNR in dB at pixels per bit\n# scene coder transform 1 2 4 8 16 32 64 128\n");
    for (const std::string& scene : options.scenes) {
        session.detail(scene);
        const LightFieldBuffer field = lumigraph_of(session, scene, options);
        const std::vector<ThesisCurve> curves =
            thesis_curves(field, {options.rates, options.transforms, lively_hogel(field)});
        print_table(scene, curves);
        print_overheads(scene, curves);
        std::fflush(stdout);
        if (!options.output.empty())
            write_figures(std::filesystem::path(scene).stem().string(), field, curves, options);
    }
}

}  // namespace hogel::bench
