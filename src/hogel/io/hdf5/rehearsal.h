// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <ctime>
#include <filesystem>
#include <functional>
#include <tuple>

#include "hogel/io/hdf5/hdf5.h"

namespace hogel::io::hdf5 {

/// What tells a file from others, and from itself before it was changed.
using FileIdentity = std::tuple<dev_t, ino_t, off_t, time_t, long, time_t, long>;
FileIdentity identity_of(const std::filesystem::path& path);

/// Does `work`, which reads the structure of a file with HDF5, in a child process, because the library crashes on some
/// damaged files whose checksums are right. What it throws there does not matter. The work is told by a name: where the
/// same was done on the same, unchanged file before, nothing is done. Throws Error(bad_input) if the child crashed,
/// hung or took too much memory; Error(cancelled). The caller holds a Session: then no other thread is inside HDF5 when
/// the child is made.
void rehearse(const std::filesystem::path& path, const char* name, const std::function<void()>& work);

/// While it exists, rehearse() does nothing: for tests that read thousands of files whose damage HDF5 itself detects.
class NoRehearsal {
  public:
    NoRehearsal();
    ~NoRehearsal();
    NoRehearsal(const NoRehearsal&) = delete;
    NoRehearsal& operator=(const NoRehearsal&) = delete;
};

/// Result of `work` in a session, after a rehearsal.
template <class Work>
auto with_rehearsal(const std::filesystem::path& path, const char* name, const Work& work) {
    const Session session;
    rehearse(path, name, [&] { static_cast<void>(work()); });
    return work();
}

}  // namespace hogel::io::hdf5
