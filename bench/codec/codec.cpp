// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "bench/codec/codec.h"
#include "bench/codec/dense_field.h"
#include "bench/codec/rate_curve.h"
#include "bench/peers/coders.h"
#include "bench/plot.h"
#include "hogel/compress.h"
#include "hogel/error.h"

namespace hogel::bench {
namespace {

constexpr std::array<std::pair<std::string_view, Brightness>, 2> dense_fields{
    {{"dense", Brightness::even}, {"dense-hdr", Brightness::high}}};

// Reads the whole light field into memory; with `grey`, the mean of its colours.
LightFieldBuffer load(const LightFieldSource& source, bool grey) {
    LightFieldBuffer field(source.grid());
    copy(source, field, until_interrupted());
    if (!grey || field.grid().channels == 1) return field;
    LightFieldGrid grid = field.grid();
    grid.channels = 1;
    LightFieldBuffer mean(grid);
    const std::size_t count = mean.radiance.size();
    const float* in = field.radiance.data();
    for (std::size_t i = 0; i < count; ++i) mean.radiance.data()[i] = (in[i] + in[count + i] + in[2 * count + i]) / 3;
    return mean;
}

// Opens the input: a dense light field, a file or a scene.
std::shared_ptr<const LightFieldSource> open(const Session& session, const CodecOptions& options) {
    for (const auto& [name, brightness] : dense_fields)
        if (options.input == name) return make_dense_field(options.light_field.grid(), brightness);
    return open_or_render(session, options.input, options.light_field);
}

std::vector<CodingMethod> methods_of(const CodecOptions& options) {
    const auto is_requested = [](const std::vector<std::string>& names, std::string_view name) {
        return names.empty() || std::ranges::count(names, name) > 0;
    };
    std::vector<CodingMethod> methods;
    for (const CoderInfo& coder : coders().rows()) {
        if (!is_requested(options.coders, coder.name)) continue;
        if (coder.transform.empty()) methods.push_back({coder.name, ""});
        for (const std::string& transform : transform_names())
            if (!coder.transform.empty() && (coder.name == "jpeg4d") == (transform == "dct8") &&
                is_requested(options.transforms, transform)) {
                methods.push_back({coder.name, transform});
                if (coder.quantisation_table) methods.push_back({coder.name, transform, QuantisationTable::jpeg});
            }
    }
    return methods;
}

std::string table(const std::vector<RateCurve>& curves, const std::vector<double>& sqnrs,
                  const std::vector<double>& rates) {
    std::string text = "| |";
    for (const double sqnr : sqnrs) text += fmt::format(" {:g} dB |", sqnr);
    for (const double rate : rates) text += fmt::format(" at {:g} |", rate);
    text += " encode | decode |\n|---|";
    for (std::size_t i = 0; i < sqnrs.size() + rates.size() + 2; ++i) text += "---|";
    text += "\n";
    const double middle = sqnrs[(sqnrs.size() - 1) / 2];
    for (const RateCurve& curve : curves) {
        text += fmt::format("| {} |", curve.name);
        for (const double sqnr : sqnrs) {
            const auto point = curve.at(sqnr);
            text += point ? fmt::format(" {:.2f} |", point->pixels_per_bit) : " – |";
        }
        for (const double rate : rates) {
            const auto point = curve.at_rate(rate);
            text += point ? fmt::format(" {:.1f} dB |", point->sqnr) : " – |";
        }
        const auto point = curve.at(middle);
        text += point ? fmt::format(" {:.2g} | {:.2g} |\n", point->encoding, point->decoding) : " – | – |\n";
    }
    return text;
}

std::vector<RateCurve> measure(const LightFieldBuffer& field, const CodecOptions& options, const QualityRange& range,
                               const Session& session) {
    std::vector<RateCurve> curves;
    for (const CodingMethod& method : methods_of(options)) {
        session.detail(fmt::format("{} {}", method.coder, method.transform));
        curves.push_back(measure_method(field, method, range));
    }
    for (const std::string& name : options.peers) {
        session.detail(name);
        if (auto curve = measure_coder_peer(field, name, range))
            curves.push_back(std::move(*curve));
        else
            session.say(fmt::format("{}: left out, it is not installed", name));
    }
    return curves;
}

std::string plot(const std::string& name, const std::string& subtitle, const std::vector<RateCurve>& curves,
                 bool thesis) {
    std::vector<Curve> drawn;
    for (const RateCurve& curve : curves) {
        Curve& line = drawn.emplace_back(Curve{curve.name, {}});
        for (const RatePoint& point : curve.points) line.points.emplace_back(point.pixels_per_bit, point.sqnr);
    }
    // [K] 4.5.3 gives one point: about 8 pixels per bit at roughly 30 dB for the better transforms.
    if (thesis) drawn.push_back({"[K]", {{8, 30}}});
    return plot_svg({name, subtitle, "Pixels per bit", "SQNR (dB)", PlotText::Scale::linear}, drawn);
}

}  // namespace

void measure_codec(const CodecOptions& options, const Session& session) {
    const auto source = open(session, options);
    // Fails for unknown coders before the first measurement.
    for (const std::string& name : options.coders) coders().find(name);
    if (!options.peers.empty() && source->grid().channels != 1 && !options.grey)
        throw Error(ErrorCode::usage, "peers are compared on one channel; expected --grey");
    if (!options.output.empty()) create_folder(options.output);
    const LightFieldBuffer field = load(*source, options.grey);
    std::vector<double> sqnrs = options.sqnrs;
    std::ranges::sort(sqnrs);
    const std::vector<RateCurve> curves = measure(field, options, {sqnrs.front(), sqnrs.back()}, session);
    const LightFieldGrid& grid = field.grid();
    const std::string name = std::filesystem::path(options.input).stem().string();
    const std::string subtitle =
        fmt::format("{}x{} hogels, {}x{} directions, {}", grid.hogels_s, grid.hogels_t, grid.directions_u,
                    grid.directions_v, grid.channels == 1 ? "grey" : "colour");
    fmt::print(
        "{}; {}.\nPixels per bit at SQNRs, SQNRs at pixels per bit; million samples a second of one core, at {:g} "
        "dB.\n\n{}",
        name, subtitle, sqnrs[(sqnrs.size() - 1) / 2], table(curves, sqnrs, options.rates));
    if (!options.output.empty())
        write_text(std::filesystem::path(options.output) / fmt::format("codec_{}.svg", name),
                   plot(name, subtitle, curves, options.thesis));
}

}  // namespace hogel::bench
