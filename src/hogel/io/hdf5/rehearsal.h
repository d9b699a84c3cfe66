// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <ctime>
#include <filesystem>
#include <functional>
#include <tuple>

#include "hogel/io/hdf5/hdf5.h"

namespace hogel::io::hdf5 {

/// Identity of a file and its version.
using FileIdentity = std::tuple<dev_t, ino_t, off_t, time_t, long, time_t, long>;
FileIdentity identity_of(const std::filesystem::path& path);

/// Runs `work`, which reads the structure of a file with HDF5, in a child process, because HDF5 crashes on some damaged
/// files with correct checksums. Exceptions of `work` are ignored there. Skips work of the same name that succeeded
/// before on the same, unchanged file. Throws Error(bad_input) if the child crashed, hung or used too much memory;
/// Error(cancelled). The caller holds a Session, so that no other thread is inside HDF5 during the fork.
void rehearse(const std::filesystem::path& path, const char* name, const std::function<void()>& work);

/// Disables rehearse() during its lifetime, for tests with thousands of files whose damage HDF5 detects.
class NoRehearsal {
  public:
    NoRehearsal();
    ~NoRehearsal();
    NoRehearsal(const NoRehearsal&) = delete;
    NoRehearsal& operator=(const NoRehearsal&) = delete;
};

/// Returns the result of `work` in a session, after a rehearsal.
template <class Work>
auto with_rehearsal(const std::filesystem::path& path, const char* name, const Work& work) {
    const Session session;
    rehearse(path, name, [&] { static_cast<void>(work()); });
    return work();
}

}  // namespace hogel::io::hdf5
