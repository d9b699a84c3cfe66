// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <complex>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "hogel/array.h"
#include "hogel/core/object_pool.h"
#include "hogel/core/output_file.h"
#include "hogel/core/raw_file.h"
#include "hogel/io/hdf5/hdf5.h"
#include "hogel/io/hdf5/part_file.h"
#include "hogel/io/hdf5/sample_server.h"
#include "hogel/work/journal.h"
#include "hogel/work/shared_tiles.h"

namespace hogel::io::hdf5 {

/// Thread-safe reader of boxes of one dataset. Contiguous datasets of hogel's types are read in parallel without HDF5,
/// others (chunked, compressed, of another type or byte order) one box at a time by HDF5 in a child process.
class DatasetReader {
  public:
    /// Checks everything but samples. Throws Error(bad_input) if missing, mismatched or incomplete. Requires a Session.
    DatasetReader(hid_t file, const char* name, std::vector<std::size_t> shape, bool complex,
                  std::shared_ptr<const core::RawFile> raw);
    /// Fill `to`, row-major, and return whether all numbers are finite.
    bool read(const Box& box, float* to) const;
    bool read(const Box& box, std::complex<float>* to) const;
    hdf5::Element element() const { return element_; }
    std::size_t axes() const { return shape_.size(); }

  private:
    [[noreturn]] void fail(const std::string& why) const;

    std::string name_;
    std::vector<std::size_t> shape_;
    hdf5::Element element_ = hdf5::Element::single;
    std::shared_ptr<const core::RawFile> raw_;
    std::uint64_t offset_ = 0;
    std::unique_ptr<SampleServer> by_hdf5_;  // null if HDF5 is not needed
};

struct Storage {
    std::vector<std::size_t> chunk;  ///< shape of the chunks; empty without chunks
    std::size_t chunk_bytes = 0;     ///< of a chunk, otherwise of an element
};
/// Returns the storage of a dataset. Calls fail(), which throws, for fewer stored bytes than samples need (HDF5 would
/// read zeros), for references to other files and for large chunks. A missing chunk beside padded or compressed ones is
/// not found. Requires a Session.
Storage storage_of(hid_t dataset, const std::vector<std::size_t>& shape,
                   const std::function<void(const std::string&)>& fail);

/// Returns the shape of a dataset. Throws Error(bad_input) if it does not exist. Requires a Session.
std::vector<std::size_t> dataset_shape(hid_t file, const char* name, const std::filesystem::path& path);

/// Contents of a file of datasets, without samples. With `part`, only its bands are written, to a part file.
struct Contents {
    Attributes attributes;
    std::vector<NewDataset> datasets;
    std::optional<PartOf> part = {};
};

/// Thread-safe writer of a file of datasets. HDF5 lays the file out; finish() renames it to its final name. All ranks
/// of a communicator construct it, write, and call finish(); the root lays the file out, renames it and keeps its
/// journal.
class DatasetFile {
  public:
    /// @param resume  as in LightFieldFileOptions
    DatasetFile(const std::filesystem::path& path, Contents contents, const std::optional<std::string>& resume);
    ~DatasetFile();
    DatasetFile(const DatasetFile&) = delete;
    DatasetFile& operator=(const DatasetFile&) = delete;

    /// Writes a box, row-major. Boxes of a part file are relative to its bands.
    void write(std::size_t dataset, const Box& box, const float* from);
    void write(std::size_t dataset, const Box& box, const std::complex<float>* from);
    /// Support for resuming: was_done() tells whether an earlier run finished a part, note() records a finished part.
    bool was_done(const work::Journal::Part& part) const { return journal_ && journal_->was_done(part); }
    void note(const work::Journal::Part& part) {
        if (journal_) journal_->note(part);
    }
    /// Returns the queue of the tiles of a dataset, for SharedSink.
    std::unique_ptr<work::TileQueue> share_tiles(std::size_t dataset, std::size_t tiles);
    /// Returns the sum over all ranks.
    std::uint64_t total(std::uint64_t local);
    /// Closes the file and renames it to its final name.
    void finish();
    const std::filesystem::path& path() const { return path_; }

  private:
    void lay_out(const Contents& contents, const std::optional<std::string>& resume);
    void lay_out_shared(const Contents& contents, const std::optional<std::string>& resume);
    void take(const std::string& lines);
    void write_bytes(std::size_t dataset, const Box& box, const void* from);
    void put(std::size_t dataset, std::size_t sample, const void* from, std::size_t samples);

    std::filesystem::path path_;
    Communicator* communicator_;
    std::uint64_t number_ = 0;             // index of the file among those of the communicator
    std::atomic<std::size_t> closed_ = 0;  // number of other ranks that have sent all records
    bool finished_ = false;
    std::optional<core::OutputFile> output_;  // root only
    std::vector<NewDataset> datasets_;        // with the shapes written by this process
    bool is_part_ = false;
    std::vector<std::uint64_t> offsets_;  // of the samples, or of a part file's records
    std::optional<core::RawFile> raw_;
    std::mutex writing_;
    core::ObjectPool<std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>>> halves_;
    std::optional<work::Journal> journal_;  // last, because its destructor flushes the file
};

}  // namespace hogel::io::hdf5
