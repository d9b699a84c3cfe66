// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "cli/view_options.h"
#include "view/viewer.h"
#include "view/waves.h"

namespace hogel::view {

/// Prepares what is looked at on a thread of its own, a coarse light field first, while the server already answers.
class Loader {
  public:
    Loader(const cli::Session& session, const cli::ViewOptions& options, std::string input, Viewer& viewer);

    /// Opens a file, so that what is wrong with it is known before there is a page.
    void open();
    /// Calls `failed` on that thread if it throws.
    void load(const std::function<void()>& failed);
    /// Waits for the thread and throws what it threw.
    void finish();

  private:
    Progress progress(const char* what);
    std::unique_ptr<Waves> waves_of(const LightField& light_field, bool rendered);
    void show(const LightField& whole, const LightField& shown, const char* what, std::unique_ptr<Waves> waves = {});
    void show_file(const LightField& light_field);
    void show_scene();
    static LightField with_fewer_hogels(const std::shared_ptr<const ShadedScene>& lit, LightFieldRequest request,
                                        std::size_t step);

    const cli::Session& session_;
    const cli::ViewOptions& options_;
    std::string input_;
    std::size_t memory_;
    Viewer& viewer_;
    cli::RunRecord record_;
    std::optional<LightField> file_;
    Fields fields_;
    std::exception_ptr error_;
    std::jthread thread_;
};

}  // namespace hogel::view
