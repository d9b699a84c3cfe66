// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Order of views as derived from the names of a folder's pictures.
namespace hogel::exchange {

/// A picture and the integers in its name, in order. A '-' after a blank or '_' is the sign of a number.
struct NumberedFile {
    std::filesystem::path path;
    std::vector<std::int64_t> numbers;
};

/// Pictures whose names differ only in numbers.
struct NumberedFiles {
    std::string shape;  ///< the name with '#' in place of each number
    std::vector<NumberedFile> files;
    /// Indices of the numbers that vary between names, without those determined by an earlier one.
    std::vector<std::size_t> varying;
};

/// Groups the pictures of a folder by the shape of their names, the largest group first; maps of disparity, depth or
/// labels (by name) last. Skips folders, hidden files and other extensions. Returns no groups unless `folder` is a
/// folder.
std::vector<NumberedFiles> numbered_pictures(const std::filesystem::path& folder);

struct PictureGrid {
    std::size_t rows = 0, columns = 0;
    std::vector<std::filesystem::path> files;  ///< [row][column]
};

/// Arranges a group by two of the numbers in its names, ascending. Throws Error(bad_input), with the name that is
/// missing or duplicate, unless the pictures fill a rectangle at even steps.
PictureGrid in_rows_and_columns(const NumberedFiles& group, std::size_t row_number, std::size_t column_number);

/// Arranges a group by one number that counts the pictures row by row. columns = rows = 0 means a square. Throws
/// Error(bad_input) for a missing or duplicate number, and Error(usage) for a count that does not fit.
PictureGrid counted(const NumberedFiles& group, std::size_t number, std::size_t columns, std::size_t rows);

}  // namespace hogel::exchange
