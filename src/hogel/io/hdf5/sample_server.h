// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hogel/core/child_process.h"
#include "hogel/io/hdf5/hdf5.h"
#include "hogel/io/hdf5/rehearsal.h"

namespace hogel::io::hdf5 {

/// A box of an array, by first index and extent along each axis.
struct Box {
    std::vector<std::size_t> start, extent;
};

/// Reads samples of a dataset by HDF5 in a child process: the library finds, unpacks and converts chunks without
/// checking them, and crashes on some that are damaged (docs/decisions/0061). The child starts with the first box and
/// reads one box after the other, so that HDF5's cache of chunks helps.
class SampleServer {
  public:
    /// @param chunk_bytes  of a chunk when unpacked: what the child may need beside the box
    SampleServer(std::filesystem::path file, std::string dataset, std::size_t axes, Element element,
                 std::size_t chunk_bytes);

    /// Fills `to` with a box of samples of the element's type, row by row. May be called from several threads. Throws
    /// Error(bad_input) if HDF5 fails, crashes or hangs, or if the file is no longer the one that it was;
    /// Error(cancelled).
    void read(const Box& box, void* to);

  private:
    void start();
    void ask(const Box& box, void* to);

    std::filesystem::path file_;
    std::string dataset_;
    std::size_t axes_;
    Element element_;
    std::size_t chunk_bytes_;
    FileIdentity identity_;
    std::mutex mutex_;
    std::unique_ptr<core::ChildProcess> child_;
};

}  // namespace hogel::io::hdf5
