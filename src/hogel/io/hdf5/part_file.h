// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/core/raw_file.h"
#include "hogel/io/hdf5/hdf5.h"
#include "hogel/work/checkpoint_file.h"

namespace hogel::io::hdf5 {

/// Consecutive indices along one axis of a dataset.
struct Band {
    std::size_t axis = 0, first = 0, count = 0;
};

/// Which part of a file is written: number `number`, from 1, of `count`, and the band of each dataset that it holds.
struct PartOf {
    std::size_t number = 1, count = 1;
    std::vector<Band> bands;
    std::string input;  ///< what the parts must have in common beside attributes and datasets: the input
};

/// What the first record of a part file says (docs/cluster.md). The image holds the bytes of the whole file that are no
/// samples: HDF5's own structures, with all attributes, so that a file is joined without HDF5 and has the same bytes as
/// one that was written whole.
struct PartHeader {
    struct Samples {
        std::uint64_t offset = 0;         ///< in the whole file
        std::uint64_t element_bytes = 0;  ///< of one sample
        std::vector<std::size_t> shape;   ///< of the whole dataset
        Band band;

        std::uint64_t whole_bytes() const;
        std::uint64_t bytes() const;  ///< of the band
    };
    std::size_t number = 1, count = 1;
    std::uint64_t whole_bytes = 0;  ///< of the whole file
    std::vector<Samples> datasets;
    std::string image;

    /// Where the image lies in the whole file, between and around the datasets: runs of [first, end), in order.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> image_runs() const;
};

/// Creates a part file with space for its samples and returns the places of the datasets' records.
/// @param work    lines that the parts of a file have in common
/// @param target  the file's name in error messages. Throws Error(cannot_write).
std::vector<std::uint64_t> lay_out_part(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const std::vector<std::string>& work, const Attributes& attributes,
                                        const std::vector<NewDataset>& datasets, const PartOf& part);

/// Writes bytes of a band, `at` bytes from its begin, into its records.
/// @param records  where the first of them begins
void write_to_records(core::RawFile& file, std::uint64_t records, std::uint64_t at, const void* from,
                      std::uint64_t bytes);

/// Gives the records of a part file whose samples are all written their keys and checksums. It reads all samples.
/// @param target  the file's name in error messages. Throws Error(cannot_write).
void complete_part(const std::filesystem::path& path, const std::filesystem::path& target);

/// Reads a part file: a CheckpointFile of one record that is the header, and for each dataset records of a mebibyte of
/// the band, the last of which may be shorter.
class PartReader {
  public:
    /// Throws Error(bad_input) if the file is no part file of this version, its header is damaged, or it has another
    /// length.
    explicit PartReader(const std::filesystem::path& path);

    const PartHeader& header() const { return header_; }
    const std::vector<std::string>& work() const { return file_.work(); }
    /// The places of the datasets' records.
    const std::vector<std::uint64_t>& records() const { return records_; }
    /// The next bytes of a band, from the first dataset's to the last one's. Throws Error(bad_input) if they are
    /// damaged.
    std::string read(std::size_t dataset, std::uint64_t at);

  private:
    work::CheckpointReader file_;
    PartHeader header_;
    std::vector<std::uint64_t> records_;
};

}  // namespace hogel::io::hdf5
