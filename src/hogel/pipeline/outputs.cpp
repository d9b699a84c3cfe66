// SPDX-License-Identifier: Apache-2.0
// Outputs other than light fields and holograms, and checks of outputs before work begins.
#include <fmt/format.h>

#include <chrono>

#include "hogel/core/output_file.h"
#include "hogel/error.h"
#include "hogel/pipeline.h"

namespace hogel {

void require_writable(const std::filesystem::path& file, std::span<const std::string> inputs) {
    core::require_target(file);
    std::error_code error;
    for (const std::string& input : inputs)
        if (std::filesystem::equivalent(file, input, error))
            throw Error(
                ErrorCode::usage,
                fmt::format("{}: is an input, which the output would replace; expected another name", file.string()));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    core::write_file(file, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
}

std::string describe_input(const std::string& name) {
    std::error_code error;
    const auto size = std::filesystem::file_size(name, error);
    if (error) return name;
    const auto date = std::filesystem::last_write_time(name, error).time_since_epoch();
    return fmt::format("{}, {} bytes, {} ns", name, size, std::chrono::nanoseconds(date).count());
}

std::string describe_input(const std::string& name, const Scene& scene) {
    return fmt::format("{} showing {:08x}", name, checksum(scene));
}

}  // namespace hogel
