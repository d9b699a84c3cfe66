// SPDX-License-Identifier: Apache-2.0
// hogel-view: what `hogel view` becomes. It has this one command, whose options are read as hogel reads them.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "cli/concerns.h"
#include "cli/program.h"
#include "cli/view_options.h"
#include "hogel/error.h"
#include "view/browser.h"
#include "view/viewer.h"

namespace hogel::view {
namespace {

using cli::Session;
using cli::ViewOptions;

// Prepares the light field on a thread of its own, a coarse one first, while the server already answers.
class Loader {
  public:
    Loader(const Session& session, const ViewOptions& options, std::string input, Viewer& viewer)
        : session_(session),
          options_(options),
          input_(std::move(input)),
          memory_(static_cast<std::size_t>(options.memory * 1e9)),
          viewer_(viewer),
          record_(session) {}

    /// Opens a file, so that what is wrong with it is known before there is a page.
    void open() {
        if (input_kind(input_) == InputKind::light_field) file_ = open_light_field_or_views(input_);
    }

    void load(const std::function<void()>& failed) {
        thread_ = std::jthread([this, failed] {
            try {
                if (file_)
                    show_file(*file_);
                else
                    show_scene();
                viewer_.say("", 1);
            } catch (...) {
                error_ = std::current_exception();
                failed();
            }
        });
    }

    /// Waits for the thread and throws what it threw.
    void finish() {
        if (thread_.joinable()) thread_.join();
        if (error_) std::rethrow_exception(error_);
    }

  private:
    Progress progress(const char* what) {
        return Progress(session_.stop.get_token(), [this, what](double fraction) {
            viewer_.say(what, fraction);
            return true;
        });
    }

    void show(const LightField& whole, const LightField& shown, const char* what) {
        viewer_.show(std::make_shared<Subject>(whole, shown, memory_, progress(what)));
    }

    void show_file(const LightField& light_field) {
        const LightFieldGrid& grid = light_field.grid();
        const std::size_t finest = step_that_fits(grid, memory_), first = step_of_first_look(grid);
        if (finest > 1)
            session_.say(fmt::format("{}: every {} of {}x{} hogels, which fit into --memory {:g}", input_,
                                     finest == 3 ? "3rd" : fmt::format("{}th", finest), grid.hogels_s, grid.hogels_t,
                                     options_.memory));
        if (first > finest) show(light_field, every_nth_hogel(light_field, first), "opening");
        show(light_field, every_nth_hogel(light_field, finest), "reading");
    }

    void show_scene() {
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
            return show(kept, kept, "rendering");
        }
        if (first > 1) show(whole, with_fewer_hogels(lit, request, first), "rendering");
        show(whole, whole, "rendering");
    }

    // The same hologram with hogels `step` times as wide.
    static LightField with_fewer_hogels(const std::shared_ptr<const ShadedScene>& lit, LightFieldRequest request,
                                        std::size_t step) {
        LightFieldGrid& grid = request.grid;
        const double width = grid.width();
        grid.hogels_t = std::max<std::size_t>(1, grid.hogels_t / step);
        grid.hogels_s = std::max<std::size_t>(1, grid.hogels_s / step);
        grid.pitch = width / static_cast<double>(grid.hogels_s);
        return hogel::render_light_field(lit, request);
    }

    const Session& session_;
    const ViewOptions& options_;
    std::string input_;
    std::size_t memory_;
    Viewer& viewer_;
    cli::RunRecord record_;
    std::optional<LightField> file_;
    std::exception_ptr error_;
    std::jthread thread_;
};

// A word of a command line as a shell reads it.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789._-+=,:/@%") == std::string::npos;
    if (plain) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

// `hogel photo` with the words of this command line that photographs have too, the input's options above all.
std::string photo_command(char* const* arguments, const ViewOptions& options, const std::string& input) {
    std::string command = "hogel photo";
    for (char* const* at = arguments + 2; *at != nullptr; ++at) {
        const std::string word = *at, name = word.substr(0, word.find('='));
        if (name == "--no-browser" || name == "--json") continue;
        if (name == "--port" || name == "--host" || name == "--token" || name == "--memory") {
            if (name == word && at[1] != nullptr) ++at;
            continue;
        }
        command += " " + quoted(word == options.input ? input : word);
    }
    return command;
}

std::string address_of(const ViewOptions& options, unsigned short port) {
    const std::string host = options.host.find(':') == std::string::npos ? options.host : "[" + options.host + "]";
    return fmt::format("http://{}:{}/{}", host, port, options.token.empty() ? "" : "?token=" + options.token);
}

int serve(const ViewOptions& options, Session& session) {
    const std::string input = cli::require_viewable(options);
    Server server(options.host, static_cast<unsigned short>(options.port));
    const auto viewer = std::make_shared<Viewer>(Access(options.host, server.port(), options.token), options.input,
                                                 photo_command(session.arguments, options, input));
    Loader loader(session, options, input, *viewer);
    loader.open();
    loader.load([&session] { session.stop.request_stop(); });
    const std::string address = address_of(options, server.port());
    session.result({{"address", address}, {"port", server.port()}}, address + "\n");
    std::fflush(stdout);
    if (!options.no_browser) open_browser(address);
    server.run(*viewer, session.stop.get_token());
    loader.finish();
    throw Error(ErrorCode::cancelled, "stopped");
}

void add_viewer(cli::Command& command, Session& session) {
    auto options = std::make_shared<ViewOptions>();
    cli::add_view_options(command, *options, session);
    command.work([options, &session] { return serve(*options, session); });
}

}  // namespace
}  // namespace hogel::view

int main(int argc, char** argv) {
    static const hogel::cli::CommandInfo commands[] = {{"view", hogel::cli::view_summary, hogel::view::add_viewer}};
    return hogel::cli::run_program(commands, argc, argv);
}
