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

/// A box of an array: first index and extent along each axis.
struct Box {
    std::vector<std::size_t> start, extent;
};

/// Reads samples of a dataset by HDF5 in a child process, because HDF5 processes chunks without checks and crashes on
/// some damaged ones (docs/decisions/0061). One child serves all boxes, which keeps HDF5's chunk cache effective.
class SampleServer {
  public:
    /// @param chunk_bytes  of an unpacked chunk: memory of the child beside the box
    SampleServer(std::filesystem::path file, std::string dataset, std::size_t axes, Element element,
                 std::size_t chunk_bytes);

    /// Reads a box of the dataset into `to`, row-major, as numbers of the type that the constructor got. Thread-safe.
    /// Throws Error(bad_input) if HDF5 fails, crashes or hangs, or if the file has changed; Error(cancelled).
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
