// SPDX-License-Identifier: Apache-2.0
#include "view/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "cli/fields.h"
#include "cli/inputs.h"
#include "hogel/error.h"
#include "view/facts.h"
#include "view/hologram_subject.h"

namespace hogel::view {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

// The same hologram with hogels `step` times as wide.
LightField with_fewer_hogels(const std::shared_ptr<const ShadedScene>& lit, LightFieldRequest request,
                             std::size_t step) {
    LightFieldGrid& grid = request.grid;
    const double width = grid.width();
    grid.hogels_t = std::max<std::size_t>(1, grid.hogels_t / step);
    grid.hogels_s = std::max<std::size_t>(1, grid.hogels_s / step);
    grid.pitch = width / static_cast<double>(grid.hogels_s);
    return hogel::render_light_field(lit, request);
}

}  // namespace

Loader::Loader(Settings settings, Viewer& viewer)
    : settings_(std::move(settings)), viewer_(viewer), coarse_samples_(first_look_samples) {
    open_input();
}

Loader::~Loader() {
    thread_.request_stop();
    stop_.request_stop();
}

std::size_t Loader::memory() const { return static_cast<std::size_t>(settings_.options().memory * 1e9); }

void Loader::open_input() {
    const cli::ViewOptions& options = settings_.options();
    const std::string& input = settings_.input();
    std::optional<LightField> file;
    Fields fields;
    if (cli::is_external(input, options.field) || input_kind(input) == InputKind::hologram) {
        cli::RunRecord record(settings_.session());
        fields = cli::open_and_reconstruct(settings_.session(), input, options.field, options.hologram.pitch,
                                           options.hologram.wavelengths, record);
    } else if (input_kind(input) == InputKind::light_field) {
        file = open_light_field_or_views(input);
    }
    file_ = std::move(file);
    fields_ = std::move(fields);
    model_.reset();
    box_.reset();
    stream_.reset();
    whole_.reset();
    made_.reset();
    exposure_ = 0;
    ++opened_;
    describe();
}

void Loader::start(std::function<void()> failed) {
    thread_ = std::jthread([this, failed = std::move(failed)](const std::stop_token& end) {
        try {
            show_input(false);
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
    if (!waiting_) waiting_.emplace();
    for (const auto& [name, value] : options) waiting_->options[name] = value;
    waiting_->moving = moving;
    stop_.request_stop();
    changed_.notify_one();
}

std::filesystem::path Loader::place_for(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return dropped_.place_for(name);
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
            viewer_.complain(error.what());
            viewer_.say("", 1);
        } catch (const std::exception& error) {
            viewer_.complain(error.what());
            viewer_.say("", 1);
        }
    }
}

void Loader::do_task(const Task& task) {
    if (task.file.empty()) {
        settings_ = settings_.with(task.options);
        return show_input(task.moving);
    }
    const Settings before = settings_;
    try {
        settings_ = settings_.of(task.file, task.file.filename());
        open_input();
    } catch (...) {
        settings_ = before;
        throw;
    }
    show_input(false);
    const std::lock_guard lock(mutex_);
    dropped_.forget_earlier();
}

void Loader::describe() {
    nlohmann::ordered_json facts{{"name", settings_.name()},
               {"photo", settings_.photo_command()},
               {"opened", opened_},
               {"largest_file", static_cast<double>(memory())}};
    if (made_ && box_) facts["scene"] = facts_of_scene(settings_, advice(), model_->is_file());
    if (stream_) facts["stream"] = facts_of_stream(*stream_);
    viewer_.describe(std::move(facts));
}

std::vector<Advice> Loader::advice() const {
    const cli::ViewOptions& options = settings_.options();
    const LightFieldRequest request = options.render.request();
    std::vector<Advice> all = advise(*box_, request, options.hologram.request(settings_.session(), 1));
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

// The holograms that `hogel photo --wave` makes, of the light field in memory where it is rendered.
std::unique_ptr<Waves> Loader::waves_of(const LightField& light_field, bool rendered) {
    const auto making = Progress(settings_.session().stop.get_token(), [viewer = &viewer_](double fraction) {
        viewer->say(fraction < 1 ? "preparing waves" : "", fraction);
        return true;
    });
    const auto make = [settings = settings_, light_field, rendered, making] {
        const cli::ViewOptions& options = settings.options();
        const HologramRequest request = options.hologram.request(settings.session(), options.looks);
        LightField common = with_common_directions(light_field);
        cli::check_holograms(common.grids(), request, rendered);
        if (rendered)
            common = hogel::prepare_for_reading(common, request.channels.size(), needs_depth(request.method), making);
        return make_holograms(common, request);
    };
    return std::make_unique<Waves>(make, settings_.options().looks, memory() / 2, making);
}

void Loader::show(const LightField& whole, const LightField& shown, const char* what, std::unique_ptr<Waves> waves) {
    viewer_.show(std::make_shared<LightFieldSubject>(whole, shown, memory(), progress(what), std::move(waves)));
}

void Loader::show_input(bool moving) {
    if (!fields_.empty())
        viewer_.show(std::make_shared<HologramSubject>(fields_, memory(), progress("reading")));
    else if (!file_)
        show_scene(moving);
    else if (is_compressed())
        show_stream();
    else
        show_file(*file_);
}

void Loader::show_file(const LightField& light_field) {
    const LightFieldGrid& grid = light_field.grid();
    const std::size_t finest = step_that_fits(grid, memory()), first = step_of_first_look(grid);
    if (finest > 1)
        settings_.session().say(fmt::format("{}: every {} of {}x{} hogels, which fit into --memory {:g}",
                                            settings_.name(), finest == 3 ? "3rd" : fmt::format("{}th", finest),
                                            grid.hogels_s, grid.hogels_t, settings_.options().memory));
    if (first > finest) show(light_field, every_nth_hogel(light_field, first), "opening");
    show(light_field, every_nth_hogel(light_field, finest), "reading", waves_of(light_field, false));
}

// A scene as it is now. What moves, and what comes first, has few hogels; then come more of them.
void Loader::show_scene(bool moving) {
    // Other samples of a hologram need no other light field.
    if (whole_ && made_->same_light_field(settings_)) return show_other_waves();
    whole_.reset();
    const LightFieldRequest request = cli::scene_request(settings_.options().render);
    viewer_.say("lighting", 0);
    if (!model_) model_.emplace(settings_.input(), request.import, progress("reading"));
    const Clock::time_point began = Clock::now();
    const Scene scene = cli::placing_scene([&] { return model_->placed(request, progress("placing")); });
    if (!made_)
        for (const std::string& note : scene.notes)
            settings_.session().say(fmt::format("{}: note: {}", settings_.name(), note));
    made_ = settings_;
    box_ = bounds(scene);
    describe();
    require_memory_for(request.grid);
    const auto lit = light(scene, request);
    const LightField whole = renderer_of(lit, request);
    // The faces of a hemicube are read by each picture, which must not render them anew.
    if (whole.has_sides()) {
        const LightField kept = hogel::prepare_for_reading(whole, 2, false, progress("rendering"));
        return show(kept, kept, "rendering", waves_of(kept, false));
    }
    const std::size_t first = step_for(request.grid, coarse_samples_), finer = step_for(request.grid, 8 * coarse_samples_);
    if (first > 1) {
        show_of_scene(whole, with_fewer_hogels(lit, request, first));
        // While something is dragged, as many samples as come in a tenth of a second.
        constexpr double wanted = 0.1, fewest = 5e5, most = 64e6;
        if (moving) coarse_samples_ *= std::clamp(wanted / seconds_since(began), 0.5, 1.5);
        coarse_samples_ = std::clamp(coarse_samples_, fewest, most);
        if (moving) return;
    }
    if (finer > 2) show_of_scene(whole, with_fewer_hogels(lit, request, finer));
    whole_ = show_of_scene(whole, whole, waves_of(whole, true));
}

// Its exposure stays what it was at first, so that a light that moves is seen to.
std::shared_ptr<LightFieldSubject> Loader::show_of_scene(const LightField& whole, const LightField& shown,
                                                         std::unique_ptr<Waves> waves) {
    auto subject = std::make_shared<LightFieldSubject>(whole, shown, memory(), progress("rendering"), std::move(waves));
    if (exposure_ > 0)
        subject->set_exposure(exposure_);
    else if (shown.grid() == whole.grid())
        exposure_ = subject->exposure();
    viewer_.show(subject);
    return subject;
}

void Loader::show_other_waves() {
    made_ = settings_;
    describe();
    whole_ = std::make_shared<LightFieldSubject>(*whole_, waves_of(whole_->light_field(), true));
    viewer_.show(whole_);
}

void Loader::require_memory_for(const LightFieldGrid& grid) const {
    if (step_that_fits(grid, memory()) == 1) return;
    throw Error(ErrorCode::usage, fmt::format("--memory {:g}: the light field has {:.3g} samples of 2 bytes; "
                                              "fewer --hogels or --directions would do",
                                              settings_.options().memory, grid.samples()));
}

std::shared_ptr<const ShadedScene> Loader::light(const Scene& scene, const LightFieldRequest& request) {
    return cli::with_options({{"shadow map", "--shadow-map"}, {"shading model", "--shading"}},
                             [&] { return hogel::light_scene(scene, request, progress("lighting")); });
}

LightField Loader::renderer_of(const std::shared_ptr<const ShadedScene>& lit, const LightFieldRequest& request) {
    return cli::with_options({{"", "--algorithm"}}, [&] { return hogel::render_light_field(lit, request); });
}

}  // namespace hogel::view
