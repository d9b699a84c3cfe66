// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "hogel/focus.h"
#include "hogel/provenance.h"

namespace hogel::cli {

/// Throws Error(usage) for a name that does not end in .svg.
void require_plot_name(const std::filesystem::path& path);

/// Draws the contrasts of a search against depth, on a logarithmic axis, with a line at each plane in focus. The file
/// appears when it is complete; `metadata` is stored in it as its description. Throws Error(cannot_write).
void write_focus_plot(const std::filesystem::path& path, const FocusSearch& search, const std::string& title,
                      const Metadata& metadata);

}  // namespace hogel::cli
