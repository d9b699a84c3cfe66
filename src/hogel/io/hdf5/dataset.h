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

/// Reads boxes of one dataset, from any number of threads. Contiguous datasets of the expected type, as hogel writes
/// them, are read in parallel without HDF5; others (chunked, compressed, of another type or byte order) by HDF5 in a
/// child process, one box at a time.
class DatasetReader {
  public:
    /// Checks the dataset without allocating memory for it. Throws Error(bad_input) if it is missing, has another type
    /// or shape, or was not completely written. Needs a Session.
    DatasetReader(hid_t file, const char* name, std::vector<std::size_t> shape, bool complex,
                  std::shared_ptr<const core::RawFile> raw);
    /// Both return whether all numbers are finite.
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
    std::unique_ptr<SampleServer> by_hdf5_;  // if HDF5 must read it
};

/// How the samples of a dataset are stored.
struct Storage {
    std::vector<std::size_t> chunk;  ///< shape of the chunks; empty if there are none
    std::size_t chunk_bytes = 0;     ///< of a chunk, or else of an element
};
/// Calls fail(), which throws, for samples that were never written, which would be read as zeros, for references to
/// other files and for large chunks. Needs a Session.
Storage storage_of(hid_t dataset, const std::vector<std::size_t>& shape,
                   const std::function<void(const std::string&)>& fail);

/// The shape of a dataset. Throws Error(bad_input) if there is none of that name. Needs a Session.
std::vector<std::size_t> dataset_shape(hid_t file, const char* name, const std::filesystem::path& path);

/// What a file of datasets holds: everything but samples. With `part` only the bands that it names are written, to a
/// part file.
struct Contents {
    Attributes attributes;
    std::vector<NewDataset> datasets;
    std::optional<PartOf> part = {};
};

/// Writes a file of datasets: HDF5 lays it out, any number of threads fill it, and finish() gives it its name. The
/// processes of a team write one file together: the first one lays it out, renames it and keeps its journal.
class DatasetFile {
  public:
    /// @param resume  as in LightFieldFileOptions
    DatasetFile(const std::filesystem::path& path, Contents contents, const std::optional<std::string>& resume);
    ~DatasetFile();
    DatasetFile(const DatasetFile&) = delete;
    DatasetFile& operator=(const DatasetFile&) = delete;

    /// Boxes of a part file begin at its bands.
    void write(std::size_t dataset, const Box& box, const float* from);
    void write(std::size_t dataset, const Box& box, const std::complex<float>* from);
    /// For work that can be resumed: was_done() tells whether a part was done in an earlier run, note() records one
    /// that is done.
    bool was_done(const work::Journal::Part& part) const { return journal_ && journal_->was_done(part); }
    void note(const work::Journal::Part& part) {
        if (journal_) journal_->note(part);
    }
    /// For SharedSink: the queue of the tiles of a dataset.
    std::unique_ptr<work::TileQueue> share_tiles(std::size_t dataset, std::size_t tiles);
    /// The sum over all processes.
    std::uint64_t total(std::uint64_t here);
    /// Closes the file and renames it to its final name.
    void finish();
    const std::filesystem::path& path() const { return path_; }

  private:
    void lay_out(const Contents& contents, const std::optional<std::string>& resume);
    void lay_out_together(const Contents& contents, const std::optional<std::string>& resume);
    void take(const std::string& lines);
    void write_bytes(std::size_t dataset, const Box& box, const void* from);
    void put(std::size_t dataset, std::size_t sample, const void* from, std::size_t samples);

    std::filesystem::path path_;
    Communicator* communicator_;
    std::uint64_t number_ = 0;             // of the file, among those of the team
    std::atomic<std::size_t> closed_ = 0;  // other processes that have sent all they had
    bool finished_ = false;
    std::optional<core::OutputFile> output_;  // of the first process
    std::vector<NewDataset> datasets_;        // with the shapes that are written here
    bool is_part_ = false;
    std::vector<std::uint64_t> offsets_;  // of the samples, or of a part's records
    std::optional<core::RawFile> raw_;
    std::mutex writing_;
    core::ObjectPool<std::vector<std::uint16_t, CacheLineAllocator<std::uint16_t>>> halves_;
    std::optional<work::Journal> journal_;  // last, because its destructor flushes the file
};

}  // namespace hogel::io::hdf5
