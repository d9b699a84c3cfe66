// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hogel/io/hdf5/hdf5.h"

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

/// What the header of a part file says (docs/cluster.md). The image holds the bytes of the whole file that are no
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
    std::vector<std::string> work;  ///< lines that the parts of a file have in common
    std::uint64_t whole_bytes = 0;  ///< of the whole file
    std::vector<Samples> datasets;
    std::vector<std::uint8_t> image;
    std::vector<std::uint64_t> offsets;  ///< of the datasets' bands in the part file

    std::uint64_t bytes() const;  ///< of the part file
    /// Where the image lies in the whole file, between and around the datasets: runs of [first, end), in order.
    std::vector<std::pair<std::uint64_t, std::uint64_t>> image_runs() const;
};

/// Creates a part file with space for its samples and returns their offsets.
/// @param work    lines that the parts of a file have in common
/// @param target  the file's name in error messages. Throws Error(cannot_write).
std::vector<std::uint64_t> lay_out_part(const std::filesystem::path& path, const std::filesystem::path& target,
                                        const std::vector<std::string>& work, const Attributes& attributes,
                                        const std::vector<NewDataset>& datasets, const PartOf& part);

/// Throws Error(bad_input) if the file is no part file, or its header is damaged.
PartHeader read_part_header(const std::filesystem::path& path);

}  // namespace hogel::io::hdf5
