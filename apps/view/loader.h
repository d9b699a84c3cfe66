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

/// Loads or renders the input on its own thread, a coarse light field first, while the server already answers.
/// Pages change options and open files; the newest request cancels earlier ones.
class Loader final : public Controller {
  public:
    /// Opens the input. Throws for a bad file, before a page exists.
    /// @param say  prints a line
    /// @param end  stops all work
    Loader(Settings settings, Viewer& viewer, std::function<void(const std::string& line)> say, std::stop_token end);
    ~Loader() override;

    /// Starts the thread. Calls `failed` on it if the first input cannot be shown.
    void start(std::function<void()> failed);
    /// Joins the thread. Rethrows the exception of the first input.
    void finish();

    void change(const std::map<std::string, std::string>& options, bool moving) override;
    std::filesystem::path destination_for(const std::string& name) override;
    void open(const std::filesystem::path& file) override;

  private:
    // Request of a page.
    struct Task {
        std::map<std::string, std::string> options;  // to change
        std::filesystem::path file;                  // to open; empty: only options change
        bool moving = false;
    };

    // One input and its current settings.
    struct State {
        explicit State(Settings initial) : settings(std::move(initial)) {}
        Settings settings;
        std::optional<LightField> file;
        Fields fields;
        std::optional<StreamFacts> stream;
        std::optional<SceneModel> model;
        std::optional<Settings> rendered_settings;     // settings of the rendered light field
        std::optional<Bounds> box;                     // of the scene
        std::shared_ptr<LightFieldViewable> complete;  // light field of a scene with all hogels
        double exposure = 0;                           // kept while a scene changes; 0: automatic
        std::size_t number = 1;                        // of the input, counted from 1
    };

    void run(const std::stop_token& end);
    std::optional<Task> next(const std::stop_token& end);
    void perform(const Task& task);
    void report_failure(const Task& task, std::string why, const std::vector<std::string>& parameter);
    void open_input(State& state);
    void show_input(bool moving);
    void show_file(const LightField& light_field);
    bool is_compressed() const;
    void show_stream();
    void measure_stream(const LightField& layers, const LightField& original, LightFieldViewable& viewable);
    void show_scene(bool moving);
    void replace_waves();
    std::shared_ptr<LightFieldViewable> show_of_scene(const LightField& complete, const LightField& shown,
                                                      std::unique_ptr<Waves> waves = {});
    void show(const LightField& complete, const LightField& shown, const char* status,
              std::unique_ptr<Waves> waves = {});
    void describe();
    std::vector<Advice> advice() const;

    std::shared_ptr<const ShadedScene> light(const Scene& scene, const LightFieldRequest& request);
    LightField renderer_of(const std::shared_ptr<const ShadedScene>& shaded_scene, const LightFieldRequest& request);
    Progress progress(const char* status);
    std::unique_ptr<Waves> waves_of(const LightField& light_field, bool rendered);
    void require_memory_for(const LightFieldGrid& grid) const;
    std::size_t memory() const;

    // Used only by the thread once it runs.
    Viewer& viewer_;
    std::function<void(const std::string& line)> say_;
    std::stop_token end_;
    std::shared_ptr<State> current_, shown_;  // input in preparation, and the last one shown
    bool is_shown_ = false;                   // whether anything has been shown
    double coarse_samples_;                   // number of samples of a preview

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<Task> waiting_;
    std::stop_source stop_;   // of the work
    DropFolder drop_folder_;  // guarded by mutex_
    std::exception_ptr error_;
    std::jthread thread_;  // last member: joins before the others are destroyed
};

}  // namespace hogel::view
