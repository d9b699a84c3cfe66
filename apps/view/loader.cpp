// SPDX-License-Identifier: Apache-2.0
#include "view/loader.h"

#include <fmt/format.h>

#include <utility>

#include "cli/concerns.h"
#include "hogel/error.h"
#include "view/hologram_subject.h"
#include "view/light_field_subject.h"

namespace hogel::view {

using cli::Session;
using cli::ViewOptions;

Loader::Loader(const Session& session, const ViewOptions& options, std::string input, Viewer& viewer)
    : session_(session),
      options_(options),
      input_(std::move(input)),
      memory_(static_cast<std::size_t>(options.memory * 1e9)),
      viewer_(viewer),
      record_(session) {}

void Loader::open() {
    if (cli::is_external(input_, options_.field) || input_kind(input_) == InputKind::hologram)
        fields_ = cli::open_and_reconstruct(session_, input_, options_.field, options_.hologram.pitch,
                                            options_.hologram.wavelengths, record_);
    else if (input_kind(input_) == InputKind::light_field)
        file_ = open_light_field_or_views(input_);
}

void Loader::load(const std::function<void()>& failed) {
    thread_ = std::jthread([this, failed] {
        try {
            if (file_)
                show_file(*file_);
            else if (!fields_.empty())
                viewer_.show(std::make_shared<HologramSubject>(fields_, memory_, progress("reading")));
            else
                show_scene();
            viewer_.say("", 1);
        } catch (...) {
            error_ = std::current_exception();
            failed();
        }
    });
}

void Loader::finish() {
    if (thread_.joinable()) thread_.join();
    if (error_) std::rethrow_exception(error_);
}

Progress Loader::progress(const char* what) {
    return Progress(session_.stop.get_token(), [this, what](double fraction) {
        viewer_.say(what, fraction);
        return true;
    });
}

// The holograms that `hogel photo --wave` makes, of the light field in memory where it is rendered.
std::unique_ptr<Waves> Loader::waves_of(const LightField& light_field, bool rendered) {
    const auto make = [this, light_field, rendered] {
        const HologramRequest request = options_.hologram.request(session_, options_.looks);
        LightField common = with_common_directions(light_field);
        cli::check_holograms(common.grids(), request, rendered);
        if (rendered)
            common = hogel::prepare_for_reading(common, request.channels.size(), needs_depth(request.method),
                                                progress("rendering for waves"));
        return make_holograms(common, request);
    };
    const auto making = Progress(session_.stop.get_token(), [this](double fraction) {
        viewer_.say(fraction < 1 ? "preparing waves" : "", fraction);
        return true;
    });
    return std::make_unique<Waves>(make, options_.looks, memory_ / 2, making);
}

void Loader::show(const LightField& whole, const LightField& shown, const char* what, std::unique_ptr<Waves> waves) {
    viewer_.show(std::make_shared<LightFieldSubject>(whole, shown, memory_, progress(what), std::move(waves)));
}

void Loader::show_file(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t finest = step_that_fits(grid, memory_), first = step_of_first_look(grid);
    if (finest > 1)
        session_.say(fmt::format("{}: every {} of {}x{} hogels, which fit into --memory {:g}", input_,
                                 finest == 3 ? "3rd" : fmt::format("{}th", finest), grid.hogels_s, grid.hogels_t,
                                 options_.memory));
    if (first > finest) show(light_field, every_nth_hogel(light_field, first), "opening");
    show(light_field, every_nth_hogel(light_field, finest), "reading", waves_of(light_field, false));
}

void Loader::show_scene() {
    viewer_.say("lighting", 0);
    const Scene scene = cli::load_scene(session_, input_, options_.render, record_);
    const auto lit = cli::light_scene(session_, scene, options_.render, record_);
    LightFieldRequest request = options_.render.request();
    const std::size_t finest = step_that_fits(request.grid, memory_), first = step_of_first_look(request.grid);
    if (finest > 1)
        throw Error(ErrorCode::usage, fmt::format("--memory {:g}: the light field has {:.3g} samples of 2 bytes; "
                                                  "fewer --hogels or --directions would do",
                                                  options_.memory, request.grid.samples()));
    const LightField whole = cli::render_light_field(session_, scene, options_.render, record_);
    // The faces of a hemicube are read by each picture, which must not render them anew.
    if (whole.has_sides()) {
        const LightField kept = hogel::prepare_for_reading(whole, 2, false, progress("rendering"));
        return show(kept, kept, "rendering", waves_of(kept, false));
    }
    if (first > 1) show(whole, with_fewer_hogels(lit, request, first), "rendering");
    show(whole, whole, "rendering", waves_of(whole, true));
}

// The same hologram with hogels `step` times as wide.
LightField Loader::with_fewer_hogels(const std::shared_ptr<const ShadedScene>& lit, LightFieldRequest request,
                                     std::size_t step) {
    LightFieldGrid& grid = request.grid;
    const double width = grid.width();
    grid.hogels_t = std::max<std::size_t>(1, grid.hogels_t / step);
    grid.hogels_s = std::max<std::size_t>(1, grid.hogels_s / step);
    grid.pitch = width / static_cast<double>(grid.hogels_s);
    return hogel::render_light_field(lit, request);
}

}  // namespace hogel::view
