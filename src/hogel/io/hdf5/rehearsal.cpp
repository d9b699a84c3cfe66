// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/hdf5/rehearsal.h"

#include <fmt/format.h>

#include "hogel/core/child_process.h"

namespace hogel::io::hdf5 {
namespace {

// The structure of a file is kilobytes; HDF5 itself needs a few megabytes.
constexpr core::ChildLimits limits{.memory = std::uint64_t{1} << 29, .cpu_seconds = 20};

}  // namespace

void rehearse(const std::filesystem::path& path, const std::function<void()>& work) {
    for (int attempt = 1;; ++attempt) {
        core::ChildProcess child(limits, [&](int pipe) {
            try {
                work();
            } catch (...) {  // the same comes in this process, where it can be reported
            }
            core::ChildProcess::write(pipe, "y", 1);
        });
        try {
            char done = 0;
            child.read(&done, 1);
            return;
        } catch (const core::ChildFailure& failure) {
            // A lock of another thread, of the allocator or a stream, see ChildProcess; it is rare.
            if (failure.kind() == core::ChildFailure::Kind::stuck && attempt == 1) continue;
            fail(path, fmt::format("the HDF5 library {} on it", failure.what()));
        }
    }
}

}  // namespace hogel::io::hdf5
