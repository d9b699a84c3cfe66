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

// A light field of the same scene in about so many samples. Half as many directions come first, because an eye sees
// hogels one by one, and directions between two of them well enough in motion.
LightField with_fewer_samples(const std::shared_ptr<const ShadedScene>& lit, LightFieldRequest request,
                              double samples) {
    LightFieldGrid& grid = request.grid;
    constexpr std::size_t few = 16;  // directions, which are not halved
    for (std::size_t* count : {&grid.directions_u, &grid.directions_v})
        if (*count >= 2 * few) *count = (*count + 1) / 2;
    const double width = grid.width(), step = std::max(1.0, std::sqrt(grid.samples() / samples));
    for (std::size_t* count : {&grid.hogels_s, &grid.hogels_t})
        *count = std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(*count) / step));
    grid.pitch = width / static_cast<double>(grid.hogels_s);
    return hogel::render_light_field(lit, request);
}

// The parameters that an error is about: the changed options, if a refused request names none.
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
      now_(std::make_shared<State>(std::move(settings))),
      coarse_samples_(first_look_samples) {
    open_input(*now_);
    shown_ = now_;
    describe();
}

Loader::~Loader() {
    thread_.request_stop();
    stop_.request_stop();
}

std::size_t Loader::memory() const { return static_cast<std::size_t>(now_->settings.options().memory * 1e9); }

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
            viewer_.say("", 1);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            // A change may have stopped it; then there is a newer task.
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
    if (waiting_ && !waiting_->file.empty()) return;  // of what will not be shown any more
    if (!waiting_) waiting_ = Task{};
    for (const auto& [name, value] : options) waiting_->options[name] = value;
    waiting_->moving = moving;
    stop_.request_stop();
    changed_.notify_one();
}

std::filesystem::path Loader::destination_for(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return dropped_.destination_for(name);
}

void Loader::open(const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    dropped_.opened();
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
            do_task(*task);
            viewer_.say("", 1);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) continue;  // for a newer task
            give_up(*task, now_->settings.table().describe(error), parameters_of(error, task->options));
        } catch (const std::exception& error) {
            give_up(*task, error.what(), {});
        }
    }
}

void Loader::do_task(const Task& task) {
    if (task.file.empty()) {
        now_->settings = now_->settings.with(task.options);
        show_input(task.moving);
        is_shown_ = true;
        return;
    }
    auto another = std::make_shared<State>(now_->settings.of(task.file, task.file.filename()));
    another->number = now_->number + 1;
    open_input(*another);
    now_ = std::move(another);
    show_input(false);
    shown_ = now_;
    is_shown_ = true;
    const std::lock_guard lock(mutex_);
    dropped_.forget_earlier();
}

// What was shown before stays. People know a dropped file by its name, not by its place.
void Loader::give_up(const Task& task, std::string why, const std::vector<std::string>& parameter) {
    const std::filesystem::path& file = task.file;
    const std::string place = file.parent_path().string() + "/";
    for (std::size_t at = 0; !file.empty() && (at = why.find(place, at)) != std::string::npos;)
        why.erase(at, place.size());
    if (now_ != shown_) {
        shown_->number = now_->number;
        now_ = shown_;
        describe();
    }
    // A file that came before the first input was shown stopped the work on that.
    if (!is_shown_ && !file.empty()) {
        const std::lock_guard lock(mutex_);
        if (!waiting_) waiting_ = Task{};
    }
    viewer_.complain(why, parameter);
    viewer_.say("", 1);
}

void Loader::describe() {
    nlohmann::ordered_json facts{{"name", now_->settings.name()},
                                 {"photo", now_->settings.photo_command()},
                                 {"opened", now_->number},
                                 {"max_file_bytes", static_cast<double>(memory())}};
    if (now_->made && now_->box) facts["scene"] = facts_of_scene(now_->settings, advice(), now_->model->is_file());
    if (now_->stream) {
        facts["stream"] = facts_of_stream(*now_->stream);
        facts["photo_original"] = now_->settings.original_command();
    }
    viewer_.describe(std::move(facts));
}

std::vector<Advice> Loader::advice() const {
    const ViewerParameters& options = now_->settings.options();
    const LightFieldRequest request = options.render.request();
    std::vector<Advice> all =
        advise(*now_->box, request, options.hologram.request(request.grids(), now_->settings.seed(), 1));
    const double most = 0.5 * static_cast<double>(memory()), samples = request.grid.samples();
    if (samples > most)
        all.push_back({"hogels",
                       fmt::format("{:.3g} samples of 2 bytes do not fit into --memory {:g}", samples, options.memory),
                       std::floor(static_cast<double>(request.grid.hogels_s) * std::sqrt(most / samples)), true});
    return all;
}

Progress Loader::progress(const char* what) {
    std::stop_token stop;
    {
        const std::lock_guard lock(mutex_);
        stop = stop_.get_token();
    }
    return Progress(stop, [this, what](double fraction) {
        viewer_.say(what, fraction);
        return true;
    });
}

// The holograms that `hogel photo --wave` makes, of the light field in memory where it is rendered. They serve all
// pages, so that making them stops only where none is left.
std::unique_ptr<Waves> Loader::waves_of(const LightField& light_field, bool rendered) {
    const auto making = Progress(end_, [viewer = &viewer_](double fraction) {
        const bool watched = viewer->is_watched();
        viewer->say(watched && fraction < 1 ? "preparing waves" : "", watched ? fraction : 1);
        return watched;
    });
    const auto make = [settings = now_->settings, say = say_, light_field, rendered, making] {
        const ViewerParameters& options = settings.options();
        LightField common = with_common_directions(light_field);
        const HologramRequest request = options.hologram.request(common.grids(), settings.seed(), options.looks);
        if (const std::string note = options.hologram.note_about_pitch(request); !note.empty()) say(note);
        check_holograms(common.grids(), request, rendered);
        if (rendered)
            common = hogel::prepare_for_reading(common, request.channels.size(), needs_depth(request.method), making);
        return make_holograms(common, request);
    };
    return std::make_unique<Waves>(make, now_->settings.options().looks, memory() / 2, making);
}

void Loader::show(const LightField& whole, const LightField& shown, const char* what, std::unique_ptr<Waves> waves) {
    viewer_.show(std::make_shared<LightFieldViewable>(whole, shown, memory(), progress(what), std::move(waves)));
}

void Loader::show_input(bool moving) {
    describe();
    if (!now_->fields.empty())
        viewer_.show(std::make_shared<HologramViewable>(now_->fields, memory(), progress("reading")));
    else if (!now_->file)
        show_scene(moving);
    else if (is_compressed())
        show_stream();
    else
        show_file(*now_->file);
}

void Loader::show_file(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t finest = step_that_fits(grid, memory()), first = step_of_first_look(grid);
    if (finest > 1)
        say_(fmt::format("{}: every {} of {}x{} hogels, which fit into --memory {:g}", now_->settings.name(),
                         finest == 3 ? "3rd" : fmt::format("{}th", finest), grid.hogels_s, grid.hogels_t,
                         now_->settings.options().memory));
    if (first > finest) show(light_field, every_nth_hogel(light_field, first), "opening");
    show(light_field, every_nth_hogel(light_field, finest), "reading", waves_of(light_field, false));
}

// A scene as it is now. What moves, and what comes first, has few hogels; then come more of them.
void Loader::show_scene(bool moving) {
    // Other samples of a hologram need no other light field.
    if (now_->whole && now_->made->same_light_field(now_->settings)) return show_other_waves();
    now_->whole.reset();
    const LightFieldRequest request = now_->settings.options().render.scene_request();
    viewer_.say("lighting", 0);
    if (!now_->model) now_->model.emplace(now_->settings.input(), request.import, progress("reading"));
    const Clock::time_point began = Clock::now();
    const Scene scene = now_->model->placed(request, progress("placing"));
    if (!now_->made)
        for (const std::string& note : scene.notes) say_(fmt::format("{}: note: {}", now_->settings.name(), note));
    now_->made = now_->settings;
    now_->box = bounds(scene);
    describe();
    require_memory_for(request.grid);
    const auto lit = light(scene, request);
    const LightField whole = renderer_of(lit, request);
    // The faces of a hemicube are read by each picture, which must not render them anew.
    if (whole.has_sides()) {
        const LightField kept = hogel::prepare_for_reading(whole, 2, false, progress("rendering"));
        return show(kept, kept, "rendering", waves_of(kept, false));
    }
    const double samples = request.grid.samples();
    if (samples > coarse_samples_) {
        show_of_scene(whole, with_fewer_samples(lit, request, coarse_samples_));
        // While something is dragged, as many samples as come in a tenth of a second.
        constexpr double wanted = 0.1, fewest = 3e6, most = 64e6;
        if (moving) coarse_samples_ *= std::clamp(wanted / seconds_since(began), 0.5, 1.5);
        coarse_samples_ = std::clamp(coarse_samples_, fewest, most);
        if (moving) return;
    }
    if (samples > 32 * coarse_samples_) show_of_scene(whole, with_fewer_samples(lit, request, 8 * coarse_samples_));
    now_->whole = show_of_scene(whole, whole, waves_of(whole, true));
}

// Its exposure stays what it was at first, so that a light that moves is seen to.
std::shared_ptr<LightFieldViewable> Loader::show_of_scene(const LightField& whole, const LightField& shown,
                                                          std::unique_ptr<Waves> waves) {
    auto viewable =
        std::make_shared<LightFieldViewable>(whole, shown, memory(), progress("rendering"), std::move(waves));
    if (now_->exposure > 0)
        viewable->set_exposure(now_->exposure);
    else if (shown.grid() == whole.grid())
        now_->exposure = viewable->exposure();
    viewer_.show(viewable);
    return viewable;
}

void Loader::show_other_waves() {
    now_->made = now_->settings;
    describe();
    now_->whole = std::make_shared<LightFieldViewable>(*now_->whole, waves_of(now_->whole->light_field(), true));
    viewer_.show(now_->whole);
}

void Loader::require_memory_for(const LightFieldGrid& grid) const {
    if (step_that_fits(grid, memory()) == 1) return;
    throw Error(ErrorCode::usage, "hogels, directions, memory",
                fmt::format("the light field has {:.3g} samples of 2 bytes, more than {:g} GB", grid.samples(),
                            now_->settings.options().memory));
}

std::shared_ptr<const ShadedScene> Loader::light(const Scene& scene, const LightFieldRequest& request) {
    return hogel::light_scene(scene, request, progress("lighting"));
}

LightField Loader::renderer_of(const std::shared_ptr<const ShadedScene>& lit, const LightFieldRequest& request) {
    return with_parameter("algorithm", [&] { return hogel::render_light_field(lit, request); });
}

}  // namespace hogel::view
