// SPDX-License-Identifier: Apache-2.0
// Compressed light fields: some or all of their layers, compared with the original.
#include <fmt/format.h>

#include <utility>

#include "hogel/compress.h"
#include "hogel/error.h"
#include "view/loader.h"

namespace hogel::view {
namespace {

constexpr double max_compared_samples = 4e8;  // a few seconds of decoding; larger ones are compared at every n-th hogel

LightField open_original(const std::string& name, const LightFieldGrid& grid) {
    LightField original = open_light_field_or_views(name);
    if (!same_hogels(original.grid(), grid) || original.grid().directions() != grid.directions())
        throw Error(ErrorCode::usage, "original",
                    fmt::format("{} has {}x{} hogels of {}x{} directions; expected {}x{} of {}x{}", name,
                                original.grid().hogels_s, original.grid().hogels_t, original.grid().directions_u,
                                original.grid().directions_v, grid.hogels_s, grid.hogels_t, grid.directions_u,
                                grid.directions_v));
    return original;
}

}  // namespace

bool Loader::is_compressed() const {
    return !is_view_set(current_->settings.input()) && is_stream(current_->settings.input());
}

void Loader::show_stream() {
    const std::string& input = current_->settings.input();
    const ViewerParameters& options = current_->settings.options();
    const StreamInfo info = read_stream_info(input);
    const std::size_t layers = options.layers > 0 ? options.layers : info.layers_there;
    const LightField light_field = open_stream(input, {.layers = layers});
    const LightField original =
        options.original.empty() ? *current_->file : open_original(options.original, light_field.grid());
    current_->stream = StreamFacts{
        layers, info.layers_there, static_cast<double>(info.layer_ends[layers - 1]), options.original, {}, {}};
    describe();
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t finest_step = step_that_fits(grid, memory()), first = step_of_first_look(grid);
    if (first > finest_step && current_->exposure == 0)
        show(light_field, every_nth_hogel(light_field, first), "decoding");
    auto viewable = std::make_shared<LightFieldViewable>(light_field, every_nth_hogel(light_field, finest_step),
                                                         memory(), progress("decoding"), waves_of(light_field, false));
    viewable->set_original(original);
    // All numbers of layers are shown with one exposure, to be comparable.
    if (current_->exposure > 0) viewable->set_exposure(current_->exposure);
    current_->exposure = viewable->exposure();
    viewer_.show(viewable);
    measure_stream(light_field, original, *viewable);
}

// Measures after the first picture, because it takes longer: bytes per hogel, and errors.
void Loader::measure_stream(const LightField& layers, const LightField& original, LightFieldViewable& viewable) {
    viewable.set_bytes_of_hogels(
        bytes_of_hogels(current_->settings.input(), current_->stream->layers, progress("rates of hogels")));
    describe();
    const std::size_t step = step_for(layers.grid(), max_compared_samples);
    const SampleComparison errors =
        compare(every_nth_hogel(original, step), every_nth_hogel(layers, step), progress("measuring errors"));
    current_->stream->sqnr = errors.sqnr;
    current_->stream->psnr = errors.psnr;
    describe();
}

}  // namespace hogel::view
