// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "command_line.h"
#include "inputs.h"

namespace hogel::cli {

inline constexpr const char* view_summary = "Look around in a light field, a hologram or a scene, in a browser";

/// The options of `hogel view`. hogel reads them to refuse what is wrong, and the viewer, a program of its own that
/// hogel then becomes, to act on them.
struct ViewOptions {
    std::string input;
    std::string host = "127.0.0.1";
    std::uint64_t port = 0;  ///< 0: one that is free
    std::string token;       ///< empty: none, on this machine alone
    bool no_browser = false;
    double memory = 4;  ///< GB for the samples of the light field
    std::size_t looks = defaults.looks;
    std::size_t layers = 0;  ///< of a .hgl stream; 0: all
    std::string original;    ///< a light field beside which errors are shown; empty: the whole stream
    LightFieldParameters render;
    HologramParameters hologram;
    FieldParameters field;
};
void add_view_options(Command& command, ViewOptions& options);

/// What there is to open: the input, or in a folder that `hogel make` wrote its light field. Throws Error(usage) and
/// Error(bad_input) for what cannot be viewed, and Error(usage) for a host or token that is not allowed.
std::string require_viewable(const ViewOptions& options);

/// Whether an address is this machine's own: 127.0.0.1 and its neighbours, ::1, localhost.
bool is_loopback(const std::string& host);

}  // namespace hogel::cli
