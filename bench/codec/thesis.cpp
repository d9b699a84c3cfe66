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

// The mean of the colours of a scene's light field, or its square root, which is what [K] 3.7.2 calls L.
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

const ThesisCurve& find(const std::vector<ThesisCurve>& curves, std::string_view coder, std::string_view transform) {
    return *std::ranges::find_if(curves,
                                 [&](const ThesisCurve& c) { return c.coder == coder && c.transform == transform; });
}

Curve drawn(const ThesisCurve& curve, const std::string& name) {
    Curve result{name, {}};
    for (const ThesisPoint& point : curve.points) result.points.emplace_back(point.pixels_per_bit, point.sqnr);
    return result;
}

const PanelAxes axes{"Compression (pixels per bit)", "SQNR (dB)", 1, 128, 20, 50, 5};

// Fig. 4.19 and 4.20: the families of fig. 4.5 to 4.9, each in a panel.
std::vector<Panel> families(const std::vector<ThesisCurve>& curves) {
    const std::pair<const char*, std::vector<const char*>> groups[] = {
        {"Daubechies", {"haar", "d4", "d6"}},
        {"Average-interpolating", {"ai13", "ai31", "ai33"}},
        {"Interpolating", {"i22", "i24", "i42", "i44"}},
        {"Cohen, Daubechies, Feauveau", {"cdf31", "cdf33", "cdf42", "cdf44"}},
        {"(9,7) and cosine transform", {"cdf97", "dct8-jpeg", "dct8-own"}}};
    std::vector<Panel> panels;
    for (const auto& [title, names] : groups) {
        Panel& panel = panels.emplace_back(Panel{title, {}});
        for (const char* const name : names) {
            const ThesisCurve& curve = *std::ranges::find_if(
                curves, [&](const ThesisCurve& c) { return c.transform == name && c.coder != "ezw"; });
            panel.curves.push_back(drawn(curve, curve.label));
        }
    }
    Panel& ours = panels.emplace_back(Panel{"Beside the coder hogel", {}});
    for (const auto& [coder, name] : {std::pair{"hogel", "-"}, {"threepass", "ai33"}, {"jpeg4d", "dct8-jpeg"}})
        ours.curves.push_back(drawn(find(curves, coder, name), find(curves, coder, name).label));
    return panels;
}

// Fig. 4.18: EZW and three passes.
std::vector<Panel> ezw_panels(const std::vector<ThesisCurve>& curves) {
    std::vector<Panel> panels;
    for (const auto& [name, title] : {std::pair{"haar", "(a) Haar"}, {"d6", "(b) D6"}})
        panels.push_back(
            {title, {drawn(find(curves, "ezw", name), "EZW"), drawn(find(curves, "threepass", name), "3-pass")}});
    return panels;
}

// The middle of a slice as display values.
std::vector<float> display(const std::vector<float>& slice, const LightFieldGrid& grid, std::size_t side, double white,
                           bool radiance) {
    std::vector<float> values;
    const std::size_t v0 = (grid.directions_v - side) / 2, u0 = (grid.directions_u - side) / 2;
    for (std::size_t v = v0; v < v0 + side; ++v)
        for (std::size_t u = u0; u < u0 + side; ++u) {
            const double value = std::max(slice[v * grid.directions_u + u], 0.0f) / white;
            values.push_back(srgb_encode(static_cast<float>(radiance ? value : value * value)));
        }
    return values;
}

// Writes the pictures of fig. 4.21 to 4.28 (all transforms at about 8 pixels per bit) or 4.29 ((3,3) at six rates).
void write_sheet(const std::filesystem::path& file, const std::string& title, const LightFieldBuffer& original,
                 const std::vector<std::pair<const ThesisCurve*, double>>& shown, const ThesisOptions& options) {
    const LightFieldGrid& grid = original.grid();
    const std::size_t side = std::min({options.crop, grid.directions_u, grid.directions_v});
    const auto middle = original.radiance.elements().subspan(grid.hogels() / 2 * grid.directions(), grid.directions());
    std::vector<float> sorted(middle.begin(), middle.end());
    std::ranges::sort(sorted);
    const double white = std::max(sorted[(sorted.size() - 1) * 995 / 1000], 1e-9f);
    const auto picture = [&](const std::vector<float>& slice) {
        return display(slice, grid, side, white, options.radiance);
    };
    std::vector<SheetPicture> pictures{{"original", "", picture({middle.begin(), middle.end()})}};
    for (const auto& [curve, rate] : shown) {
        if (curve->points.empty()) continue;
        const std::size_t at = curve->nearest(rate);
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

// The c that meets each rate, and what the alphabets take more.
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
    std::vector<std::pair<const ThesisCurve*, double>> all, rates;
    for (const ThesisCurve& curve : curves)
        if (curve.coder != "ezw") all.emplace_back(&curve, 8);
    for (const double rate : {0.8, 2.5, 5.5, 16.0, 50.0, 147.0})
        rates.emplace_back(&find(curves, "threepass", "ai33"), rate);
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
        const std::vector<ThesisCurve> curves = thesis_curves(field);
        print_table(scene, curves);
        print_overheads(scene, curves);
        std::fflush(stdout);
        if (!options.output.empty())
            write_figures(std::filesystem::path(scene).stem().string(), field, curves, options);
    }
}

}  // namespace hogel::bench
