// SPDX-License-Identifier: Apache-2.0
#include "hogel/io/hdf5/sample_server.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "hogel/error.h"
#include "hogel/io/hdf5/runs.h"

namespace hogel::io::hdf5 {
namespace {

using core::ChildFailure;
using core::ChildProcess;

// Limits beside box and chunks. The time allows several passes of slow filters (10 MB/s) per chunk.
constexpr std::uint64_t spare_memory = std::uint64_t{256} << 20;
constexpr unsigned spare_seconds = 20;
constexpr std::uint64_t bytes_a_second = std::uint64_t{1} << 20;
// Copies of a chunk: packed, between two filters, unpacked, and cached.
constexpr std::uint64_t copies_of_chunk = 4;

constexpr std::size_t max_reason = 1000;

// Child side.
class Samples {
  public:
    Samples(const std::filesystem::path& path, const std::string& name, Element element)
        : file_(open_file(path)),
          dataset_(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose),
          type_(type_of(element)) {}

    /// Returns false if HDF5 reports a failure.
    bool read(const std::vector<hsize_t>& start, const std::vector<hsize_t>& extent, void* to) const {
        const Handle file_space(H5Dget_space(dataset_.id()), H5Sclose);
        const Handle memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
        return H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) >=
                   0 &&
               H5Dread(dataset_.id(), type_.id(), memory_space.id(), file_space.id(), H5P_DEFAULT, to) >= 0;
    }

  private:
    Handle file_, dataset_, type_;
};

// Answers are 'y' and the samples, or 'n' and the reason as a text of max_reason bytes.
void refuse(int pipe, std::string reason) {
    reason.resize(max_reason);
    ChildProcess::write(pipe, "n", 1);
    ChildProcess::write(pipe, reason.data(), reason.size());
}

void serve(int pipe, std::size_t axes, const Samples& samples, std::size_t element_bytes, std::uint64_t chunk_bytes) {
    std::vector<hsize_t> start(axes), extent(axes);
    std::vector<char> box;
    while (ChildProcess::receive(pipe, start.data(), axes * sizeof(hsize_t)) &&
           ChildProcess::receive(pipe, extent.data(), axes * sizeof(hsize_t))) {
        const std::uint64_t bytes = samples_of({extent.begin(), extent.end()}) * element_bytes;
        ChildProcess::renew_limits(
            {.memory = spare_memory + copies_of_chunk * chunk_bytes + bytes,
             .cpu_seconds = spare_seconds + static_cast<unsigned>((bytes + chunk_bytes) / bytes_a_second)});
        box.resize(bytes);
        if (!samples.read(start, extent, box.data())) {
            refuse(pipe, reason());
            continue;
        }
        ChildProcess::write(pipe, "y", 1);
        ChildProcess::write(pipe, box.data(), bytes);
    }
}

}  // namespace

SampleServer::SampleServer(std::filesystem::path file, std::string dataset, std::size_t axes, Element element,
                           std::size_t chunk_bytes)
    : file_(std::move(file)),
      dataset_(std::move(dataset)),
      axes_(axes),
      element_(element),
      chunk_bytes_(chunk_bytes),
      identity_(identity_of(file_)) {}

void SampleServer::start() {
    const Session session;  // no other thread is inside HDF5 during the fork
    const auto work = [&](int pipe) {
        try {
            if (identity_of(file_) != identity_) return refuse(pipe, "the file has changed since it was opened");
            serve(pipe, axes_, Samples(file_, dataset_, element_), bytes_of(element_), chunk_bytes_);
        } catch (const Error& error) {
            refuse(pipe, error.what());
        }
    };
    child_ = std::make_unique<ChildProcess>(
        core::ChildLimits{.memory = spare_memory, .cpu_seconds = spare_seconds, .serves = true}, work);
}

void SampleServer::ask(const Box& box, void* to) {
    if (!child_) start();
    const std::vector<std::uint64_t> start(box.start.begin(), box.start.end()),
        extent(box.extent.begin(), box.extent.end());
    child_->send(start.data(), start.size() * sizeof(start[0]));
    child_->send(extent.data(), extent.size() * sizeof(extent[0]));
    char answer = 0;
    child_->read(&answer, 1);
    if (answer == 'y') return child_->read(to, samples_of(extent) * bytes_of(element_));
    std::string text(max_reason, '\0');
    child_->read(text.data(), text.size());
    fail(file_, fmt::format("its dataset '{}' cannot be read: {}", dataset_, text.c_str()));
}

void SampleServer::read(const Box& box, void* to) {
    const std::lock_guard lock(mutex_);
    for (bool again : {true, false}) {
        try {
            return ask(box, to);
        } catch (const ChildFailure& failure) {
            child_.reset();
            // As in core::with_child(): the child may have blocked on a lock held by another thread of the parent.
            if (failure.kind() == ChildFailure::Kind::stuck && again) continue;
            fail(file_, fmt::format("the HDF5 library {} on its dataset '{}'", failure.what(), dataset_));
        } catch (...) {  // the pipe may hold the rest of an answer
            child_.reset();
            throw;
        }
    }
}

}  // namespace hogel::io::hdf5
