// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "hogel/focus.h"
#include "hogel/provenance.h"

namespace hogel::cli {

/// Throws Error(usage) unless the name ends in .svg.
void require_plot_name(const std::filesystem::path& path);

/// Plots the contrasts of a search on a logarithmic axis over depth, with a line at each plane in focus. Stores
/// `metadata` as the description. The file appears when it is complete. Throws Error(cannot_write).
void write_focus_plot(const std::filesystem::path& path, const FocusSearch& search, const std::string& title,
                      const Metadata& metadata);

}  // namespace hogel::cli
