// SPDX-License-Identifier: Apache-2.0
#include "view/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "hogel/error.h"
#include "hogel/parameters.h"
#include "view/facts.h"
#include "view/hologram_viewable.h"

namespace hogel::view {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

// Returns a light field of the same scene with about `samples` samples. Halves the directions first, because
// interpolated directions are less visible in motion than larger hogels.
LightField with_fewer_samples(const std::shared_ptr<const ShadedScene>& shaded_scene, LightFieldRequest request,
                              double samples) {
    LightFieldGrid& grid = request.grid;
    constexpr std::size_t min_halved = 16;  // halves only counts from twice this
    for (std::size_t* count : {&grid.directions_u, &grid.directions_v})
        if (*count >= 2 * min_halved) *count = (*count + 1) / 2;
    const double width = grid.width(), step = std::max(1.0, std::sqrt(grid.samples() / samples));
    for (std::size_t* count : {&grid.hogels_s, &grid.hogels_t})
        *count = std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(*count) / step));
    grid.pitch = width / static_cast<double>(grid.hogels_s);
    return hogel::render_light_field(shaded_scene, request);
}

// Returns the parameters of an error; the changed options if a usage error names none.
std::vector<std::string> parameters_of(const Error& error, const std::map<std::string, std::string>& changed) {
    std::vector<std::string> names = names_of_parameters(error.parameter());
    if (names.empty() && error.code() == ErrorCode::usage)
        for (const auto& [name, value] : changed) names.push_back(name);
    return names;
}

}  // namespace

Loader::Loader(Settings settings, Viewer& viewer, std::function<void(const std::string& line)> say, std::stop_token end)
    : viewer_(viewer),
      say_(std::move(say)),
      end_(std::move(end)),
      current_(std::make_shared<State>(std::move(settings))),
      coarse_samples_(first_look_samples) {
    open_input(*current_);
    shown_ = current_;
    describe();
}

Loader::~Loader() {
    thread_.request_stop();
    stop_.request_stop();
}

std::size_t Loader::memory() const { return static_cast<std::size_t>(current_->settings.options().memory * 1e9); }

void Loader::open_input(State& state) {
    ViewerParameters options = state.settings.options();
    const std::string& input = state.settings.input();
    if (options.field.is_external(input) || input_kind(input) == InputKind::hologram) {
        options.field.pitch = options.hologram.pitch;
        options.field.wavelengths = options.hologram.wavelengths;
        OpenedFields opened = options.field.open_and_reconstruct(input, state.settings.table());
        for (const std::string& note : opened.notes) say_(note);
        state.fields = std::move(opened.fields);
    } else if (input_kind(input) == InputKind::light_field) {
        state.file = open_light_field_or_views(input);
    }
}

void Loader::start(std::function<void()> failed) {
    thread_ = std::jthread([this, failed = std::move(failed)](const std::stop_token& end) {
        try {
            show_input(false);
            is_shown_ = true;
            viewer_.set_status("", 1);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            // A waiting task may have cancelled this one.
            if (!waiting_) {
                error_ = std::current_exception();
                return failed();
            }
        }
        run(end);
    });
}

void Loader::finish() {
    thread_.request_stop();
    {
        const std::lock_guard lock(mutex_);
        stop_.request_stop();
    }
    if (thread_.joinable()) thread_.join();
    if (error_) std::rethrow_exception(error_);
}

void Loader::change(const std::map<std::string, std::string>& options, bool moving) {
    const std::lock_guard lock(mutex_);
    if (waiting_ && !waiting_->file.empty()) return;  // the options belong to the input being replaced
    if (!waiting_) waiting_ = Task{};
    for (const auto& [name, value] : options) waiting_->options[name] = value;
    waiting_->moving = moving;
    stop_.request_stop();
    changed_.notify_one();
}

std::filesystem::path Loader::destination_for(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return drop_folder_.destination_for(name);
}

void Loader::open(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    drop_folder_.opened();
    waiting_ = Task{{}, file, false};
    stop_.request_stop();
    changed_.notify_one();
}

std::optional<Loader::Task> Loader::next(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, end, [&] { return waiting_.has_value(); }) || end.stop_requested()) return {};
    stop_ = std::stop_source();
    return std::exchange(waiting_, {});
}

void Loader::run(const std::stop_token& end) {
    while (const std::optional<Task> task = next(end)) {
        try {
            perform(*task);
            viewer_.set_status("", 1);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) continue;  // by a newer task
            report_failure(*task, current_->settings.table().describe(error), parameters_of(error, task->options));
        } catch (const std::exception& error) {
            report_failure(*task, error.what(), {});
        }
    }
}

void Loader::perform(const Task& task) {
    if (task.file.empty()) {
        current_->settings = current_->settings.with(task.options);
        show_input(task.moving);
        is_shown_ = true;
        return;
    }
    auto next_state = std::make_shared<State>(current_->settings.for_input(task.file, task.file.filename()));
    next_state->number = current_->number + 1;
    open_input(*next_state);
    current_ = std::move(next_state);
    show_input(false);
    shown_ = current_;
    is_shown_ = true;
    const std::lock_guard lock(mutex_);
    drop_folder_.forget_earlier();
}

// Keeps the last shown input. Removes the temporary folder of a dropped file from the message.
void Loader::report_failure(const Task& task, std::string why, const std::vector<std::string>& parameter) {
    const std::filesystem::path& file = task.file;
    const std::string folder = file.parent_path().string() + "/";
    for (std::size_t position = 0; !file.empty() && (position = why.find(folder, position)) != std::string::npos;)
        why.erase(position, folder.size());
    if (current_ != shown_) {
        shown_->number = current_->number;
        current_ = shown_;
        describe();
    }
    // A file dropped before the first input was shown has cancelled that input: retry it.
    if (!is_shown_ && !file.empty()) {
        const std::lock_guard lock(mutex_);
        if (!waiting_) waiting_ = Task{};
    }
    viewer_.report_error(why, parameter);
    viewer_.set_status("", 1);
}

void Loader::describe() {
    nlohmann::ordered_json facts{{"name", current_->settings.name()},
                                 {"photo", current_->settings.photo_command()},
                                 {"opened", current_->number},
                                 {"max_file_bytes", static_cast<double>(memory())}};
    if (current_->rendered_settings && current_->box)
        facts["scene"] = facts_of_scene(current_->settings, advice(), current_->model->is_file());
    if (current_->stream) {
        facts["stream"] = facts_of_stream(*current_->stream);
        facts["photo_original"] = current_->settings.original_command();
    }
    viewer_.describe(std::move(facts));
}

std::vector<Advice> Loader::advice() const {
    const ViewerParameters& options = current_->settings.options();
    const LightFieldRequest request = options.render.request();
    std::vector<Advice> all =
        advise(*current_->box, request, options.hologram.request(request.grids(), current_->settings.seed(), 1));
    const double max_samples = 0.5 * static_cast<double>(memory()), samples = request.grid.samples();
    if (samples > max_samples)
        all.push_back(
            {"hogels", fmt::format("{:.3g} samples of 2 bytes do not fit into --memory {:g}", samples, options.memory),
             std::floor(static_cast<double>(request.grid.hogels_s) * std::sqrt(max_samples / samples)), true});
    return all;
}

Progress Loader::progress(const char* status) {
    std::stop_token stop;
    {
        const std::lock_guard lock(mutex_);
        stop = stop_.get_token();
    }
    return Progress(stop, [this, status](double fraction) {
        viewer_.set_status(status, fraction);
        return true;
    });
}

// Returns the photographs by waves, of the holograms of `hogel photo --wave`. A rendered light field is read into
// memory first. The holograms serve all pages: their computation stops only if no page is left.
std::unique_ptr<Waves> Loader::waves_of(const LightField& light_field, bool rendered) {
    const auto making = Progress(end_, [viewer = &viewer_](double fraction) {
        const bool watched = viewer->is_watched();
        viewer->set_status(watched && fraction < 1 ? "preparing waves" : "", watched ? fraction : 1);
        return watched;
    });
    const auto make = [settings = current_->settings, say = say_, light_field, rendered, making] {
        const ViewerParameters& options = settings.options();
        LightField common = with_common_directions(light_field);
        const HologramRequest request = options.hologram.request(common.grids(), settings.seed(), options.looks);
        if (const std::string note = options.hologram.note_about_pitch(request, common.grid()); !note.empty())
            say(note);
        check_holograms(common.grids(), request, rendered);
        if (rendered)
            common = hogel::prepare_for_reading(common, request.channels.size(), needs_depth(request.method), making);
        return make_holograms(common, request);
    };
    return std::make_unique<Waves>(make, current_->settings.options().looks, memory() / 2, making);
}

void Loader::show(const LightField& complete, const LightField& shown, const char* status,
                  std::unique_ptr<Waves> waves) {
    viewer_.show(std::make_shared<LightFieldViewable>(complete, shown, memory(), progress(status), std::move(waves)));
}

void Loader::show_input(bool moving) {
    describe();
    if (!current_->fields.empty())
        viewer_.show(std::make_shared<HologramViewable>(current_->fields, memory(), progress("reading")));
    else if (!current_->file)
        show_scene(moving);
    else if (is_compressed())
        show_stream();
    else
        show_file(*current_->file);
}

void Loader::show_file(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t finest_step = step_that_fits(grid, memory()), first = step_of_first_look(grid);
    if (finest_step > 1)
        say_(fmt::format("{}: every {} of {}x{} hogels, which fit into --memory {:g}", current_->settings.name(),
                         finest_step == 3 ? "3rd" : fmt::format("{}th", finest_step), grid.hogels_s, grid.hogels_t,
                         current_->settings.options().memory));
    if (first > finest_step) show(light_field, every_nth_hogel(light_field, first), "opening");
    show(light_field, every_nth_hogel(light_field, finest_step), "reading", waves_of(light_field, false));
}

// Renders the scene with the current settings, coarse first, then finer. Stops after the coarse one in motion.
void Loader::show_scene(bool moving) {
    // Parameters of holograms do not change the light field.
    if (current_->complete && current_->rendered_settings->same_light_field(current_->settings)) return replace_waves();
    current_->complete.reset();
    const LightFieldRequest request = current_->settings.options().render.scene_request();
    viewer_.set_status("lighting", 0);
    if (!current_->model) current_->model.emplace(current_->settings.input(), request.import, progress("reading"));
    const Clock::time_point began = Clock::now();
    const Scene scene = current_->model->placed(request, progress("placing"));
    if (!current_->rendered_settings)
        for (const std::string& note : scene.notes) say_(fmt::format("{}: note: {}", current_->settings.name(), note));
    current_->rendered_settings = current_->settings;
    current_->box = bounds(scene);
    describe();
    require_memory_for(request.grid);
    const auto shaded_scene = light(scene, request);
    const LightField complete = renderer_of(shaded_scene, request);
    // Each picture reads the faces of a hemicube: render them once.
    if (complete.has_sides()) {
        const LightField kept = hogel::prepare_for_reading(complete, 2, false, progress("rendering"));
        return show(kept, kept, "rendering", waves_of(kept, false));
    }
    const double samples = request.grid.samples();
    if (samples > coarse_samples_) {
        show_of_scene(complete, with_fewer_samples(shaded_scene, request, coarse_samples_));
        // In motion, adapts the number of samples to 0.1 s per picture.
        constexpr double target_seconds = 0.1, min_samples = 3e6, max_samples = 64e6;
        if (moving) coarse_samples_ *= std::clamp(target_seconds / seconds_since(began), 0.5, 1.5);
        coarse_samples_ = std::clamp(coarse_samples_, min_samples, max_samples);
        if (moving) return;
    }
    if (samples > 32 * coarse_samples_)
        show_of_scene(complete, with_fewer_samples(shaded_scene, request, 8 * coarse_samples_));
    current_->complete = show_of_scene(complete, complete, waves_of(complete, true));
}

// Keeps the first exposure of the scene, so that changes of lights are visible.
std::shared_ptr<LightFieldViewable> Loader::show_of_scene(const LightField& complete, const LightField& shown,
                                                          std::unique_ptr<Waves> waves) {
    auto viewable =
        std::make_shared<LightFieldViewable>(complete, shown, memory(), progress("rendering"), std::move(waves));
    if (current_->exposure > 0)
        viewable->set_exposure(current_->exposure);
    else if (shown.grid() == complete.grid())
        current_->exposure = viewable->exposure();
    viewer_.show(viewable);
    return viewable;
}

void Loader::replace_waves() {
    current_->rendered_settings = current_->settings;
    describe();
    current_->complete =
        std::make_shared<LightFieldViewable>(*current_->complete, waves_of(current_->complete->light_field(), true));
    viewer_.show(current_->complete);
}

void Loader::require_memory_for(const LightFieldGrid& grid) const {
    if (step_that_fits(grid, memory()) == 1) return;
    throw Error(ErrorCode::usage, "hogels, directions, memory",
                fmt::format("the light field has {:.3g} samples of 2 bytes, more than {:g} GB", grid.samples(),
                            current_->settings.options().memory));
}

std::shared_ptr<const ShadedScene> Loader::light(const Scene& scene, const LightFieldRequest& request) {
    return hogel::light_scene(scene, request, progress("lighting"));
}

LightField Loader::renderer_of(const std::shared_ptr<const ShadedScene>& shaded_scene,
                               const LightFieldRequest& request) {
    return with_parameter("algorithm", [&] { return hogel::render_light_field(shaded_scene, request); });
}

}  // namespace hogel::view
