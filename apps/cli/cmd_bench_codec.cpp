// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "bench_codec.h"
#include "bench_field.h"
#include "commands.h"
#include "hogel/compress.h"
#include "hogel/core/output_file.h"
#include "inputs.h"
#include "outputs.h"
#include "plot.h"

namespace hogel::cli {
namespace {

constexpr std::array<std::pair<std::string_view, Brightness>, 2> dense_fields{
    {{"dense", Brightness::even}, {"dense-hdr", Brightness::high}}};

struct Options {
    std::string input, output;
    RenderOptions render;
    std::vector<std::string> coders, transforms, peers;
    std::vector<double> sqnrs{25, 30, 35, 40}, rates{8};
    bool grey = false, thesis = false;
};

// The whole light field in memory; its colours' mean where that is asked for.
LightFieldBuffer load(const LightFieldSource& source, bool grey, const Progress& progress) {
    LightFieldBuffer field(source.grid());
    copy(source, field, progress);
    if (!grey || field.grid().channels == 1) return field;
    LightFieldGrid grid = field.grid();
    grid.channels = 1;
    LightFieldBuffer mean(grid);
    const std::size_t count = mean.radiance.size();
    const float* in = field.radiance.data();
    for (std::size_t i = 0; i < count; ++i) mean.radiance.data()[i] = (in[i] + in[count + i] + in[2 * count + i]) / 3;
    return mean;
}

// A light field that is made for this, or any other.
std::unique_ptr<LightFieldSource> open(const Session& session, const Options& options) {
    for (const auto& [name, brightness] : dense_fields)
        if (options.input == name) return make_dense_field(options.render.grid(), brightness);
    return open_or_render(session, options.input, options.render);
}

// Each coder with the transforms that go with it.
std::vector<CodingMethod> methods_of(const Options& options) {
    const auto wanted = [](const std::vector<std::string>& names, std::string_view name) {
        return names.empty() || std::ranges::count(names, name) > 0;
    };
    std::vector<CodingMethod> methods;
    for (const CoderInfo& coder : coders().rows()) {
        if (!wanted(options.coders, coder.name)) continue;
        if (coder.transform.empty()) methods.push_back({coder.name, ""});
        for (const std::string& transform : transform_names())
            if (!coder.transform.empty() && (coder.name == "jpeg4d") == (transform == "dct8") &&
                wanted(options.transforms, transform)) {
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

int bench(const Options& options, const Session& session) {
    const auto source = open(session, options);
    for (const std::string& name : options.coders) coders().find(name);
    std::optional<Stage> reading(std::in_place, session, "reading");
    const LightFieldBuffer field = load(*source, options.grey, reading->progress());
    reading.reset();
    const LightFieldGrid& grid = field.grid();
    if (!options.peers.empty() && grid.channels != 1)
        throw Error(ErrorCode::usage, "peers are compared on one channel; expected --grey");
    std::optional<OutputFolder> folder;
    if (!options.output.empty()) folder.emplace(options.output);
    std::vector<double> sqnrs = options.sqnrs;
    std::ranges::sort(sqnrs);
    const QualityRange range{sqnrs.front(), sqnrs.back()};
    std::vector<RateCurve> curves;
    const Progress go_on = [](double) { return interrupted_by() == 0; };
    for (const CodingMethod& method : methods_of(options)) {
        session.detail(fmt::format("{} {}", method.coder, method.transform));
        curves.push_back(measure_method(field, method, range, go_on));
    }
    for (const std::string& name : options.peers) {
        session.detail(name);
        if (auto curve = measure_peer(field, name, range, go_on))
            curves.push_back(std::move(*curve));
        else
            session.say(fmt::format("{}: left out, it is not installed", name));
    }
    const std::string name = std::filesystem::path(options.input).stem().string();
    const std::string subtitle =
        fmt::format("{}x{} hogels, {}x{} directions, {}", grid.hogels_s, grid.hogels_t, grid.directions_u,
                    grid.directions_v, grid.channels == 1 ? "grey" : "colour");
    fmt::print(
        "{}; {}.\nPixels per bit at SQNRs, SQNRs at pixels per bit; million samples a second of one core, at {:g} "
        "dB.\n\n{}",
        name, subtitle, sqnrs[(sqnrs.size() - 1) / 2], table(curves, sqnrs, options.rates));
    if (folder) {
        std::vector<Curve> drawn;
        for (const RateCurve& curve : curves) {
            Curve& line = drawn.emplace_back(Curve{curve.name, {}});
            for (const RatePoint& point : curve.points) line.points.emplace_back(point.pixels_per_bit, point.sqnr);
        }
        // [K] 4.5.3 tells of one point: about 8 pixels a bit at roughly 30 dB for the better transforms.
        if (options.thesis) drawn.push_back({"[K]", {{8, 30}}});
        const std::string svg =
            plot_svg({name, subtitle, "Pixels per bit", "SQNR (dB)", PlotText::Scale::linear}, drawn);
        core::write_file(folder->path() / fmt::format("codec_{}.svg", name),
                         {reinterpret_cast<const unsigned char*>(svg.data()), svg.size()});
    }
    return 0;
}

}  // namespace

void add_bench_codec(CLI::App& app, Session& session) {
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(app, session, "codec", "Measure coders: quality against size, and speed",
                                    "  hogel bench codec pumpkin --hogels 16x16 --directions 128 -o plots\n"
                                    "  hogel bench codec a.h5 --coders hogel --grey --peers x265,svt-av1",
                                    [options, &session] { return bench(*options, session); });
    command
        ->add_option("input", options->input,
                     "Light field or scene; dense, dense-hdr: ellipses made for this, hardly moving between hogels")
        ->type_name("X.h5|X.hgl|SCENE|dense|dense-hdr")
        ->required();
    command->add_option("-o,--output", options->output, "Folder for a plot, SVG")->type_name("DIR");
    command
        ->add_option("--coders", options->coders,
                     fmt::format("{}; all if none are named", fmt::join(coders().names(), ", ")))
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_option("--transforms", options->transforms, "Transforms; all if none are named")
        ->type_name("NAME,...")
        ->delimiter(',')
        ->check(CLI::IsMember(transform_names()).description(""));
    command->add_option("--sqnr", options->sqnrs, "SQNRs to tell the rate at")
        ->type_name("DB,...")
        ->delimiter(',')
        ->check(CLI::Range(1.0, 120.0).description(""))
        ->capture_default_str();
    command->add_option("--ppb", options->rates, "Pixels per bit to tell the SQNR at")
        ->type_name("N,...")
        ->delimiter(',')
        ->check(CLI::PositiveNumber.description(""))
        ->capture_default_str();
    command->add_flag("--thesis", options->thesis,
                      "Draw the point that Kartch's thesis tells of, 30 dB at 8 pixels a bit");
    command->add_flag("--grey", options->grey, "Measure the mean of the colours");
    command
        ->add_option("--peers", options->peers,
                     fmt::format("Others, where they are installed: {}", fmt::join(peer_names(), ", ")))
        ->type_name("NAME,...")
        ->delimiter(',')
        ->check(CLI::IsMember(peer_names()).description(""));
    add_render_options(command, options->render);
}

}  // namespace hogel::cli
