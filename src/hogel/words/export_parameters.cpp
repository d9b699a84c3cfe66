// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hogel/requests.h"
#include "hogel/table.h"

namespace hogel {
namespace {

// Returns the layout for the name of an output. Layouts of single files have extensions of their own.
std::string layout_for(const std::filesystem::path& output) {
    if (output.extension() == ".npy") return "npy";
    if (output.extension() == ".mat") return "mat";
    return output.has_extension() && output.stem().string().find("_qs") != std::string::npos ? "quilt" : "rows-columns";
}

}  // namespace

ViewExportOptions ExportParameters::options() const {
    constexpr std::size_t too_many_bits = 99;  // export_views() refuses them
    ViewExportOptions asked = views;
    asked.bits = static_cast<unsigned>(std::min(bits, too_many_bits));
    asked.transfer = transfer_named(transfer);
    return asked;
}

void ExportParameters::resolve(const std::filesystem::path& output) {
    is_film = hogel::is_film(output);
    if (is_film) {
        views.layout = "rows-columns";
        views.format = "png";
        bits = 8;
        transfer = "srgb";
        return;
    }
    if (!layout_given) views.layout = layout_for(output);
    if (view_layouts().find(views.layout).name == "quilt" && views.format.empty() && output.has_extension())
        views.format = output.extension().string().substr(1);
}

void ExportParameters::declare(Parameters& parameters) {
    const auto is_set = [this] { return !is_film; };
    parameters.group("Views");
    std::string layouts;
    for (const ViewLayout& layout : view_layouts().rows())
        if (layout.create != nullptr) layouts += fmt::format("\n{}: {}", layout.name, layout.text);
    parameters
        .text("--layout", views.layout, "NAME",
              "Layout of the stored views; an ending .npy, .mat or _qs8x6a0.75.png of the output selects its own" +
                  layouts)
        .sets(layout_given)
        .acts_if(is_set);
    parameters
        .choice("--pictures", views.format, {"png", "ppm", "pfm", "exr"}, "FORMAT",
                "Format: png, ppm (8 to 16 bits), pfm or exr (floating point; default: as imported, else png)")
        .no_default()
        .acts_if(is_set);
    parameters.count("--bits", bits, "Bits of whole numbers, 8 to 16; png: 8 or 16 (default: as imported, else 8)")
        .no_default()
        .acts_if(is_set);
    parameters
        .choice("--transfer", transfer, transfer_names(), "NAME",
                fmt::format("Transfer curve of the stored numbers: {} (default: as imported, else srgb, or linear for "
                            "floating point)",
                            fmt::join(transfer_names(), ", ")))
        .no_default()
        .acts_if(is_set);
    parameters.number("--exposure", views.exposure, "NUMBER", "Factor for linear values").positive();
    parameters.number("--frame-rate", frame_rate, "NUMBER", "Views per second of a film").positive().acts_if([this] {
        return is_film;
    });
}

}  // namespace hogel
