// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "hogel/error.h"
#include "hogel/requests.h"

namespace hogel {
namespace {

constexpr std::uint64_t max_port = 65535;
constexpr std::size_t shortest_token = 16;  // about 80 bits if random

// Returns whether an address is a loopback address: 127.*, ::1, localhost.
bool is_loopback(const std::string& host) {
    return host == "localhost" || host == "::1" ||
           (host.starts_with("127.") && host.find_first_not_of("0123456789.") == std::string::npos);
}

void require_token(const std::string& host, const std::string& token) {
    if (token.empty()) {
        if (is_loopback(host)) return;
        throw Error(
            ErrorCode::usage, "host",
            fmt::format("anyone who can reach {} would see the pictures; add --token with at least {} letters and "
                        "digits",
                        host, shortest_token));
    }
    const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; };
    if (token.size() < shortest_token || !std::ranges::all_of(token, allowed))
        throw Error(ErrorCode::usage, "token",
                    fmt::format("expected at least {} letters, digits, '-' or '_'", shortest_token));
}

}  // namespace

void ViewerParameters::declare(Parameters& parameters) {
    parameters.positional(
        "input", input, "X.h5|SCENE|F.h5|FOLDER",
        "Light field, set of views, picture, mesh file, built-in scene, hologram, another program's field, or a "
        "folder of hogel make");
    parameters.whole("--port", port, max_port, "Port to listen on; 0: any free port");
    parameters.text("--host", host, "ADDRESS",
                    "Address to listen on; any other than this machine's loopback needs --token");
    parameters
        .text("--token", token, "WORD", "Secret that the page's address must contain; requests without it are refused")
        .no_default();
    parameters.flag("--no-browser", no_browser, "Print the address without opening a browser");
    parameters
        .number("--memory", memory, "GB",
                "Memory for the samples of the light field; a larger one is shown with fewer hogels")
        .range(0.001, 1e6);
    parameters.count("--looks", looks, "Photographs by waves averaged against speckle, unless of a hologram file");
    parameters.count("--layers", layers, "Show only the first N layers of a .hgl file (default: all)").no_default();
    parameters
        .text("--original", original, "X.h5",
              "Light field that a .hgl file was made of, to show errors (default: the full file)")
        .no_default();
    hologram.declare(parameters);
    render.declare(parameters);
    render.declare_hemicube(parameters);
    field.declare(parameters, false, true);
    field.declare_reconstruction(parameters);
}

std::string ViewerParameters::viewable() const {
    require_token(host, token);
    const std::filesystem::path made = std::filesystem::path(input) / "lightfield.h5";
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::path(input) / "report.json", ignored)) {
        if (std::filesystem::exists(made, ignored)) return made.string();
        throw Error(ErrorCode::bad_input,
                    fmt::format("{}: holds no lightfield.h5; 'hogel make --keep-light-field' keeps it", input));
    }
    if (field.is_external(input)) return input;
    if (hologram.pitch_given) field.require_described(input);
    input_kind(input);
    return input;
}

}  // namespace hogel
