// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "hogel/pipeline.h"
#include "view/drop_folder.h"
#include "view/facts.h"
#include "view/light_field_viewable.h"
#include "view/settings.h"
#include "view/viewer.h"
#include "view/waves.h"

namespace hogel::view {

/// Prepares what is looked at on a thread of its own, a coarse light field first, while the server already answers.
/// Pages change options and open files; the newest of these wins and stops the work on an earlier one.
class Loader final : public Controller {
  public:
    /// Opens the input, so that what is wrong with a file is known before there is a page.
    /// @param say  prints a line
    /// @param end  stops all work
    Loader(Settings settings, Viewer& viewer, std::function<void(const std::string& line)> say, std::stop_token end);
    ~Loader() override;

    /// Begins. Calls `failed` on the loader's thread if the first input cannot be shown.
    void start(std::function<void()> failed);
    /// Waits for the thread and throws what the first input threw.
    void finish();

    void change(const std::map<std::string, std::string>& options, bool moving) override;
    std::filesystem::path destination_for(const std::string& name) override;
    void open(const std::filesystem::path& file) override;

  private:
    // What is to be shown next.
    struct Task {
        std::map<std::string, std::string> options;  // to change
        std::filesystem::path file;                  // to open instead, if it is not empty
        bool moving = false;
    };

    // One input as it is now.
    struct State {
        explicit State(Settings of) : settings(std::move(of)) {}
        Settings settings;
        std::optional<LightField> file;
        Fields fields;
        std::optional<StreamFacts> stream;
        std::optional<SceneModel> model;
        std::optional<Settings> made;               // of the light field of the scene
        std::optional<Bounds> box;                  // of the scene
        std::shared_ptr<LightFieldViewable> whole;  // what is shown of a scene, once it has all hogels
        double exposure = 0;                        // that stays while a scene changes; 0: automatic
        std::size_t number = 1;                     // of the inputs
    };

    void run(const std::stop_token& end);
    std::optional<Task> next(const std::stop_token& end);
    void do_task(const Task& task);
    void give_up(const Task& task, std::string why, const std::vector<std::string>& parameter);
    void open_input(State& state);
    void show_input(bool moving);
    void show_file(const LightField& light_field);
    bool is_compressed() const;
    void show_stream();
    void measure_stream(const LightField& layers, const LightField& original, LightFieldViewable& viewable);
    void show_scene(bool moving);
    void show_other_waves();
    std::shared_ptr<LightFieldViewable> show_of_scene(const LightField& whole, const LightField& shown,
                                                      std::unique_ptr<Waves> waves = {});
    void show(const LightField& whole, const LightField& shown, const char* what, std::unique_ptr<Waves> waves = {});
    void describe();
    std::vector<Advice> advice() const;

    std::shared_ptr<const ShadedScene> light(const Scene& scene, const LightFieldRequest& request);
    LightField renderer_of(const std::shared_ptr<const ShadedScene>& lit, const LightFieldRequest& request);
    Progress progress(const char* what);
    std::unique_ptr<Waves> waves_of(const LightField& light_field, bool rendered);
    void require_memory_for(const LightFieldGrid& grid) const;
    std::size_t memory() const;

    // Used by the thread alone, once it runs.
    Viewer& viewer_;
    std::function<void(const std::string& line)> say_;
    std::stop_token end_;
    std::shared_ptr<State> now_, shown_;  // what is prepared, and what was shown last, at first the first input
    bool is_shown_ = false;               // whether there is anything to see
    double coarse_samples_;               // of a light field that is rendered in a moment

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<Task> waiting_;
    std::stop_source stop_;  // of the work
    DropFolder dropped_;     // guarded by mutex_
    std::exception_ptr error_;
    std::jthread thread_;  // last, so that it ends before what it uses
};

}  // namespace hogel::view
