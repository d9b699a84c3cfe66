// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// What the names of a folder's pictures say of the order of views.
namespace hogel::exchange {

/// A picture and the whole numbers in its name, in their order. A '-' behind a blank or '_' is the sign of a number.
struct NumberedFile {
    std::filesystem::path path;
    std::vector<std::int64_t> numbers;
};

/// Pictures whose names differ in numbers alone.
struct NumberedFiles {
    std::string shape;  ///< the name with '#' in place of each number
    std::vector<NumberedFile> files;
    /// Indices of the numbers that are not the same in all names, without those that follow from one before them, as a
    /// camera's place from its column.
    std::vector<std::size_t> varying;
};

/// The pictures of a folder, by the shape of their names, the largest group first, and last those that are maps of
/// disparity, depth or labels by their names. Folders, hidden files and files that
/// are no pictures by their names are left out. No groups for what is no folder.
std::vector<NumberedFiles> numbered_pictures(const std::filesystem::path& folder);

/// Pictures in rows and columns.
struct PictureGrid {
    std::size_t rows = 0, columns = 0;
    std::vector<std::filesystem::path> files;  ///< [row][column]
};

/// The pictures of a group by two of the numbers in their names, in rising order. Throws Error(bad_input), with the
/// name that is missing or that is there twice, unless they fill a rectangle at even steps.
PictureGrid in_rows_and_columns(const NumberedFiles& group, std::size_t row_number, std::size_t column_number);

/// The pictures of a group by one number, which counts them row by row. With columns = rows = 0 they form a square.
/// Throws Error(bad_input) for a number that is missing or there twice, and Error(usage) for a count that does not fit.
PictureGrid counted(const NumberedFiles& group, std::size_t number, std::size_t columns, std::size_t rows);

}  // namespace hogel::exchange
