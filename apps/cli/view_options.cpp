// SPDX-License-Identifier: Apache-2.0
#include "view_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "hogel/error.h"

namespace hogel::cli {
namespace {

constexpr std::uint64_t max_port = 65535;
constexpr std::size_t shortest_token = 16;  // 80 bits of random letters and digits

void require_token(const ViewOptions& options) {
    if (options.token.empty()) {
        if (is_loopback(options.host)) return;
        throw Error(ErrorCode::usage, fmt::format("--host {}: whoever reaches this address would see the pictures; "
                                                  "add --token with at least {} letters and digits",
                                                  options.host, shortest_token));
    }
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
    if (options.token.size() < shortest_token || !std::ranges::all_of(options.token, allowed))
        throw Error(ErrorCode::usage,
                    fmt::format("--token: at least {} letters, digits, '-' or '_' were expected", shortest_token));
}

}  // namespace

bool is_loopback(const std::string& host) {
    return host == "localhost" || host == "::1" ||
           (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos);
}

void add_view_options(Command& command, ViewOptions& options) {
    command.examples(
        "  hogel view pumpkin.h5\n"
        "  hogel view bunny.ply --hogels 200 --size 30mm\n"
        "  hogel view pumpkin.hgl --port 8080 --no-browser\n"
        "  hogel view hologram.h5\n"
        "  hogel view phase.png --phase-code slmsuite --pitch 8um --wavelength 532nm");
    command.basics(
        {"port", "no-browser", "hogels", "directions", "size", "rotate", "light", "memory", "pitch", "wavelength"});
    command.positional("input", options.input, "X.h5|SCENE|F.h5|FOLDER",
                       "Light field, set of views, mesh file, built-in scene, hologram, another program's field, or a "
                       "folder of hogel make");
    command.whole("--port", options.port, max_port, "Port to listen on; 0: one that is free");
    command.text("--host", options.host, "ADDRESS", "Address to listen on; one of others needs --token");
    command
        .text("--token", options.token, "WORD",
              "What the page's address must hold, so that only those who know it see pictures")
        .no_default();
    command.flag("--no-browser", options.no_browser, "Print the address and open no browser");
    command
        .number("--memory", options.memory, "GB",
                "For the samples of the light field; of a larger one some hogels are left out")
        .range(0.001, 1e6);
    command.count("--looks", options.looks, "Photographs by waves averaged against speckle, unless of a hologram file");
    command.count("--layers", options.layers, "Show the first layers of a .hgl file alone (default: all)").no_default();
    command
        .text("--original", options.original, "X.h5",
              "The light field that a .hgl file was made of, beside which errors are shown (default: the whole file)")
        .no_default();
    options.hologram.declare(command);
    options.render.declare(command);
    options.render.declare_hemicube(command);
    options.field.declare(command, false, true);
    options.field.declare_reconstruction(command);
}

std::string require_viewable(const ViewOptions& options) {
    require_token(options);
    const std::filesystem::path made = std::filesystem::path(options.input) / "lightfield.h5";
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::path(options.input) / "report.json", none)) {
        if (std::filesystem::exists(made, none)) return made.string();
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: holds no lightfield.h5; 'hogel make --keep-light-field' keeps it", options.input));
    }
    options.field.require_described(options.input);
    if (!options.field.is_external(options.input)) input_kind(options.input);
    return options.input;
}

}  // namespace hogel::cli
