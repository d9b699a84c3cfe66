// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hogel/exchange/view_set.h"

namespace hogel::exchange {

/// Orders a set whose views are numbered by two numbers, if it is unknown which one is the column. Uses
/// options.column_first, otherwise the parallax: along a row of cameras it is horizontal. The parallax also shows
/// whether rows run from the bottom, provided that columns run from the left. Adds a note with the result.
/// @param set            with the second number as the column, and its size filled in
/// @param first, second  names of the numbers in notes: "the first number in the names"
ViewSet ordered_by_parallax(ViewSet set, const ViewImportOptions& options, const std::string& first,
                            const std::string& second);

/// Returns whether the rows of a set are parts of a single row: motion continues from row to row.
bool is_one_row(const ViewSet& set);

/// Orders a set numbered by one number: row by row, unless the parallax shows column by column or that every second row
/// (or column) runs back, as in the path of a single camera. Adds a note for any other order than rows in the same
/// direction. Does nothing if options mirror the set.
/// @param set  row by row, with its size filled in
ViewSet unwound_by_parallax(ViewSet set, const ViewImportOptions& options);

}  // namespace hogel::exchange
