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

/// Part `number`, from 1, of `count` of a file, and the band of each dataset that it holds.
struct PartOf {
    std::size_t number = 1, count = 1;
    std::vector<Band> bands;
    std::string input;  ///< input that all parts must have in common, beside attributes and datasets
};

/// First record of a part file (docs/cluster.md). The image holds all bytes of the complete file except samples: HDF5's
/// structures with attributes. Parts are joined without HDF5, to the same bytes as a file written in one piece.
struct PartHeader {
    struct Samples {
        std::uint64_t offset = 0;         ///< in the complete file
        std::uint64_t element_bytes = 0;  ///< of one sample
        std::vector<std::size_t> shape;   ///< of the complete dataset
        Band band;

        std::uint64_t whole_bytes() const;
        std::uint64_t bytes() const;  ///< of the band
    };
    std::size_t number = 1, count = 1;
    std::uint64_t whole_bytes = 0;  ///< of the complete file
    std::vector<Samples> datasets;
    std::string image;

    /// Returns the ranges [first, end) of the image in the complete file, around the datasets, in order.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> image_runs() const;
};

/// Creates a part file with space for its samples, and returns the offsets of the datasets' records. Throws
/// Error(cannot_write).
/// @param work    lines that the parts of a file have in common
/// @param target  file name for error messages
std::vector<std::uint64_t> lay_out_part(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const std::vector<std::string>& work, const Attributes& attributes,
                                        const std::vector<NewDataset>& datasets, const PartOf& part);

/// Writes bytes of a band into its records, which begin at `records`, from byte `offset` of the band.
void write_to_records(core::RawFile& file, std::uint64_t records, std::uint64_t offset, const void* from,
                      std::uint64_t bytes);

/// Adds keys and checksums to a completely written part file; reads all samples. Throws Error(cannot_write).
/// @param target  file name for error messages
void complete_part(const std::filesystem::path& path, const std::filesystem::path& target);

/// Reader of a part file: a checkpoint file whose first record is the header. For each dataset follow records of 1 MiB
/// of its band; the last one may be shorter.
class PartReader {
  public:
    /// Throws Error(bad_input) for another format or version, a damaged header, or a wrong length.
    explicit PartReader(const std::filesystem::path& path);

    const PartHeader& header() const { return header_; }
    const std::vector<std::string>& work() const { return file_.work(); }
    /// Offsets of the datasets' records.
    const std::vector<std::uint64_t>& records() const { return records_; }
    /// Returns the next bytes of a band, in order of datasets and bytes. Throws Error(bad_input) if they are damaged.
    std::string read(std::size_t dataset, std::uint64_t offset);

  private:
    work::CheckpointReader file_;
    PartHeader header_;
    std::vector<std::uint64_t> records_;
};

}  // namespace hogel::io::hdf5
