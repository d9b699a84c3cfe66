// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "commands.h"
#include "focus_plot.h"
#include "hogel/focus.h"
#include "hogel/pipeline.h"
#include "hogel/units.h"
#include "inputs.h"
#include "run_record.h"

namespace hogel::cli {
namespace {

struct Options {
    std::string input, plot;
    FieldParameters field;
    double from = 0, to = 0;
    std::size_t planes = 0, colour = 0;
    Counts region{0, 0};
};

FocusOptions focus_options(const Options& options, const Command& command) {
    FocusOptions focus;
    if (command.given("--from") != command.given("--to"))
        throw Error(ErrorCode::usage, "--from, --to: give both or neither");
    if (command.given("--from") && options.from == options.to)
        throw Error(ErrorCode::usage, "--from, --to: expected two different depths");
    focus.from = options.from;
    focus.to = options.to;
    focus.planes = options.planes;
    if (command.given("--region")) {
        focus.width = options.region.columns;
        focus.height = options.region.rows;
    }
    return focus;
}

std::string text_of(const FocusSearch& search) {
    if (search.planes.empty()) return "no depth stands out\n";
    std::string words = fmt::format("{:>14}  {:>10}  {}\n", "depth", "prominence", "shown by");
    for (const FocusPlane& plane : search.planes)
        words += fmt::format("{:>14}  {:>10.3f}  the {} contrast of {}\n", format_length(plane.depth), plane.prominence,
                             plane.brightest ? "highest" : "lowest",
                             plane.cell == 0   ? "edges"
                             : plane.cell == 1 ? "samples"
                                               : fmt::format("{0}x{0} samples", plane.cell));
    return words;
}

// Warns if no plane is prominent: the result may be noise.
void warn_about_noise(const FocusSearch& search, const Session& session) {
    constexpr double doubtful = 0.3;
    if (!search.planes.empty() && search.planes.front().prominence >= doubtful) return;
    session.say(
        fmt::format("no plane is clearly in focus from {} to {} behind the hologram{}; try another range (--from, "
                    "--to), --region or --colour",
                    format_length(search.depths.front()), format_length(search.depths.back()),
                    search.planes.empty() ? "" : ": the planes may be noise"));
}

// Prints the searched region and wavelengths, unless the input is one field and all of it is searched.
void report_selection(const Fields& all, const Fields& fields, const FocusOptions& request, const Session& session) {
    const Grid& plane = fields.front()->grid().plane;
    const Region region = focus_region(fields.front()->grid(), request);
    const bool whole = region.width == plane.width && region.height == plane.height;
    if (whole && all.size() == 1) return;
    std::string colours;
    for (const auto& field : fields)
        colours += fmt::format("{}{}", colours.empty() ? "" : ", ", format_length(field->grid().wavelength));
    session.say(fmt::format("searching {} of {}x{} samples{} at {}",
                            whole ? "all" : fmt::format("the middle {}x{}", region.width, region.height), plane.width,
                            plane.height, whole ? "" : " (--region)", colours));
}

Result result_of(const FocusSearch& search, const Fields& fields, double seconds) {
    ResultList planes, depths, contrasts;
    for (const FocusPlane& plane : search.planes)
        planes.emplace_back(Result{{"depth_m", plane.depth},
                                   {"prominence", plane.prominence},
                                   {"contrast", plane.brightest ? "highest" : "lowest"},
                                   {"cell", plane.cell}});
    for (std::size_t i = 0; i < search.depths.size(); ++i) {
        depths.emplace_back(search.depths[i]);
        ResultList row;
        for (const double contrast : search.contrasts[i]) row.emplace_back(contrast);
        contrasts.emplace_back(row);
    }
    ResultList wavelengths;
    for (const auto& field : fields) wavelengths.emplace_back(field->grid().wavelength);
    return {{"wavelengths_m", wavelengths},
            {"depth_of_focus_m", search.depth_of_focus},
            {"light_depth_of_focus_m", search.light_depth_of_focus},
            {"planes", planes},
            {"depths_m", depths},
            {"contrasts", contrasts},
            {"seconds", seconds}};
}

int focus(Options& options, const Session& session) {
    const FocusOptions request = focus_options(options, *session.command);
    if (!options.plot.empty()) {
        require_plot_name(options.plot);
        require_writable(options.plot, {&options.input, 1});
    }
    const Fields fields = open_and_reconstruct(session, options.input, options.field);
    Fields chosen = fields;
    if (session.command->given("--colour")) {
        if (options.colour > fields.size())
            throw Error(ErrorCode::usage, "colour",
                        fmt::format("{} does not exist: {} contains {}", options.colour, options.input, fields.size()));
        chosen = {fields[options.colour - 1]};
    }
    report_selection(fields, chosen, request, session);
    Stage stage(session, "looking for planes in focus");
    const FocusSearch search = find_focus(chosen, request, stage.progress());
    session.detail(fmt::format("{} depths from {} to {}, depth of focus {} of the samples, {} of the light",
                               search.depths.size(), format_length(search.depths.front()),
                               format_length(search.depths.back()), format_length(search.depth_of_focus),
                               format_length(search.light_depth_of_focus)));
    if (!options.plot.empty())
        write_focus_plot(options.plot, search, std::filesystem::path(options.input).filename().string(),
                         run_metadata(session));
    warn_about_noise(search, session);
    session.result(result_of(search, chosen, session.seconds()), text_of(search));
    return 0;
}

}  // namespace

void add_focus(Command& command, Session& session) {
    auto options = std::make_shared<Options>();
    command.examples(
        "  hogel focus hologram.h5 --from -20mm --to 20mm\n"
        "  hogel focus phase.png -o sharpness.svg --phase-code odak --pitch 8um --wavelength 515nm");
    command.basics(
        {"from", "to", "planes", "region", "pitch", "wavelength", "values", "phase-code", "order", "reconstruct"});
    command.positional("input", options->input, "F.h5|F.npy|P.png", "Hologram, or another program's field");
    command.text("-o,--output", options->plot, "PLOT.svg", "Plot of the contrasts against depth").never_acts();
    command.length("--from", options->from, "First depth of the search, behind the hologram; negative: in front of it")
        .default_text("-N pitch^2/wavelength for N samples");
    command.length("--to", options->to, "Last depth of the search").default_text("N pitch^2/wavelength");
    command.count("--planes", options->planes, "Number of depths").default_text("one every depth of focus");
    command.counts("--region", options->region, "Number of samples in the middle to search")
        .default_text("1024x1024, or all");
    command.count("--colour", options->colour, "Index of one of several fields, from 1").default_text("all together");
    options->field.declare(command);
    options->field.declare_reconstruction(command);
    command.work([options, &session] { return focus(*options, session); });
}

}  // namespace hogel::cli
